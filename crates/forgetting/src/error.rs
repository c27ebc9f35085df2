//! What can be refused, and how it is said.

use core::fmt;

/// Why something was refused. Whatever was refused has changed nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Error {
    /// A value outside its allowed range.
    Value {
        /// name of the parameter
        parameter: &'static str,
        /// position in it, where it has more than one value
        index: Option<usize>,
        /// the value given
        value: f64,
        /// the values allowed, in words or as an interval
        allowed: &'static str,
    },
    /// A number of elements other than the one needed.
    Length {
        /// name of the parameter
        parameter: &'static str,
        /// number of elements given
        length: usize,
        /// number of elements needed
        expected: usize,
    },
    /// A matrix that must be positive (semi-)definite and is not.
    Indefinite {
        /// name of the parameter
        parameter: &'static str,
        /// the pivot at which the factorization failed
        pivot: f64,
        /// "positive definite" or "positive semidefinite"
        allowed: &'static str,
    },
    /// A parameter that must be given and was not.
    Missing {
        /// name of the parameter
        parameter: &'static str,
    },
    /// A name that the registry does not know.
    Unknown {
        /// what was looked up: "rule", "rate" or "weighting"
        parameter: &'static str,
    },
    /// A quantity that would leave the range of the number type.
    Range {
        /// name of the quantity
        parameter: &'static str,
        /// the value it would take
        value: f64,
        /// the largest magnitude allowed
        limit: f64,
    },
    /// A function of the user's that failed.
    Function {
        /// name of the parameter that it was given for
        parameter: &'static str,
    },
    /// A combination of choices that has no meaning.
    Unsupported {
        /// what does not go together, and what does
        reason: &'static str,
    },
    /// More memory than there is.
    Memory,
    /// A saved state that cannot be read.
    State {
        /// what is wrong with it
        reason: &'static str,
    },
}

impl Error {
    /// A single value outside its range.
    pub fn value(parameter: &'static str, value: f64, allowed: &'static str) -> Self {
        Self::Value { parameter, index: None, value, allowed }
    }

    /// The same error, of the value at this position.
    #[must_use]
    pub fn at(self, position: usize) -> Self {
        match self {
            Self::Value { parameter, value, allowed, .. } => {
                Self::Value { parameter, index: Some(position), value, allowed }
            }
            error => error,
        }
    }

    /// Refuses a `length` other than `expected`.
    #[inline(always)]
    pub fn check_length(
        parameter: &'static str,
        length: usize,
        expected: usize,
    ) -> Result<(), Self> {
        if length == expected {
            Ok(())
        } else {
            Err(Self::Length { parameter, length, expected })
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Value { parameter, index: None, value, allowed } => {
                write!(f, "{parameter} = {}, allowed: {allowed}", Short(value))
            }
            Self::Value { parameter, index: Some(index), value, allowed } => {
                write!(f, "{parameter}[{index}] = {}, allowed: {allowed}", Short(value))
            }
            Self::Length { parameter, length, expected } => {
                write!(f, "{parameter} has {length} elements, expected {expected}")
            }
            Self::Indefinite { parameter, pivot, allowed } => {
                write!(f, "{parameter} is not {allowed} (pivot {pivot:e})")
            }
            Self::Missing { parameter } => write!(f, "{parameter} is required"),
            Self::Unknown { parameter } => write!(f, "unknown {parameter}"),
            Self::Range { parameter, value, limit } => {
                write!(f, "{parameter} = {value:e} exceeds the numerical range, limit {limit:e}")
            }
            Self::Function { parameter } => write!(f, "the function given for {parameter} failed"),
            Self::Unsupported { reason } => f.write_str(reason),
            Self::Memory => f.write_str("there is not enough memory"),
            Self::State { reason } => write!(f, "state: {reason}"),
        }
    }
}

impl core::error::Error for Error {}

/// A number with a power of ten where it would be a long row of zeros.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(x) = *self;
        match x == 0.0 || !x.is_finite() || (1e-5..1e21).contains(&x.max(-x)) {
            true => write!(f, "{x}"),
            false => write!(f, "{x:e}"),
        }
    }
}
