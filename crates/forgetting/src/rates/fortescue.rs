//! Keeps the information in the estimate constant: forgets as much as the sample surprised.
//!
//! ```text
//! λ_{k+1} = 1 − tr(e_kᵀ (I + S_k)⁻¹ e_k) / (m N₀ σ²)     S_k = φ̄_k P_k φ̄_kᵀ
//!         = 1 − e_k² / (N₀ σ² (1 + s_k))                 one row and one target
//! λ_{k+1} ← clip(λ_{k+1}, smallest, largest),   λ_0 = largest
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | N₀ | memory | (0, ∞) | 100 |
//! | σ² | noise_variance | (0, ∞) | 1 |
//! | λ_min | smallest | (0, 1] | 0.9 |
//! | λ_max | largest | [smallest, 1] | 1 |
//!
//! - For the next sample: the original divides P by λ after sample k, which is forgetting before
//!   sample k + 1.
//! - Keeps the discounted sum of squared errors at N₀σ²: with noise of variance σ² the memory is
//!   about N₀ samples, N₀/p with p rows.
//! - e is whitened by Γ and clipped by the weighting, so that λ does not depend on the units of y:
//!   σ² is the variance of the whitened noise, 1 where Γ is the noise covariance.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, errors count as 0.
//! - Cost: O(p n²/2 + p² n). State: the next λ.
//! - Use it when the noise variance is known and constant; else `noise_power`.
//! - Not where σ² is a guess: too small, it forgets at every sample; too large, hardly ever.
//!
//! Reference: T. R. Fortescue, L. S. Kershenbaum, B. E. Ydstie, *Implementation of self-tuning
//! regulators with variable forgetting factors*, Automatica 17(6), 1981.

use super::limits::{largest, SMALLEST};
use super::{Evidence, Limits, Needs, Next, Rate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const MEMORY: Parameter = Parameter::real(
    "memory",
    100.0,
    Range::POSITIVE,
    "memory length when the errors are nothing but noise (samples, for one row)",
);
const NOISE_VARIANCE: Parameter = Parameter::real(
    "noise_variance",
    1.0,
    Range::POSITIVE,
    "variance of the noise, in units of gamma",
);
const LARGEST: Parameter = largest(1.0, Range::FRACTION);

/// The registry entry.
pub const ABOUT: About = About::new(&[MEMORY, NOISE_VARIANCE, SMALLEST, LARGEST]);

/// Constant information; see [`self`](crate::rates::fortescue).
#[derive(Clone, Copy, Debug)]
pub struct Fortescue<M: Memory> {
    memory: M::Real,
    noise_variance: M::Real,
    limits: Limits<M::Real>,
}

impl<M: Memory> Fortescue<M> {
    /// With the memory N₀ and the noise variance σ².
    ///
    /// # Errors
    /// [`Error::Value`] unless both are positive.
    pub fn new(
        memory: M::Real,
        noise_variance: M::Real,
        limits: Limits<M::Real>,
    ) -> Result<Self, Error> {
        let memory = MEMORY.check(memory)?;
        Ok(Self { memory, noise_variance: NOISE_VARIANCE.check(noise_variance)?, limits })
    }
}

impl<M: Memory> Rate<M> for Fortescue<M> {
    type State = Next<M::Real>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        let limits = Limits::configure(values, &LARGEST)?;
        Self::new(MEMORY.number(values)?, NOISE_VARIANCE.number(values)?, limits)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(MEMORY.name, Value::Real(self.memory.to_f64()));
        each(NOISE_VARIANCE.name, Value::Real(self.noise_variance.to_f64()));
        self.limits.describe(each);
    }

    fn start(&self, _: M) -> Self::State {
        Next(self.limits.largest())
    }

    #[inline]
    fn needs(&self) -> Needs {
        Needs::NormalizedError
    }

    #[inline]
    fn forgetting_factor(
        &self,
        next: &Self::State,
        _: &Evidence<'_, '_, M>,
    ) -> Result<M::Real, Error> {
        Ok(self.limits.clip(next.0))
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn learn(&self, next: &mut Self::State, evidence: &Evidence<'_, '_, M>, _: M::Real) {
        let total = self.memory * self.noise_variance;
        let squared = evidence.standardized(evidence.normalized_error);
        next.0 = self.limits.clip(M::Real::ONE - squared / total);
    }
}

#[cfg(test)]
mod tests {
    use super::{Fortescue, Limits};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::{Dynamic, Fixed};
    use crate::rules::Exponential;
    use crate::sample::Noise;
    use crate::weightings::Equal;

    #[test]
    fn one_row_is_the_published_form_one_sample_later() {
        let rate = Fortescue::new(100.0, 0.02, Limits::new(0.5, 0.99).unwrap()).unwrap();
        let prior = Prior::scalar(Fixed::<f64, 1>::new(), 3.0).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        let mut factor = || estimator.update(&[1.0], &[1.0]).unwrap().forgetting_factor;
        // s = 3, e = 1
        assert_eq!((factor(), factor()), (0.99, 1.0 - 1.0 / (2.0 * 4.0)));
    }

    /// P = 2 I, Γ = diag(1, 4), φ̄ = [[1, 1], [1, 0]]: I + S = [[5, 2], [2, 3]], determinant 11;
    /// e = (1, 2): eᵀ(I + S)⁻¹e = (3 − 8 + 20)/11.
    #[test]
    fn rows_share_the_inverse_of_their_covariance() {
        let memory = Dynamic::<f64>::new(2, 2, 1).unwrap();
        let rate = Fortescue::new(100.0, 1.0, Limits::new(0.5, 1.0).unwrap()).unwrap();
        let prior = Prior::scalar(memory, 2.0).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        let noise = [1.0, 0.0, 0.0, 4.0];
        estimator
            .update_with_noise(&[1.0, 1.0, 2.0, 0.0], &[1.0, 4.0], Noise::Full(&noise))
            .unwrap();
        let next = estimator.update(&[1.0, 0.0, 0.0, 1.0], &[0.0, 0.0]).unwrap().forgetting_factor;
        assert!((next - (1.0 - 15.0 / 11.0 / 100.0)).abs() < 1e-15);
    }

    /// Two equal rows with a large P: I + S is all but singular, eᵀ(I + S)⁻¹e is not.
    #[test]
    fn nothing_is_lost_when_the_rows_are_equal_and_uncertain() {
        let memory = Dynamic::<f64>::new(1, 2, 1).unwrap();
        let rate = Fortescue::new(10.0, 1.0, Limits::new(0.5, 1.0).unwrap()).unwrap();
        let prior = Prior::scalar(memory, 1e18).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        estimator.update(&[1.0, 1.0], &[1.0, -1.0]).unwrap();
        // the difference of the two is certain: (1 - (-1))²/2 = 2
        let next = estimator.update(&[1.0, 1.0], &[0.0, 0.0]).unwrap().forgetting_factor;
        assert!((next - 0.8).abs() < 1e-15, "{next}");
    }
}
