//! A rule, a rate, a weighting or a gate by name, with values for its parameters.

mod describe;
mod make;

pub(crate) use describe::has_function;

use crate::error::Error;
use crate::function::Function;
use std::sync::Arc;

/// A name of a registry and the values of its parameters; those left out take their defaults.
#[derive(Clone, Debug)]
pub struct Choice {
    /// the registry name
    pub name: String,
    /// each parameter's name and value
    pub parameters: Vec<(String, Value)>,
}

impl Choice {
    /// By name alone.
    #[must_use]
    pub fn named(name: impl Into<String>) -> Self {
        Self { name: name.into(), parameters: Vec::new() }
    }

    /// The same with a value for this parameter.
    #[must_use]
    pub fn with(mut self, parameter: impl Into<String>, value: impl Into<Value>) -> Self {
        self.parameters.push((parameter.into(), value.into()));
        self
    }

    /// The gate that asks `function` about each sample.
    #[must_use]
    pub fn gate_function(function: Arc<dyn Function>) -> Self {
        Self::named("gate_function").with("function", function)
    }

    /// The value of the parameter `name`, if it has one.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.parameters.iter().find(|(own, _)| own == name).map(|(_, value)| value)
    }
}

/// The value of a parameter.
#[derive(Clone, Debug)]
pub enum Value {
    /// a number
    Number(f64),
    /// a word
    Word(String),
    /// rows x columns numbers, row by row; a list is one row
    Matrix {
        /// number of rows
        rows: usize,
        /// number of columns
        columns: usize,
        /// the numbers
        elements: Vec<f64>,
    },
    /// a rule
    Choice(Choice),
    /// a function of the user's
    Function(Arc<dyn Function>),
}

impl Value {
    /// The value of `parameter` that is an array of this shape: a number, a list or a matrix.
    ///
    /// # Errors
    /// [`Error`] names the parameter: more than two dimensions, or numbers that do not fill them.
    pub fn array(parameter: &str, elements: Vec<f64>, shape: &[usize]) -> Result<Self, Error> {
        let (rows, columns) = match *shape {
            [] => (1, 1),
            [columns] => (1, columns),
            [rows, columns] => (rows, columns),
            _ => {
                let dimensions = shape.len();
                return Err(Error::Dimensions { parameter: parameter.into(), dimensions });
            }
        };
        if rows.checked_mul(columns) != Some(elements.len()) {
            let expected = format!("{} numbers", elements.len());
            return Err(Error::shape(parameter, shape, expected));
        }
        match (shape, elements.as_slice()) {
            ([], &[number]) => Ok(Self::Number(number)),
            _ => Ok(Self::Matrix { rows, columns, elements }),
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Value {
    fn from(word: &str) -> Self {
        Self::Word(word.into())
    }
}

impl From<Choice> for Value {
    fn from(rule: Choice) -> Self {
        Self::Choice(rule)
    }
}

impl From<Arc<dyn Function>> for Value {
    fn from(function: Arc<dyn Function>) -> Self {
        Self::Function(function)
    }
}

/// What an estimator is made of: [`Settings`](crate::Settings) with these choices make the same.
#[derive(Clone, Debug)]
pub struct Description {
    /// where to forget
    pub rule: Choice,
    /// how much to forget
    pub rate: Choice,
    /// how far to trust a sample
    pub weighting: Choice,
    /// whether a sample is used
    pub gate: Choice,
}
