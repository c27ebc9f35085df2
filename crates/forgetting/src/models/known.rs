//! What is known of the parameters of a model before its first sample.

use crate::error::Error;
use alloc::vec;
use alloc::vec::Vec;

/// What is known of one parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Given {
    /// nothing: it is estimated from 0
    #[default]
    Nothing,
    /// about this value: what the estimator says is how far it is from there
    Prior(f64),
    /// this value, exactly: the estimator does not have it
    Fixed(f64),
}

/// θ = values + what is estimated, at the places that are left.
#[derive(Clone, Debug)]
pub(super) struct Known {
    pub given: Vec<Given>,
    pub values: Vec<f64>,
    pub left: Vec<usize>,
}

impl Given {
    /// What the parameter is more than is estimated.
    pub fn value(self) -> f64 {
        match self {
            Self::Nothing => 0.0,
            Self::Prior(value) | Self::Fixed(value) => value,
        }
    }
}

impl Known {
    /// Nothing of n parameters.
    pub fn nothing(n: usize) -> Self {
        Self { given: vec![Given::Nothing; n], values: vec![0.0; n], left: (0..n).collect() }
    }

    /// Refuses a value that is no finite number, and a model of which nothing is left.
    pub fn new(given: &[Given]) -> Result<Self, Error> {
        let values: Vec<f64> = given.iter().map(|own| own.value()).collect();
        if let Some(i) = values.iter().position(|value| !value.is_finite()) {
            return Err(Error::value("given", values[i], "finite").at(i));
        }
        let is_left = |&i: &usize| !matches!(given[i], Given::Fixed(_));
        let left: Vec<usize> = (0..given.len()).filter(is_left).collect();
        match left.is_empty() {
            true => Err(Error::Unsupported { reason: "every parameter is fixed" }),
            false => Ok(Self { given: given.to_vec(), values, left }),
        }
    }

    /// Whether there is anything.
    pub fn is_something(&self) -> bool {
        self.given.iter().any(|given| *given != Given::Nothing)
    }
}
