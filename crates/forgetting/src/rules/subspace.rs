//! Forgets only in the directions that the sample informs (SIFt), and skips what is too small to inform.
//!
//! ```text
//! φ̄ = W S Vᵀ, keep the q singular values ≥ threshold: φ_f = W_qᵀφ̄, y_f = W_qᵀȳ
//! F_k = (1 − λ_k) R φ_fᵀ (φ_f R φ_fᵀ)⁻¹ φ_f R        Lai & Bernstein 2024 (SIFt-RLS)
//! P̄ = P + (1 − λ)/λ · φ_fᵀ (φ_f R φ_fᵀ)⁻¹ φ_f        the form used: one dyad w wᵀ for each of
//!                                                    q vectors w with w_iᵀ R w_j = δ_ij
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | √ε | threshold | (0, ∞) | 1e-6 |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): always, for λ_k ≥ λ_min > 0:
//!   R_k ≥ min(threshold²/(1 − λ_min), λ_min(R₀)) I.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ̄φ̄ᵀ ≤ β I:
//!   R_k ≤ max(β/(1 − λ_max), λ_max(R₀)) I.
//! - Cost: O(p n²), twice that of `exponential`. State: P alone.
//! - `threshold` is the smallest singular value of the whitened φ that counts as information, in
//!   units of φ̄; set it above the noise of the regressors. Smaller ones are neither forgotten nor
//!   accumulated.
//! - Use it first where P₀ is given: it is then the default rule.
//! - Not where knowledge goes stale in silence: it is kept, with the variance that it had. One
//!   direction is forgotten a sample and row, so that with n parameters the memory is about n
//!   times that of `exponential` with the same λ.
//!
//! Reference: B. Lai, D. S. Bernstein, *SIFt-RLS: subspace of information forgetting recursive
//! least squares*, arXiv 2404.10844, 2024; for one row, L. Cao, H. M. Schwartz, *A directional
//! forgetting algorithm based on the decomposition of the information matrix*, Automatica 36, 2000.

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
    Range::POSITIVE,
    "smallest singular value of the whitened regressor that counts as information (units of phi)",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    cost: "O(p n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::when(
            "forgetting factor >= lambda_min > 0",
            Setting::usual(Input::Exciting(1)).factor(1e-6),
        ),
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[THRESHOLD])
};

/// Forgets in the informed directions only; see [`self`](crate::rules::subspace).
#[derive(Clone, Copy, Debug)]
pub struct Subspace<M: Memory> {
    threshold: M::Real,
}

impl<M: Memory> Subspace<M> {
    /// With the smallest singular value of φ̄ that counts as information.
    ///
    /// # Errors
    /// [`Error::Value`] unless `threshold` is positive.
    pub fn new(threshold: M::Real) -> Result<Self, Error> {
        Ok(Self { threshold: THRESHOLD.check(threshold)? })
    }
}

impl<M: Memory> Forgetting<M> for Subspace<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(THRESHOLD.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(THRESHOLD.name, Value::Real(self.threshold.to_f64()));
    }

    fn start(&self, _: M) {}

    fn is_bounded(&self) -> bool {
        true
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        constants.along_samples(self.threshold.to_f64())
    }

    #[inline]
    fn form(&self, forgetting_factor: M::Real, _: M::Real) -> Option<Form<M::Real>> {
        let weight = (M::Real::ONE - forgetting_factor) / forgetting_factor;
        Some(Form::Along { weight, dead_zone: DeadZone::Below(self.threshold) })
    }

    #[inline]
    fn forget(&self, (): &mut (), mut step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        if step.sample.rows() > 1 {
            step.sample.orthogonalize();
        }
        step.sample.keep_longer_than(self.threshold);
        if step.sample.rows() == 0 {
            return Ok(Forgotten::skipped(Skip::DeadZone));
        }
        forget_along_sample(&mut step).map(Forgotten::rank)
    }
}
