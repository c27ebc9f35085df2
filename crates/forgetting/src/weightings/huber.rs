//! Trusts a sample fully up to a threshold, and clips what its error exceeds it by.
//!
//! ```text
//! r_k = ‖ē_k‖ over the rows, of the target where it is longest     ē = Γ^(−1/2)(y − φθ)
//! w_k = min(1, c/r_k)                                              Γ ← Γ/w
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | c | threshold | (0, ∞) | 1.345 |
//!
//! - Bounded influence: w r ≤ c. One sample moves θ_i of any target by at most
//!   c ‖(P̄φ̄ᵀ)_i‖ ≤ c √(P̄_ii tr φ̄P̄φ̄ᵀ), whatever y is: θ₊ − θ = w P̄φ̄ᵀ(I + w φ̄P̄φ̄ᵀ)⁻¹ē, and no
//!   direction of the inverse is longer than 1. φ̄ is whitened, without the weight. With uniform or
//!   directional forgetting P̄ ≤ P/λ.
//! - The error is not normalized by 1 + φ̄Pφ̄ᵀ: the bound would grow by its root. A large first error
//!   is still corrected at once, for then P̄ is large.
//! - Rates see the clipped error w ē, so that an outlier makes none of them forget more than an
//!   error of c.
//! - c is in standard deviations of the noise, if Γ is its covariance. With 1.345 the estimate of a
//!   constant that solves Σ w ē = 0 has 95 % of the efficiency of least squares in Gaussian noise;
//!   the recursion, of which the gain is 1/Σ w, has 92.3 %.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, w = 1.
//! - Cost: O(p m). State: none.
//! - Use it when some samples are gross errors. One in φ is not recognized.
//! - Not where a large error is news: a jump of θ is followed more slowly.
//!
//! Reference: P. J. Huber, *Robust estimation of a location parameter*, Annals of Mathematical
//! Statistics 35(1), 1964.

use super::Weighting;
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::sample::Evidence;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const THRESHOLD: Parameter = Parameter::real(
    "threshold",
    1.345,
    Range::POSITIVE,
    "length of the whitened error from which it is clipped",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[THRESHOLD]);

/// w = min(1, c/r); see [`self`](crate::weightings::huber).
#[derive(Clone, Copy, Debug)]
pub struct Huber<M: Memory> {
    threshold: M::Real,
}

impl<M: Memory> Huber<M> {
    /// With the threshold c.
    ///
    /// # Errors
    /// [`Error::Value`] unless `threshold` is positive.
    pub fn new(threshold: M::Real) -> Result<Self, Error> {
        Ok(Self { threshold: THRESHOLD.check(threshold)? })
    }
}

impl<M: Memory> Weighting<M> for Huber<M> {
    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(THRESHOLD.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(THRESHOLD.name, Value::Real(self.threshold.to_f64()));
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn weight(&self, evidence: &Evidence<'_, '_, M>) -> M::Real {
        let r = evidence.standardized(evidence.largest_squared_error()).sqrt();
        if r > self.threshold {
            (self.threshold / r).max(M::Real::FLOOR)
        } else {
            M::Real::ONE
        }
    }

    fn influence(&self, _: usize) -> Option<M::Real> {
        Some(self.threshold)
    }
}

#[cfg(test)]
mod tests {
    use super::Huber;
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::{Dynamic, Fixed};
    use crate::rates::Constant;
    use crate::rules::NoForgetting;
    use crate::sample::Noise;

    /// w = 2/4: P₊ = 1/(1 + w), θ₊ = P₊ w 4.
    #[test]
    fn clips_the_error_beyond_the_threshold() {
        let memory = Fixed::<f64, 1>::new();
        let (rate, prior) = (Constant::new(1.0).unwrap(), Prior::scalar(memory, 1.0).unwrap());
        let huber = Huber::new(2.0).unwrap();
        let mut estimator = Estimator::new(NoForgetting::new(), rate, huber, prior);
        let update = estimator.update_with_noise(&[3.0], &[12.0], Noise::Scalar(9.0)).unwrap();
        assert_eq!(update.error, [12.0]);
        assert!((update.leverage - 0.5).abs() < 1e-15);
        assert!((estimator.theta()[0] - 2.0 / 1.5).abs() < 1e-15);
    }

    #[test]
    fn the_target_with_the_longest_error_counts() {
        let memory = Dynamic::<f64>::new(1, 2, 2).unwrap();
        let (rate, prior) = (Constant::new(1.0).unwrap(), Prior::scalar(memory, 1.0).unwrap());
        let huber = Huber::new(2.0).unwrap();
        let mut estimator = Estimator::new(NoForgetting::new(), rate, huber, prior);
        // lengths 3 and 4: w = 2/4; φ = (1, 0)
        estimator.update(&[1.0, 0.0], &[3.0, 0.0, 0.0, 4.0]).unwrap();
        assert!((estimator.theta()[0] - 0.5 * 3.0 / 1.5).abs() < 1e-15);
        assert_eq!(estimator.theta()[1], 0.0);
    }
}
