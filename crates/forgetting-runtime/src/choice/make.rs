//! From a choice to what is chosen.

use super::{Choice, Value};
use crate::error::Error;
use crate::function::{CoreFunction, Function};
use forgetting::choice::{self, About, Values};
use forgetting::rules::RULES;
use std::sync::Arc;

/// Makes of a function of the user's what a parameter takes.
pub(crate) type Adapt = fn(&Arc<dyn Function>) -> CoreFunction;

impl Choice {
    /// Refuses a parameter that the entry of this name among `entries` does not have, then makes
    /// what is chosen.
    pub(crate) fn make<T>(
        &self,
        (what, entries): (&str, &[About]),
        adapt: Adapt,
        make: impl FnOnce(&str, &dyn Values) -> Result<T, forgetting::Error>,
    ) -> Result<T, Error> {
        self.check_names(what, entries)?;
        make(&self.name, &Prepared::of(self, adapt)).map_err(|error| match error {
            forgetting::Error::Unknown { .. } => {
                let known: Vec<_> = entries.iter().map(|about| about.name).collect();
                Error::Name { what: what.into(), name: self.name.clone(), known: known.join(", ") }
            }
            error => error.into(),
        })
    }

    /// Refuses a parameter that the entry does not have, here and in a rule that is a parameter.
    fn check_names(&self, what: &str, entries: &[About]) -> Result<(), Error> {
        let entry = entries.iter().find(|about| about.name == self.name);
        let allowed = entry.map(|about| about.parameters);
        for (name, value) in &self.parameters {
            if let Some(allowed) = allowed.filter(|all| !all.iter().any(|p| p.name == name)) {
                let names: Vec<_> = allowed.iter().map(|p| p.name).collect();
                return Err(Error::Parameter {
                    of: format!("{what} {}", self.name),
                    parameter: name.clone(),
                    allowed: if names.is_empty() { "none".into() } else { names.join(", ") },
                });
            }
            if let Value::Choice(inner) = value {
                inner.check_names(name, RULES)?;
            }
        }
        Ok(())
    }
}

/// The values of a choice as the core looks them up.
struct Prepared<'a>(Vec<(&'a str, PreparedValue<'a>)>);

enum PreparedValue<'a> {
    Number(f64),
    Word(&'a str),
    Matrix { rows: usize, columns: usize, elements: Box<dyn Fn(usize) -> f64 + 'a> },
    Choice { name: &'a str, values: Prepared<'a> },
    Function(CoreFunction),
}

impl<'a> Prepared<'a> {
    fn of(choice: &'a Choice, adapt: Adapt) -> Self {
        let prepare = |value: &'a Value| match value {
            Value::Number(number) => PreparedValue::Number(*number),
            Value::Word(word) => PreparedValue::Word(word),
            Value::Matrix { rows, columns, elements } => PreparedValue::Matrix {
                rows: *rows,
                columns: *columns,
                elements: Box::new(|k| elements.get(k).copied().unwrap_or(f64::NAN)),
            },
            Value::Choice(rule) => {
                PreparedValue::Choice { name: &rule.name, values: Self::of(rule, adapt) }
            }
            Value::Function(function) => PreparedValue::Function(adapt(function)),
        };
        let parameters = choice.parameters.iter();
        Self(parameters.map(|(name, value)| (name.as_str(), prepare(value))).collect())
    }
}

impl Values for Prepared<'_> {
    fn get(&self, name: &str) -> Option<choice::Value<'_>> {
        self.0.iter().find(|(own, _)| *own == name).map(|(_, value)| match value {
            PreparedValue::Number(number) => choice::Value::Real(*number),
            PreparedValue::Word(word) => choice::Value::Word(word),
            PreparedValue::Matrix { rows, columns, elements } => {
                choice::Value::Matrix { rows: *rows, columns: *columns, elements }
            }
            PreparedValue::Choice { name, values } => choice::Value::Choice { name, values },
            PreparedValue::Function(function) => choice::Value::Function(&**function),
        })
    }
}
