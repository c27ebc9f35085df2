//! From what was chosen back to the choice.

use super::{Choice, Description, Value};
use crate::function::original;
use crate::number::Number;
use forgetting::choice;
use forgetting::gates::Gate;
use forgetting::mixers::{AnyMixer, Mixer};
use forgetting::rates::Rate;
use forgetting::rules::Forgetting;
use forgetting::weightings::Weighting;
use forgetting::{AnyEstimator, Dynamic};

impl Description {
    /// What `estimator` is made of.
    pub(crate) fn of<T: Number>(estimator: &AnyEstimator<T>) -> Self {
        let (rule, rate) = (estimator.rule(), estimator.rate());
        let (weighting, gate) = (estimator.weighting(), estimator.gate());
        Self {
            rule: Choice::described::<T>(rule.about().name, |each| {
                rule.describe(&mut |name, value| each(name, value));
            }),
            rate: Choice::described::<T>(rate.about().name, |each| {
                rate.describe(&mut |name, value| each(name, value));
            }),
            weighting: Choice::described::<T>(weighting.about().name, |each| {
                weighting.describe(&mut |name, value| each(name, value));
            }),
            gate: Choice::described::<T>(gate.about().name, |each| {
                gate.describe(&mut |name, value| each(name, value));
            }),
        }
    }
}

impl Choice {
    /// What mixes the members of a bank.
    pub(crate) fn mixer<T: Number>(mixer: &AnyMixer<Dynamic<T>>) -> Self {
        Self::described::<T>(mixer.about().name, |each| {
            mixer.describe(&mut |name, value| each(name, value));
        })
    }

    /// The choice of this name whose values `describe` names one by one.
    fn described<T: Number>(
        name: &str,
        describe: impl FnOnce(&mut dyn FnMut(&str, choice::Value<'_>)),
    ) -> Self {
        let mut choice = Self::named(name);
        describe(&mut |name, value| {
            let value = Value::of::<T>(value);
            choice.parameters.extend(value.map(|value| (name.to_owned(), value)));
        });
        choice
    }
}

impl Value {
    /// A value of the core's; none for a function that no interface made.
    fn of<T: Number>(value: choice::Value<'_>) -> Option<Self> {
        Some(match value {
            choice::Value::Real(number) => Self::Number(number),
            choice::Value::Word(word) => Self::Word(word.into()),
            choice::Value::Matrix { rows, columns, elements } => Self::Matrix {
                rows,
                columns,
                elements: (0..rows * columns).map(elements).collect(),
            },
            choice::Value::Choice { name, values } => {
                Self::Choice(Choice::described::<T>(name, |each| values.each(each)))
            }
            choice::Value::Function(function) => Self::Function(original::<T>(function)?),
        })
    }

    /// A value of the core's that is data; none for a function.
    #[must_use]
    pub fn of_core(value: choice::Value<'_>) -> Option<Self> {
        Self::of::<f64>(value)
    }
}

/// Whether a function of the user's is part of `estimator`.
pub(crate) fn has_function<T: Number>(estimator: &AnyEstimator<T>) -> bool {
    let mut found = false;
    let mut look = |_: &'static str, value: choice::Value<'_>| found |= is_function(value);
    estimator.rule().describe(&mut look);
    estimator.rate().describe(&mut look);
    estimator.gate().describe(&mut look);
    found
}

fn is_function(value: choice::Value<'_>) -> bool {
    match value {
        choice::Value::Function(_) => true,
        choice::Value::Choice { values, .. } => {
            let mut found = false;
            values.each(&mut |_, value| found |= is_function(value));
            found
        }
        _ => false,
    }
}
