//! Forgets more the larger the prediction error, less the less certain the estimate.
//!
//! ```text
//! λ_k = 1 − ‖e_k‖² / ((η + ‖e_k‖²) (p + tr S_k))     S_k = φ̄_k P_k φ̄_kᵀ     Zhu et al. (21)
//! λ_k ← clip(λ_k, smallest, largest)
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | η | sensitivity | (0, ∞) | 1 |
//! | λ_min | smallest | (0, 1] | 0.9 |
//! | λ_max | largest | [smallest, 1] | 0.999 |
//!
//! - Uses this sample: λ_k forgets before φ_k is learned from.
//! - e is whitened by Γ and clipped by the weighting, so that λ does not depend on the units of y;
//!   ‖e‖² is the sum over the p rows, averaged over targets.
//! - η is in units of ‖e‖²: the squared error that has half of the effect of a very large one.
//!   Small is sensitive.
//! - λ_k is in (1 − 1/p, 1] without the clip, and is 1 when the error is 0: it is `largest` < 1
//!   that bounds the information.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, errors count as 0.
//! - Cost: O(p n²/2) for tr S. State: none.
//! - Use it when jumps show in the error at once and the noise is small beside them.
//! - Not where noise is large beside the changes: every large error is then taken for one.
//!
//! Reference: K. Zhu, C. Yu, Y. Wan, *Recursive least squares identification with
//! variable-direction forgetting via oblique projection decomposition*, IEEE/CAA Journal of
//! Automatica Sinica 9(3), 2022, (21); after S. Bertin, S. Bittanti, P. Bolzern, *Tracking of
//! nonstationary systems by means of different prediction error directional forgetting
//! techniques*, 1987.

use super::limits::{largest, SMALLEST};
use super::{Evidence, Limits, Needs, Rate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const SENSITIVITY: Parameter = Parameter::real(
    "sensitivity",
    1.0,
    Range::POSITIVE,
    "squared whitened error that has half of the full effect; small is sensitive",
);
const LARGEST: Parameter = largest(0.999, Range::FRACTION);

/// The registry entry.
pub const ABOUT: About = About::new(&[SENSITIVITY, SMALLEST, LARGEST]);

/// λ from the prediction error; see [`self`](crate::rates::prediction_error).
#[derive(Clone, Copy, Debug)]
pub struct PredictionError<M: Memory> {
    sensitivity: M::Real,
    limits: Limits<M::Real>,
}

impl<M: Memory> PredictionError<M> {
    /// With the squared error η that has half of the full effect.
    ///
    /// # Errors
    /// [`Error::Value`] unless `sensitivity` is positive.
    pub fn new(sensitivity: M::Real, limits: Limits<M::Real>) -> Result<Self, Error> {
        Ok(Self { sensitivity: SENSITIVITY.check(sensitivity)?, limits })
    }
}

impl<M: Memory> Rate<M> for PredictionError<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(SENSITIVITY.number(values)?, Limits::configure(values, &LARGEST)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(SENSITIVITY.name, Value::Real(self.sensitivity.to_f64()));
        self.limits.describe(each);
    }

    fn start(&self, _: M) {}

    #[inline]
    fn needs(&self) -> Needs {
        Needs::Leverage
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn forgetting_factor(&self, (): &(), evidence: &Evidence<'_, '_, M>) -> Result<M::Real, Error> {
        let Evidence { leverage, rows, .. } = *evidence;
        let squared_error = evidence.standardized(evidence.squared_error);
        let effect = squared_error / (self.sensitivity + squared_error);
        let spread = M::Real::from_f64(rows as f64) + leverage;
        Ok(self.limits.clip(M::Real::ONE - effect / spread))
    }
}

#[cfg(test)]
mod tests {
    use super::{Limits, PredictionError};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Fixed;
    use crate::rules::Exponential;
    use crate::weightings::Equal;

    #[test]
    fn is_one_less_the_effect_over_the_spread() {
        let memory = Fixed::<f64, 1>::new();
        let rate = PredictionError::new(4.0, Limits::new(0.1, 1.0).unwrap()).unwrap();
        let prior = Prior::scalar(memory, 3.0).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        // e = 2, s = 3: 1 - 4/8/(1 + 3)
        assert_eq!(estimator.update(&[1.0], &[2.0]).unwrap().forgetting_factor, 0.875);
    }
}
