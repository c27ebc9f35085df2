//! Parameters out of range are refused by name, and those in use are told back.

use crate::subjects::{rules, sample_in, subjects, Given, Item};
use forgetting::choice::{Kind, Parameter, Value, Values};
use forgetting::rules::{Forgetting, Rule, RULES};
use forgetting::{Dynamic, Error, Kernels};

const N: usize = 3;

fn named(error: Error) -> &'static str {
    match error {
        Error::Value { parameter, .. }
        | Error::Length { parameter, .. }
        | Error::Indefinite { parameter, .. }
        | Error::Missing { parameter }
        | Error::Unknown { parameter }
        | Error::Range { parameter, .. } => parameter,
        other => panic!("{other} names no parameter"),
    }
}

/// Numbers at, below and above the ends of every range in use.
const PROBES: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    -1e300,
    -1.0,
    -1e-9,
    -f64::MIN_POSITIVE,
    0.0,
    0.5,
    1.0,
    1.0 + 1e-9,
    1.5,
    2.0,
    3.0,
    1e9,
    1e300,
];

/// Items that `parameter` must refuse.
fn bad_items(parameter: &Parameter) -> Vec<Item> {
    let bad = |x: &f64| parameter.check(*x).is_err();
    let numbers: Vec<f64> = PROBES.into_iter().filter(bad).collect();
    assert!(numbers.len() >= 3, "{} takes NaN or an infinity", parameter.name);
    let mut items: Vec<Item> = numbers.iter().map(|&x| Item::Real(x)).collect();
    match parameter.kind {
        Kind::Real | Kind::Whole => items.push(Item::matrix(1, &[0.5; 2])),
        Kind::Word(_) | Kind::Rule | Kind::Function => items.push(Item::Word("no such word")),
        Kind::Matrix => {
            let good = sample_in(parameter);
            items.extend(numbers.iter().map(|&x| Item::matrix(1, &[good, x, good])));
            items.push(Item::matrix(1, &[good; N + 1]));
            items.push(Item::matrix(N + 1, &[good; (N + 1) * (N + 1)]));
            items.push(Item::matrix(3, &[2.0, 1.0, 0.0, 0.5, 2.0, 0.0, 0.0, 0.0, 2.0]));
            items.push(Item::matrix(3, &[1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0]));
            items.push(Item::matrix(3, &[1.0, 0.0, 0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0, 1.0]));
            items.push(Item::Word("a word"));
        }
        Kind::List => {
            items.extend(numbers.iter().map(|&x| Item::matrix(1, &[x, 1.0, 1.0])));
            items.push(Item::matrix(1, &[1.0; N + 1]));
            items.push(Item::Word("a word"));
        }
    }
    items
}

fn refuses<T: Kernels>() {
    let memory = Dynamic::<T>::new(N, 1, 1).unwrap();
    for subject in rules() {
        for parameter in subject.about.parameters {
            for item in bad_items(parameter) {
                let mut given = subject.given.clone();
                given.0.retain(|(name, _)| *name != parameter.name);
                given.0.push((parameter.name, item));
                let made = given.with(|values| Rule::named(subject.about.name, values, memory));
                let error = made.map(|rule| panic!("{given:?} made {rule:?}")).unwrap_err();
                assert_eq!(named(error), parameter.name, "{given:?}: {error}");
                assert!(error.to_string().contains(parameter.name));
            }
        }
    }
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    refuses::<f64>();
    refuses::<f32>();
}

#[test]
fn a_number_must_be_in_range_in_the_type_computed_with() {
    let memory = Dynamic::<f32>::new(N, 1, 1).unwrap();
    let tiny = Given::one("threshold", Item::Real(1e-60));
    let error = tiny.with(|values| Rule::named("subspace", values, memory)).unwrap_err();
    assert_eq!(named(error), "threshold");
    let huge = Given::one("process_noise", Item::Real(1e60));
    let error = huge.with(|values| Rule::named("random_walk", values, memory)).unwrap_err();
    assert_eq!(named(error), "process_noise");
}

#[test]
fn unknown_rules_and_too_many_rows_are_refused() {
    let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
    let error = Given::default().with(|v| Rule::named("no such rule", v, memory)).unwrap_err();
    assert_eq!(error, Error::Unknown { parameter: "rule" });
    for (subject, largest) in rules().filter_map(|s| s.about.largest_rows.map(|l| (s, l))) {
        let memory = |rows| Dynamic::<f64>::new(2, rows, 1).unwrap();
        assert!(subject.rule(memory(largest)).is_ok());
        let error = subject.rule(memory(largest + 1)).unwrap_err();
        assert_eq!(named(error), "rows");
    }
}

/// Every parameter by name, as text.
fn described(rule: &Rule<Dynamic<f64>>) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    rule.describe(&mut |name, value| {
        let mut text = format!("{value:?}");
        if let Value::Matrix { rows, columns, elements } = value {
            let elements: Vec<f64> = (0..rows * columns).map(elements).collect();
            text += &format!("{elements:?}");
        }
        if let Value::Choice { values, .. } = value {
            values.each(&mut |name, value| text += &format!(" {name}={value:?}"));
        }
        all.push((name, text));
    });
    all
}

/// The values that a rule tells of itself.
struct Told<'a>(&'a Rule<Dynamic<f64>>);

impl Told<'_> {
    fn make_again(&self) -> Rule<Dynamic<f64>> {
        let memory = Dynamic::new(N, 1, 1).unwrap();
        let mut given = Given::default();
        self.0.describe(&mut |name, value| {
            let item = match value {
                Value::Real(x) => Item::Real(x),
                Value::Word(word) => Item::Word(word.to_owned().leak()),
                Value::Matrix { rows, columns, elements } => {
                    let elements: Vec<f64> = (0..rows * columns).map(elements).collect();
                    Item::matrix(rows, &elements)
                }
                Value::Choice { name, .. } => Item::Word(name.to_owned().leak()),
                Value::Function(_) => panic!("a function has no name to give it by"),
            };
            given.0.push((name, item));
        });
        given.with(|values| Rule::named(self.0.about().name, values, memory)).unwrap()
    }
}

#[test]
fn what_a_rule_tells_of_itself_makes_the_same_rule() {
    let memory = Dynamic::<f64>::new(N, 1, 1).unwrap();
    for subject in subjects() {
        let rule = subject.rule(memory).unwrap();
        let told = described(&rule);
        let known = |name| subject.about.parameters.iter().any(|p| p.name == name);
        assert!(told.iter().all(|(name, _)| known(*name)), "{subject:?}: {told:?}");
        assert_eq!(told, described(&Told(&rule).make_again()), "{subject:?}");
    }
}

#[test]
fn every_rule_is_reached_by_name() {
    for about in RULES {
        let memory = Dynamic::<f64>::new(N, 1, 1).unwrap();
        match Given::default().with(|values: &dyn Values| Rule::named(about.name, values, memory)) {
            Ok(rule) => assert_eq!(rule.about().name, about.name),
            Err(error) => assert!(matches!(error, Error::Missing { .. }), "{error}"),
        }
    }
}
