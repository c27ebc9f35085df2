//! The interval that a rate keeps λ in.

use crate::choice::{Parameter, Range, Value, Values};
use crate::error::Error;
use forgetting_kernels::Real;

/// The smallest λ of a design that adapts.
pub const SMALLEST: Parameter = Parameter::real(
    "smallest",
    0.9,
    Range::FRACTION,
    "smallest forgetting factor: bounds how much one sample forgets",
);

/// The largest λ of a design that adapts, `default` when not given.
pub const fn largest(default: f64, range: Range) -> Parameter {
    const ABOUT: &str = "largest forgetting factor, at least the smallest; below 1 it bounds the \
                         information, so that the estimate never stops adapting";
    Parameter::real("largest", default, range, ABOUT)
}

/// λ in [smallest, largest].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits<T> {
    smallest: T,
    largest: T,
}

impl<T: Real> Limits<T> {
    /// With 0 < `smallest` ≤ `largest` ≤ 1.
    ///
    /// # Errors
    /// [`Error::Value`] names the one that is out of range.
    pub fn new(smallest: T, largest: T) -> Result<Self, Error> {
        SMALLEST.check(smallest)?;
        self::largest(1.0, Range::FRACTION).check(largest)?;
        if smallest <= largest {
            Ok(Self { smallest, largest })
        } else {
            Err(Error::value("largest", largest.to_f64(), "[smallest, 1]"))
        }
    }

    /// From the values of the parameters `smallest` and this `largest`.
    pub(super) fn configure(values: &dyn Values, largest: &Parameter) -> Result<Self, Error> {
        Self::new(SMALLEST.number(values)?, largest.number(values)?)
    }

    /// Names both.
    pub(super) fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each("smallest", Value::Real(self.smallest.to_f64()));
        each("largest", Value::Real(self.largest.to_f64()));
    }

    /// The smallest λ.
    #[inline]
    pub fn smallest(&self) -> T {
        self.smallest
    }

    /// The largest λ.
    #[inline]
    pub fn largest(&self) -> T {
        self.largest
    }

    /// The nearest number in the interval; its smallest for what is not a number.
    #[inline]
    pub fn clip(&self, x: T) -> T {
        if x >= self.largest {
            self.largest
        } else if x > self.smallest {
            x
        } else {
            self.smallest
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Error, Limits};

    #[test]
    fn clips_every_number_and_what_is_not_one() {
        let limits = Limits::new(0.5, 0.9).unwrap();
        let clipped = [f64::NAN, -1.0, 0.5, 0.7, 0.9, 1.0, f64::INFINITY].map(|x| limits.clip(x));
        assert_eq!(clipped, [0.5, 0.5, 0.5, 0.7, 0.9, 0.9, 0.9]);
        assert!(matches!(Limits::new(0.9, 0.5), Err(Error::Value { parameter: "largest", .. })));
        assert!(matches!(Limits::new(0.0, 0.5), Err(Error::Value { parameter: "smallest", .. })));
    }
}
