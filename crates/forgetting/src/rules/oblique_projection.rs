//! Forgets the part of the information that the rows of the sample span, by oblique projection.
//!
//! ```text
//! F_k = (1 − λ_k) R φ̄ᵀ (φ̄ R φ̄ᵀ)⁺ φ̄ R       Zhu, Yu & Wan (17), (19), if ‖φ̄‖₂ ≥ threshold
//! F_k = 0                                  (18), if not; every sample is learned from (23)
//! P̄ = P + (1 − λ)/λ · V (Vᵀ R V)⁻¹ Vᵀ      the form used: V spans the rows of φ̄, one dyad w wᵀ
//!                                          for each of r vectors w with w_iᵀ R w_j = δ_ij
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | ε | threshold | [0, ∞) | 1e-6 |
//!
//! The rank r of φ̄ is the number of its singular values above √(machine epsilon) times the
//! largest. It is decided on φ̄: a cut-off on φ̄ R φ̄ᵀ would depend on the condition of R.
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. The threshold looks at the largest singular
//!   value only: in a direction of a small one, δ, R falls to δ²/(1 − λ).
//! - P bounded below (A3): no. Samples below the threshold are learned from and never forgotten.
//! - Cost: O(p n²), without an n x n inverse. State: P alone.
//! - Use it to reproduce the paper. `subspace` is the same with a threshold for each singular
//!   value, which gives both bounds.
//!
//! Reference: K. Zhu, C. Yu, Y. Wan, *Recursive least squares identification with
//! variable-direction forgetting via oblique projection decomposition*, IEEE/CAA Journal of
//! Automatica Sinica 9(3), 2022.

use super::along_sample::forget_along_rows;
use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value, Values,
};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const THRESHOLD: Parameter = Parameter::real(
    "threshold",
    1e-6,
    Range::NON_NEGATIVE,
    "largest singular value of the whitened regressor from which on a sample makes forget",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    cost: "O(p n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(Setting::usual(Input::Uneven(1e-4))),
        bounded_below: Guarantee::no(
            Setting::usual(Input::Exciting(1)).with(&[("threshold", Value::Real(2.0))]),
        ),
    }),
    ..About::new(&[THRESHOLD])
};

/// Forgets what the sample spans; see [`self`](crate::rules::oblique_projection).
#[derive(Clone, Copy, Debug)]
pub struct ObliqueProjection<M: Memory> {
    threshold: M::Real,
}

impl<M: Memory> ObliqueProjection<M> {
    /// With the largest singular value of φ̄ from which on a sample makes forget.
    ///
    /// # Errors
    /// [`Error::Value`] if `threshold` is negative.
    pub fn new(threshold: M::Real) -> Result<Self, Error> {
        Ok(Self { threshold: THRESHOLD.check(threshold)? })
    }
}

impl<M: Memory> Forgetting<M> for ObliqueProjection<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(THRESHOLD.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(THRESHOLD.name, Value::Real(self.threshold.to_f64()));
    }

    fn start(&self, _: M) {}

    #[inline]
    fn forget(&self, (): &mut (), mut step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        if step.forgetting_factor >= M::Real::ONE {
            return Ok(Forgotten::rank(0));
        }
        if step.sample.rows() > 1 {
            step.sample.orthogonalize();
        }
        let largest = step.sample.longest_row();
        if largest < self.threshold {
            return Ok(Forgotten::rank(0));
        }
        forget_along_rows(&mut step, M::Real::EPSILON.sqrt() * largest).map(Forgotten::rank)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget, two_rows, Dense};

    /// R − (1 − λ) R φᵀ (φ R φᵀ)⁻¹ φ R, inverted: (17), (19).
    fn published(p: &Dense, phi: &Dense, lambda: f64) -> Dense {
        let r = p.inverse();
        let image = phi.clone() * r.clone();
        let gram = (image.clone() * phi.transpose()).inverse();
        (r - (1.0 - lambda) * (image.transpose() * gram * image)).inverse()
    }

    #[test]
    fn forgets_as_published() {
        let (p, phi) = (covariance(), two_rows());
        let outcome = forget(&ObliqueProjection::new(1e-3).unwrap(), &mut (), &p, &phi, 0.8);
        assert!(outcome.covariance.distance(&published(&p, &phi, 0.8)) < 1e-14);
        assert_eq!(outcome.forgotten.rank, 2);
        // the rows are rotated, the information they bring is not
        let gram = |phi: Dense| phi.transpose() * phi;
        assert!(gram(outcome.regressors).distance(&gram(phi)) < 1e-15);
    }

    #[test]
    fn a_dependent_row_is_no_direction_of_its_own() {
        let p = covariance();
        let twice = Dense::new(2, &[0.8, -0.2, 1.1, -1.6, 0.4, -2.2]);
        let once = Dense::new(1, &[0.8, -0.2, 1.1]);
        let outcome = forget(&ObliqueProjection::new(1e-3).unwrap(), &mut (), &p, &twice, 0.8);
        assert_eq!(outcome.forgotten.rank, 1);
        assert!(outcome.covariance.distance(&published(&p, &once, 0.8)) < 1e-14);
        assert_eq!(outcome.regressors.rows, 2);
    }

    #[test]
    fn below_the_threshold_nothing_is_forgotten_and_all_is_measured() {
        let p = covariance();
        let outcome = forget(&ObliqueProjection::new(9.0).unwrap(), &mut (), &p, &two_rows(), 0.8);
        assert_eq!(outcome.forgotten, Forgotten::rank(0));
        assert!(outcome.covariance.distance(&p) < 1e-15);
        assert_eq!(outcome.regressors.rows, 2);
    }
}
