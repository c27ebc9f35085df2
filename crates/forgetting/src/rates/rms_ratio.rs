//! Forgets when the recent errors are larger than they used to be.
//!
//! ```text
//! g_k = √(mean of ‖e‖² over the last τ_n / mean of ‖e‖² over the last τ_d) − 1
//! λ_k = 1/(1 + η g_k) if g_k > 0, else 1
//! λ_k ← clip(λ_k, smallest, largest)
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | η | sensitivity | [0, ∞) | 0.1 |
//! | τ_n | short_window | 1, 2, ... | 10 |
//! | τ_d | long_window | more than short_window | 100 |
//! | λ_min | smallest | (0, 1] | 0.9 |
//! | λ_max | largest | [smallest, 1] | 1 |
//!
//! - Uses this sample: both windows include it. Until τ_d samples were seen, and while their mean
//!   is 0, λ = largest.
//! - Only a ratio of errors counts: λ depends neither on the units of y nor on the noise variance.
//!   e is whitened by Γ and clipped by the weighting; ‖e‖² is the sum over rows and targets.
//! - Cost: O(τ_d) additions; the sums are formed anew, so that they do not drift. State: τ_d
//!   numbers.
//! - Use it when the noise variance is unknown. A change is noticed only once, against the errors
//!   of before.
//! - Not for slow drift: both windows then see the same errors.
//!
//! Reference: A. L. Bruce, A. Goel, D. S. Bernstein, *Convergence and consistency of recursive
//! least squares with variable-rate forgetting*, Automatica 119, 2020.

use super::limits::{largest, SMALLEST};
use super::{Evidence, Limits, Rate, Windows};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::memory::state::{State, Visitor};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;
use core::marker::PhantomData;

pub(super) const SENSITIVITY: Parameter = Parameter::real(
    "sensitivity",
    0.1,
    Range::NON_NEGATIVE,
    "how much to forget for a relative growth of the error of 1",
);
const LARGEST: Parameter = largest(1.0, Range::FRACTION);

/// The registry entry.
pub const ABOUT: About =
    About::new(&[SENSITIVITY, Windows::PARAMETERS[0], Windows::PARAMETERS[1], SMALLEST, LARGEST]);

/// λ from the growth of the error; see [`self`](crate::rates::rms_ratio).
#[derive(Clone, Copy, Debug)]
pub struct RmsRatio<M: Memory> {
    sensitivity: M::Real,
    windows: Windows,
    limits: Limits<M::Real>,
    memory: PhantomData<M>,
}

/// The last τ_d − 1 squared errors, in a ring; 0 where the next one goes.
#[derive(Clone, Debug)]
pub struct Past<M: Memory>(pub(super) M::List);

impl<M: Memory> State<M::Real> for Past<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.0.as_mut());
    }
}

impl<M: Memory> RmsRatio<M> {
    /// With the sensitivity η, for lists of this `memory`.
    ///
    /// # Errors
    /// [`Error::Value`] unless `sensitivity` ≥ 0 and the long window has room in a list.
    pub fn new(
        memory: M,
        sensitivity: M::Real,
        windows: Windows,
        limits: Limits<M::Real>,
    ) -> Result<Self, Error> {
        windows.fit(memory, 1, 0)?;
        let sensitivity = SENSITIVITY.check(sensitivity)?;
        Ok(Self { sensitivity, windows, limits, memory: PhantomData })
    }
}

/// 1/(1 + η g), or 1 when g is not positive.
#[inline]
pub(super) fn factor<T: Real>(sensitivity: T, g: T) -> T {
    if g > T::ZERO {
        T::ONE / (T::ONE + sensitivity * g)
    } else {
        T::ONE
    }
}

impl<M: Memory> Rate<M> for RmsRatio<M> {
    type State = Past<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let limits = Limits::configure(values, &LARGEST)?;
        Self::new(memory, SENSITIVITY.number(values)?, Windows::configure(values)?, limits)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(SENSITIVITY.name, Value::Real(self.sensitivity.to_f64()));
        self.windows.describe(each);
        self.limits.describe(each);
    }

    fn start(&self, memory: M) -> Self::State {
        Past(memory.list(self.windows.long()))
    }

    #[inline]
    fn forgetting_factor(
        &self,
        past: &Self::State,
        evidence: &Evidence<'_, '_, M>,
    ) -> Result<M::Real, Error> {
        let (past, place) = (past.0.as_ref(), self.windows.place(evidence.samples));
        let now = evidence.squared_error;
        let long = past[..self.windows.long()].iter().fold(now, |sum, &square| sum + square);
        if !self.windows.full(evidence.samples) || long <= M::Real::ZERO {
            return Ok(self.limits.largest());
        }
        let short = self.windows.recent(place).fold(now, |sum, k| sum + past[k]);
        let mean = |sum: M::Real, count: usize| sum / M::Real::from_f64(count as f64);
        let ratio = mean(short, self.windows.short()) / mean(long, self.windows.long());
        let lambda = factor(self.sensitivity, ratio.sqrt() - M::Real::ONE);
        Ok(self.limits.clip(lambda))
    }

    #[inline]
    fn learn(&self, past: &mut Self::State, evidence: &Evidence<'_, '_, M>, _: M::Real) {
        let (past, samples) = (past.0.as_mut(), evidence.samples);
        past[self.windows.place(samples)] = evidence.squared_error;
        // no later window has the oldest
        past[self.windows.place(samples + 1)] = M::Real::ZERO;
    }
}

#[cfg(test)]
mod tests {
    use super::{Limits, RmsRatio, Windows};
    use crate::covariance::Prior;
    use crate::error::Error;
    use crate::estimator::Estimator;
    use crate::memory::Fixed;
    use crate::rules::Exponential;
    use crate::weightings::Equal;

    #[test]
    fn compares_the_last_errors_with_those_before() {
        let memory = Fixed::<f64, 1, 1, 1, 4>::new();
        let (windows, limits) = (Windows::new(2, 4).unwrap(), Limits::new(0.1, 1.0).unwrap());
        let rate = RmsRatio::new(memory, 0.5, windows, limits).unwrap();
        let prior = Prior::scalar(memory, 1.0).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        let mut take = |e: f64| estimator.update(&[0.0], &[e]).unwrap().forgetting_factor;
        // the window is not full
        assert_eq!([take(1.0), take(2.0), take(3.0)], [1.0; 3]);
        // 9 + 16 over two, 1 + 4 + 9 + 16 over four
        let g = libm::sqrt(12.5 / 7.5) - 1.0;
        assert_eq!(take(4.0), 1.0 / (1.0 + 0.5 * g));
        // 16 + 1 over two, 4 + 9 + 16 + 1 over four
        let g = libm::sqrt(8.5 / 7.5) - 1.0;
        assert_eq!(take(1.0), 1.0 / (1.0 + 0.5 * g));
        // less error than before
        assert_eq!(take(0.0), 1.0);
    }

    #[test]
    fn refuses_a_window_that_does_not_fit() {
        let memory = Fixed::<f64, 1, 1, 1, 4>::new();
        let (windows, limits) = (Windows::new(2, 5).unwrap(), Limits::new(0.1, 1.0).unwrap());
        let refused = RmsRatio::new(memory, 0.5, windows, limits);
        assert!(matches!(refused, Err(Error::Value { parameter: "long_window", .. })));
    }
}
