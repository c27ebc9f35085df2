//! Forgets only in the direction of the regressor, for one row, and skips regressors too short to inform.
//!
//! ```text
//! F_k = (1 − λ_k) R φ̄ᵀ φ̄ R / (φ̄ R φ̄ᵀ)      GF-RLS (63), if ‖φ̄‖ > threshold
//! P̄ = P + (1 − λ)/λ · φ̄ᵀ φ̄ / (φ̄ R φ̄ᵀ)      GF-RLS (62), with its transposes; the form used:
//!                                          one dyad, φ̄ R φ̄ᵀ = ‖D^(−1/2) U⁻¹ φ̄ᵀ‖² by one solve
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | ε | threshold | [0, ∞) | 1e-6 |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): if threshold > 0 and λ_k ≥ λ_min > 0:
//!   R_k ≥ min(threshold²/(1 − λ_min), λ_min(R₀)) I.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and ‖φ̄‖² ≤ β: R_k ≤ max(β/(1 − λ_max), λ_max(R₀)) I.
//! - Cost: O(n²), one row only. State: P alone.
//! - As printed, (58) still learns from regressors below the threshold; they would be accumulated
//!   and never forgotten, without bound. Here they are skipped altogether, which is what the two
//!   bounds rest on.
//! - Use it to compare with work that used it, with one row; `subspace` is the same for several.
//!
//! Reference: L. Cao, H. M. Schwartz, *A directional forgetting algorithm based on the
//! decomposition of the information matrix*, Automatica 36, 2000.

use super::along_sample::forget_along_sample;
use super::{Forgetting, Forgotten, Skip, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value,
    Values,
};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;
use forgetting_kernels::kernel::form::{DeadZone, Form};

const THRESHOLD: Parameter = Parameter::real(
    "threshold",
    1e-6,
    Range::NON_NEGATIVE,
    "length of the whitened regressor above which it counts as information (units of phi)",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    largest_rows: Some(1),
    cost: "O(n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::when(
            "threshold > 0, forgetting factor >= lambda_min > 0",
            Setting::usual(Input::Fading(1e-6)).with(&[("threshold", Value::Real(0.0))]),
        ),
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[THRESHOLD])
};

/// Forgets in the direction of the regressor; see [`self`](crate::rules::directional).
#[derive(Clone, Copy, Debug)]
pub struct Directional<M: Memory> {
    threshold: M::Real,
}

impl<M: Memory> Directional<M> {
    /// With the length of φ̄ above which it counts as information.
    ///
    /// # Errors
    /// [`Error::Value`] if `threshold` is negative.
    pub fn new(threshold: M::Real) -> Result<Self, Error> {
        Ok(Self { threshold: THRESHOLD.check(threshold)? })
    }
}

impl<M: Memory> Forgetting<M> for Directional<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(THRESHOLD.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(THRESHOLD.name, Value::Real(self.threshold.to_f64()));
    }

    fn start(&self, _: M) {}

    fn is_bounded(&self) -> bool {
        self.threshold > M::Real::ZERO
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        constants.along_samples(self.threshold.to_f64())
    }

    #[inline]
    fn form(&self, forgetting_factor: M::Real, _: M::Real) -> Option<Form<M::Real>> {
        let weight = (M::Real::ONE - forgetting_factor) / forgetting_factor;
        Some(Form::Along { weight, dead_zone: DeadZone::UpTo(self.threshold) })
    }

    #[inline]
    fn forget(&self, (): &mut (), mut step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        if !(step.sample.squared_regressors().sqrt() > self.threshold) {
            return Ok(Forgotten::skipped(Skip::DeadZone));
        }
        forget_along_sample(&mut step).map(Forgotten::rank)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget, Dense};

    #[test]
    fn forgets_as_printed_with_the_transposes_back() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let r = p.inverse();
        let image = r.clone() * phi.transpose();
        let energy = (phi.clone() * image.clone()).at(0, 0);
        let lost = (0.1 / energy) * (image.clone() * image.transpose()); // (63), λ = 0.9
        let outcome = forget(&Directional::new(1e-3).unwrap(), &mut (), &p, &phi, 0.9);
        assert!(outcome.covariance.distance(&(r - lost).inverse()) < 1e-14);
        assert_eq!(outcome.forgotten.rank, 1);
    }

    #[test]
    fn skips_what_is_not_above_the_threshold() {
        let phi = Dense::new(1, &[0.5, 0.0, 0.0]);
        let forgotten = |threshold| {
            forget(&Directional::new(threshold).unwrap(), &mut (), &covariance(), &phi, 0.9)
                .forgotten
        };
        assert_eq!(forgotten(0.5).skipped, Some(Skip::DeadZone));
        assert_eq!(forgotten(0.49).skipped, None);
    }
}
