//! Functions of the user's, in each place that takes one.

use forgetting_runtime::{
    Answer, Argument, Choice, CoreError, Error, Estimator, Evidence, Fleet, ForgettingFactor,
    Function, Innovation, Kind, NumberType, Settings, Value,
};
use std::any::Any;
use std::sync::{Arc, Mutex};

/// F = 0.02 R, λ = 0.98, hold errors above 10; fails at an error of 7.
#[derive(Debug, Default)]
struct Mine {
    seen: Mutex<Vec<Evidence>>,
}

const FAILED: CoreError = CoreError::Function { parameter: "mine" };

impl Mine {
    fn error(&self, evidence: &Evidence) -> Result<f64, CoreError> {
        self.seen.lock().unwrap().push(evidence.clone());
        match evidence.error {
            Innovation::Scalar(7.0) => Err(FAILED),
            Innovation::Scalar(error) => Ok(error),
            Innovation::Array { .. } => panic!("there is one row"),
        }
    }
}

impl Function for Mine {
    fn matrix(
        &self,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<(), CoreError> {
        let [information, _, error] = arguments else { panic!("three are given") };
        assert_eq!((information.rows, information.columns), shape);
        if (error.elements)(0) == 7.0 {
            return Err(FAILED);
        }
        (0..shape.0 * shape.1).for_each(|k| put(k, 0.02 * (information.elements)(k)));
        Ok(())
    }

    fn forgetting_factor(&self, evidence: &Evidence) -> Result<f64, CoreError> {
        self.error(evidence).map(|_| 0.98)
    }

    fn gate(&self, evidence: &Evidence) -> Result<Answer, CoreError> {
        let far = |error: f64| error.abs() > 10.0;
        self.error(evidence).map(|error| if far(error) { Answer::Hold } else { Answer::Update })
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

fn mine() -> Arc<dyn Function> {
    Arc::new(Mine::default())
}

/// The same function in each place.
fn places() -> [Settings<'static>; 3] {
    let rule = |name: &str| Some(Choice::named(name));
    let custom = Choice::named("custom").with("forgetting_matrix", mine());
    let rate = Choice::named("function").with("function", mine());
    [
        Settings { rule: Some(custom), ..Settings::new(2) },
        Settings {
            rule: rule("exponential"),
            forgetting_factor: ForgettingFactor::Rate(rate),
            ..Settings::new(2)
        },
        Settings {
            rule: rule("exponential"),
            forgetting_factor: ForgettingFactor::constant(0.98),
            gate: Some(Choice::gate_function(mine())),
            ..Settings::new(2)
        },
    ]
}

#[test]
fn each_does_what_it_says() {
    for number_type in [NumberType::F64, NumberType::F32] {
        let exponential = Settings {
            number_type,
            rule: Some(Choice::named("exponential")),
            forgetting_factor: ForgettingFactor::constant(0.98),
            ..Settings::new(2)
        };
        let tolerance = if number_type == NumberType::F64 { 1e-12 } else { 1e-4 };
        for settings in places() {
            let mut estimator = Estimator::new(&Settings { number_type, ..settings }).unwrap();
            let mut other = Estimator::new(&exponential).unwrap();
            assert!(estimator.calls_function() && !other.calls_function());
            for k in 0..20 {
                let (phi, y) = ([1.0, f64::from(k % 3)], [f64::from(k % 5)]);
                estimator.update(phi[..].into(), y[..].into(), None).unwrap();
                other.update(phi[..].into(), y[..].into(), None).unwrap();
            }
            let pair =
                [estimator.covariance(), other.covariance()].map(|p| p.unwrap().elements.to_f64());
            let close = |(x, y): (&f64, &f64)| (x - y).abs() <= tolerance * y.abs();
            assert!(pair[0].iter().zip(&pair[1]).all(close), "{pair:?}");
        }
    }
}

#[test]
fn a_rate_sees_the_evidence_and_a_gate_holds() {
    let function = Arc::new(Mine::default());
    let gate = Some(Choice::gate_function(Arc::clone(&function) as Arc<dyn Function>));
    let mut estimator = Estimator::new(&Settings { gate, ..Settings::new(2) }).unwrap();
    let update = estimator.update([1.0, 2.0][..].into(), [30.0][..].into(), None).unwrap();
    assert_eq!((update.gate, estimator.samples()), (Answer::Hold, 0));
    let expected = Evidence {
        error: Innovation::Scalar(30.0),
        squared_error: 900.0,
        // φ in units of its first values: 1 and 1
        leverage: 2e5,
        normalized_error: 900.0 / 200_001.0,
        samples: 0,
        parameters: 2,
        rows: 1,
        targets: 1,
    };
    assert_eq!(*function.seen.lock().unwrap(), [expected]);
}

#[test]
fn a_failure_refuses_the_sample_and_changes_nothing() {
    for settings in places() {
        let mut estimator = Estimator::new(&settings).unwrap();
        let error = estimator.update([1.0, 0.0][..].into(), [7.0][..].into(), None).unwrap_err();
        assert_eq!((error.kind(), error), (Kind::Function, Error::Core(FAILED)));
        assert_eq!((estimator.samples(), estimator.extremes()), (0, (1e5, 1e5)));
    }
}

#[test]
fn a_description_gives_the_function_back() {
    for settings in places() {
        let description = Estimator::new(&settings).unwrap().describe();
        let values = [description.rule, description.rate, description.gate];
        let mut values = values.iter().flat_map(|choice| &choice.parameters);
        let is_mine = |value: &Value| match value {
            Value::Function(function) => function.as_any().is::<Mine>(),
            _ => false,
        };
        assert!(values.any(|(_, value)| is_mine(value)));
    }
}

#[test]
fn it_cannot_be_saved_nor_be_in_a_fleet() {
    for settings in places() {
        let error = Estimator::new(&settings).unwrap().to_bytes().unwrap_err();
        assert!(error.to_string().contains("a function of yours cannot be saved"), "{error}");
        let error = Fleet::new(2, &settings, None).err().unwrap();
        assert!(error.to_string().starts_with("a fleet takes no function of yours"));
    }
    let inner = Choice::named("custom").with("forgetting_matrix", mine());
    let rule = Some(Choice::named("covariance_resetting").with("rule", inner));
    assert!(Estimator::new(&Settings { rule, ..Settings::new(2) }).unwrap().calls_function());
}
