//! Choices by name: what they make, how they are described, and what is refused.

use forgetting_runtime::{
    size, threads, Choice, Error, Estimator, ForgettingFactor, Kind, NumberType, Settings, Value,
    View,
};

fn refused(settings: &Settings<'_>) -> String {
    let error = Estimator::new(settings).err().expect("it is refused");
    assert_eq!(error.kind(), Kind::Invalid);
    error.to_string()
}

fn with_rule(rule: Choice) -> Settings<'static> {
    Settings { rule: Some(rule), ..Settings::new(3) }
}

fn number(choice: &Choice, name: &str) -> f64 {
    match choice.get(name) {
        Some(Value::Number(number)) => *number,
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn nothing_said_is_the_default() {
    let estimator = Estimator::new(&Settings::new(3)).unwrap();
    let description = estimator.describe();
    let names = [&description.rule, &description.rate, &description.weighting, &description.gate]
        .map(|choice| choice.name.as_str());
    assert_eq!(names, ["random_walk", "constant", "equal", "open"]);
    assert_eq!(number(&description.rule, "process_noise"), 0.003);
    assert_eq!(number(&description.rule, "bound"), 1e5);
    assert_eq!(number(&description.rate, "forgetting_factor"), 1.0);
    assert_eq!(estimator.number_type().name(), "float64");
    assert_eq!(estimator.extremes(), (1e5, 1e5));
    assert!(estimator.health().is_none() && !estimator.calls_function());
}

#[test]
fn a_rule_without_a_forgetting_factor_reports_1() {
    let factor = |settings: &Settings<'_>| {
        number(&Estimator::new(settings).unwrap().describe().rate, "forgetting_factor")
    };
    assert_eq!(factor(&with_rule(Choice::named("none"))), 1.0);
    let settings = with_rule(Choice::named("exponential"));
    assert_eq!(factor(&settings), 0.99);
    assert_eq!(factor(&Settings { forgetting_factor: ForgettingFactor::None, ..settings }), 1.0);
}

#[test]
fn a_description_makes_the_same_again() {
    let matrix = Value::array("information", vec![2.0, 0.5, 0.5, 1.0], &[2, 2]).unwrap();
    let list = Value::array("information", vec![2.0, 1.0], &[2]).unwrap();
    let inner = Choice::named("exponential_resetting").with("information", matrix.clone());
    let rules = [
        Choice::named("exponential_resetting").with("information", matrix),
        Choice::named("exponential_resetting").with("information", list),
        Choice::named("covariance_resetting").with("rule", inner).with("period", 50.0),
    ];
    for rule in rules {
        let settings = Settings {
            rule: Some(rule),
            forgetting_factor: ForgettingFactor::Rate(Choice::named("fortescue")),
            weighting: Some(Choice::named("huber").with("threshold", 2.5)),
            gate: Some(Choice::named("dead_zone").with("width", 0.1).with("otherwise", "freeze")),
            ..Settings::new(2)
        };
        let estimator = Estimator::new(&settings).unwrap();
        let description = estimator.describe();
        let again = Settings {
            rule: Some(description.rule),
            forgetting_factor: ForgettingFactor::Rate(description.rate),
            weighting: Some(description.weighting),
            gate: Some(description.gate),
            ..settings
        };
        let again = Estimator::new(&again).unwrap();
        assert_eq!(again.to_bytes().unwrap(), estimator.to_bytes().unwrap());
    }
}

/// Whether the choice is refused, and what there is instead is named.
fn is_unknown(settings: &Settings<'_>, what: &str) -> bool {
    let known = match what {
        "rule" => "none, exponential, ",
        "rate" => "constant, prediction_error, ",
        "weighting" => "equal, huber, student_t",
        _ => "open, ",
    };
    let said = format!("{what} = \"nonsense\" is not known; there are: {known}");
    refused(settings).starts_with(&said)
}

#[test]
fn a_name_or_a_parameter_that_there_is_none_of_is_refused() {
    let base = || Settings::new(3);
    let settings = with_rule(Choice::named("nonsense"));
    assert!(is_unknown(&settings, "rule"));
    let rate = ForgettingFactor::Rate(Choice::named("nonsense"));
    let settings = Settings { forgetting_factor: rate, ..base() };
    assert!(is_unknown(&settings, "rate"));
    let settings = Settings { weighting: Some(Choice::named("nonsense")), ..base() };
    assert!(is_unknown(&settings, "weighting"));
    let settings = Settings { gate: Some(Choice::named("nonsense")), ..base() };
    assert!(is_unknown(&settings, "gate"));
    let settings = with_rule(Choice::named("subspace").with("treshold", 0.1));
    let expected = "rule subspace has no parameter treshold; it has: threshold";
    assert_eq!(refused(&settings), expected);
    let inner = Choice::named("exponential").with("threshold", 0.1);
    let settings = with_rule(Choice::named("covariance_resetting").with("rule", inner));
    let expected = "rule exponential has no parameter threshold; it has: none";
    assert_eq!(refused(&settings), expected);
}

#[test]
fn a_value_that_is_not_allowed_is_refused() {
    let settings = with_rule(Choice::named("subspace").with("threshold", -1.0));
    assert!(refused(&settings).starts_with("threshold = -1, allowed: (0, inf)"));
    let settings =
        Settings { forgetting_factor: ForgettingFactor::constant(1.5), ..Settings::new(3) };
    assert_eq!(refused(&settings), "forgetting_factor = 1.5, allowed: (0, 1]");
    let settings = Settings { rows: 0, ..Settings::new(3) };
    assert_eq!(refused(&settings), "rows = 0, allowed: whole numbers from 1 to 32768");
    let error = Value::array("information", vec![1.0], &[1, 1, 1]).unwrap_err();
    assert_eq!(error.to_string(), "information has 3 dimensions, allowed: 0, 1 or 2");
    assert!(matches!(Value::array("a", vec![1.0], &[2]), Err(Error::Shape { .. })));
    let error = NumberType::named("int32").unwrap_err();
    assert_eq!(error.to_string(), "dtype = \"int32\", allowed: \"float64\", \"float32\"");
    let error = size("rows", -1).unwrap_err();
    assert_eq!(error.to_string(), "rows = -1, allowed: whole numbers from 1 to 32768");
    let error = threads(Some(0)).unwrap_err();
    assert_eq!(error.to_string(), "threads = 0, allowed: whole numbers from 1 to 1024");
    assert_eq!((size("rows", 7).unwrap(), threads(Some(2)).unwrap()), (7, Some(2)));
}

#[test]
fn initial_values_have_their_shapes() {
    let (two, four) = ([1.0, 2.0], [2.0, 0.5, 0.5, 1.0]);
    let covariance = |numbers, shape| {
        let initial_covariance = Some(View::new("initial_covariance", numbers, shape).unwrap());
        let settings = Settings { initial_covariance, targets: 2, ..Settings::new(2) };
        Estimator::new(&settings).map(|estimator| estimator.covariance().unwrap().elements.to_f64())
    };
    assert_eq!(covariance(&[3.0][..], &[]).unwrap(), [3.0, 0.0, 0.0, 3.0]);
    assert_eq!(covariance(&two[..], &[2]).unwrap(), [1.0, 0.0, 0.0, 2.0]);
    assert_eq!(covariance(&four[..], &[2, 2]).unwrap(), four);
    let error = covariance(&two[..1], &[1]).unwrap_err();
    assert_eq!(error.to_string(), "initial_covariance has shape (1,), expected (), (2,) or (2, 2)");

    let theta = |numbers, shape| {
        let initial_theta = Some(View::new("initial_theta", numbers, shape).unwrap());
        Estimator::new(&Settings { initial_theta, targets: 2, ..Settings::new(2) })
            .map(|estimator| (estimator.theta().shape, estimator.theta().elements.to_f64()))
    };
    assert_eq!(theta(&four[..], &[2, 2]).unwrap(), (vec![2, 2], four.to_vec()));
    let error = theta(&two[..], &[2]).unwrap_err();
    assert_eq!(error.to_string(), "initial_theta has shape (2,), expected (2, 2)");
}

#[test]
fn p_is_its_factor_multiplied_out() {
    let four = [2.0, 0.5, 0.5, 1.0];
    let initial_covariance = Some(View::new("initial_covariance", &four[..], &[2, 2]).unwrap());
    let estimator = Estimator::new(&Settings { initial_covariance, ..Settings::new(2) }).unwrap();
    let (unit, diagonal) = estimator.factor().unwrap();
    let (u, d) = (unit.elements.to_f64(), diagonal.elements.to_f64());
    assert_eq!((unit.shape, diagonal.shape), (vec![2, 2], vec![2]));
    for i in 0..2 {
        for j in 0..2 {
            let p: f64 = (0..2).map(|k| u[2 * i + k] * d[k] * u[2 * j + k]).sum();
            assert!((p - four[2 * i + j]).abs() < 1e-15);
        }
    }
}
