//! A fast and a slow average of the same numbers.

use crate::choice::{Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::state::Visitor;
use forgetting_kernels::Real;

const SHORT: Parameter = Parameter::real(
    "short_memory",
    2.0,
    Range::AT_LEAST_ONE,
    "memory of the fast average, in multiples of the number of parameters",
);
const LONG: Parameter = Parameter::real(
    "long_memory",
    10.0,
    Range::AT_LEAST_ONE,
    "memory of the slow average, in multiples of the number of parameters, more than the short one",
);

/// How long each average remembers: K_a < K_b times n samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memories<T> {
    short: T,
    long: T,
}

impl<T: Real> Memories<T> {
    pub(super) const PARAMETERS: [Parameter; 2] = [SHORT, LONG];

    /// With 1 ≤ `short` < `long`.
    ///
    /// # Errors
    /// [`Error::Value`] names the one that is out of range.
    pub fn new(short: T, long: T) -> Result<Self, Error> {
        SHORT.check(short)?;
        LONG.check(long)?;
        if long > short {
            Ok(Self { short, long })
        } else {
            Err(Error::value("long_memory", long.to_f64(), "more than short_memory"))
        }
    }

    /// From the values of the parameters.
    pub(super) fn configure(values: &dyn Values) -> Result<Self, Error> {
        Self::new(SHORT.number(values)?, LONG.number(values)?)
    }

    /// Names both.
    pub(super) fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(SHORT.name, Value::Real(self.short.to_f64()));
        each(LONG.name, Value::Real(self.long.to_f64()));
    }
}

/// The plain mean at first, then exponential averages: A ← A + (x − A)/min(K n, m) with the m-th
/// number x.
#[derive(Clone, Copy, Debug)]
pub struct Averages<T> {
    /// over K_a n samples
    pub fast: T,
    /// over K_b n samples
    pub slow: T,
}

impl<T: Real> Averages<T> {
    /// Of no numbers.
    pub const START: Self = Self { fast: T::ZERO, slow: T::ZERO };

    /// With one more number `x`, of sample number `samples` of a problem of n parameters.
    #[inline]
    pub fn with(mut self, x: T, memories: &Memories<T>, n: usize, samples: u64) -> Self {
        let (n, count) = (T::from_f64(n as f64), T::from_f64(samples as f64 + 1.0));
        self.fast += (x - self.fast) / (memories.short * n).min(count);
        self.slow += (x - self.slow) / (memories.long * n).min(count);
        self
    }

    /// Whether both can be averages of numbers that are at most `most`.
    pub fn are_sound(&self, most: T) -> bool {
        // an average rounds; no power of two is ever that near to the range's end
        let most = most + most * T::EPSILON.sqrt();
        [self.fast, self.slow].iter().all(|x| *x >= T::ZERO && *x <= most)
    }

    /// Shows both to `visitor`.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(core::slice::from_mut(&mut self.fast));
        visitor.reals(core::slice::from_mut(&mut self.slow));
    }
}

#[cfg(test)]
mod tests {
    use super::{Averages, Error, Memories};

    #[test]
    fn averages_are_plain_means_then_exponential() {
        let memories = Memories::new(1.0, 2.0).unwrap();
        let mut averages = Averages::START;
        for (k, x) in [6.0, 2.0, 4.0].into_iter().enumerate() {
            averages = averages.with(x, &memories, 2, k as u64);
        }
        // fast over 2 samples: 6, 4, then 4 + (4 - 4)/2; slow over 4: the mean of three
        assert_eq!((averages.fast, averages.slow), (4.0, 4.0));
        averages = averages.with(8.0, &memories, 2, 3).with(0.0, &memories, 2, 4);
        assert_eq!((averages.fast, averages.slow), (3.0, 3.75));
    }

    #[test]
    fn refuses_memories_that_are_not_one_longer_than_the_other() {
        let refused = [(0.5, 2.0), (2.0, 2.0), (f64::NAN, 2.0), (1.0, f64::INFINITY)];
        assert!(refused
            .iter()
            .all(|&(a, b)| matches!(Memories::new(a, b), Err(Error::Value { .. }))));
    }
}
