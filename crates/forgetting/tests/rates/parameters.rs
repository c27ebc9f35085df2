//! Parameters are checked.

use crate::subjects::Given;
use forgetting::choice::{Kind, Parameter, Value};
use forgetting::rates::{AnyRate, RATES};
use forgetting::weightings::{AnyWeighting, WEIGHTINGS};
use forgetting::{Dynamic, Error};

fn refused_values(parameter: &Parameter) -> Vec<f64> {
    let candidates = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.5, 0.0, 1.0, 1.5, 2.0];
    let fits = |x: f64| {
        let whole = parameter.kind != Kind::Whole || x.trunc() == x;
        x.is_finite() && parameter.range.contains(x) && whole
    };
    candidates.into_iter().filter(|&x| !fits(x)).collect()
}

fn names(error: &Error, parameter: &str) -> bool {
    error.to_string().contains(parameter)
}

#[test]
fn every_parameter_is_checked() {
    let memory = Dynamic::<f64>::new(3, 1, 1).unwrap();
    let rates = RATES.iter().map(|about| (about.name, about.parameters, true));
    let weightings = WEIGHTINGS.iter().map(|about| (about.name, about.parameters, false));
    for (name, parameters, is_rate) in rates.chain(weightings) {
        for parameter in parameters {
            let word = matches!(parameter.kind, Kind::Word(_) | Kind::Function);
            let bad: Vec<Value<'_>> = if word {
                vec![Value::Real(0.5), Value::Word("no such word")]
            } else {
                refused_values(parameter).into_iter().map(Value::Real).collect()
            };
            assert!(bad.len() > 1, "{name}.{}", parameter.name);
            for value in bad {
                let given = Given::<Dynamic<f64>>::new(&[(parameter.name, value)]);
                let error = if is_rate {
                    AnyRate::named(name, &given, memory).err()
                } else {
                    AnyWeighting::named(name, &given, memory).err()
                };
                let error =
                    error.unwrap_or_else(|| panic!("{name}.{} = {value:?}", parameter.name));
                assert!(names(&error, parameter.name), "{name}: {error}");
            }
        }
    }
}
