//! Does not forget at all while the error is within the noise, and halves the memory beyond.
//!
//! ```text
//! L_k = ⌊ρ ‖e_k‖²/p + ½⌋
//! λ_k = λ_min + (1 − λ_min) 2^(−L_k)
//! λ_k ← clip(λ_k, smallest, largest)
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | ρ | sensitivity | (0, ∞) | 0.05 |
//! | λ_min | smallest | (0, 1] | 0.9 |
//! | λ_max | largest | [smallest, 1] | 1 |
//!
//! - Uses this sample. One row is the printed form.
//! - λ_k = 1, then clipped to `largest`, while ρ‖e‖²/p < ½: the unity zone. With the default it
//!   reaches to three standard deviations of the noise, if Γ is its covariance.
//! - e is whitened by Γ and clipped by the weighting: λ does not depend on the units of y. ‖e‖² is
//!   the sum over the p rows, averaged over targets.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, errors count as 0.
//! - Cost: O(1). State: none.
//! - Use it for parameters that are constant but for jumps.
//! - Not for slow drift: while its errors stay within the noise, nothing is forgotten.
//!
//! Reference: D. J. Park, B. E. Jun, J. H. Kim, *Fast tracking RLS algorithm using novel variable
//! forgetting factor with unity zone*, Electronics Letters 27(23), 1991.

use super::limits::{largest, SMALLEST};
use super::{Evidence, Limits, Rate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const SENSITIVITY: Parameter = Parameter::real(
    "sensitivity",
    0.05,
    Range::POSITIVE,
    "halvings of the way to the smallest factor for each unit of squared whitened error",
);
const LARGEST: Parameter = largest(1.0, Range::FRACTION);

/// The registry entry.
pub const ABOUT: About = About::new(&[SENSITIVITY, SMALLEST, LARGEST]);

/// λ = 1 within the noise; see [`self`](crate::rates::unity_zone).
#[derive(Clone, Copy, Debug)]
pub struct UnityZone<M: Memory> {
    sensitivity: M::Real,
    limits: Limits<M::Real>,
}

impl<M: Memory> UnityZone<M> {
    /// With the sensitivity ρ.
    ///
    /// # Errors
    /// [`Error::Value`] unless `sensitivity` is positive.
    pub fn new(sensitivity: M::Real, limits: Limits<M::Real>) -> Result<Self, Error> {
        Ok(Self { sensitivity: SENSITIVITY.check(sensitivity)?, limits })
    }
}

impl<M: Memory> Rate<M> for UnityZone<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(SENSITIVITY.number(values)?, Limits::configure(values, &LARGEST)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(SENSITIVITY.name, Value::Real(self.sensitivity.to_f64()));
        self.limits.describe(each);
    }

    fn start(&self, _: M) {}

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn forgetting_factor(&self, (): &(), evidence: &Evidence<'_, '_, M>) -> Result<M::Real, Error> {
        let squared = evidence.standardized(evidence.squared_error);
        let squared = squared / M::Real::from_f64(evidence.rows as f64);
        let level = libm::floor((self.sensitivity * squared).to_f64() + 0.5);
        let (smallest, one) = (self.limits.smallest(), M::Real::ONE);
        let way = M::Real::from_f64(libm::exp2(-level));
        Ok(self.limits.clip(smallest + (one - smallest) * way))
    }
}

#[cfg(test)]
mod tests {
    use super::{Limits, UnityZone};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Fixed;
    use crate::rules::Exponential;
    use crate::weightings::Equal;

    #[test]
    fn halves_the_way_for_each_unit_beyond_the_zone() {
        let prior = Prior::scalar(Fixed::<f64, 1>::new(), 1.0).unwrap();
        let rate = UnityZone::new(1.0, Limits::new(0.5, 1.0).unwrap()).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        for (squared, expected) in
            [(0.4999f64, 1.0), (0.5, 0.75), (1.49, 0.75), (3.0, 0.5625), (1e9, 0.5)]
        {
            let y = libm::sqrt(squared) * (1.0 + 1e-12);
            assert_eq!(estimator.update(&[0.0], &[y]).unwrap().forgetting_factor, expected);
        }
    }
}
