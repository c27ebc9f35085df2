//! Forgets towards a fixed covariance, so that P stays between two bounds whatever the input.
//!
//! ```text
//! P̄ = λ_k P_k + (1 − λ_k) P_∞              stabilised (regularized) linear forgetting
//! F_k = R_k − P̄⁻¹                          as a case of Theorem 1
//! P ← λ P, P ← P + (1 − λ) Σ_i r_iᵀr_i     the form used: D ← λ D, then for a diagonal P_∞, of what
//!                                          was added, the part that the sample depends on, for
//!                                          P_∞ = c·I with n ≤ 10 one pass of Gram and Schmidt over
//!                                          [U, I], else one dyad for each row r_i of a root
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | P_∞ | covariance | a number c > 0 (c·I), n numbers > 0 or an n x n positive definite matrix | 100 |
//!
//! The dual of `exponential_resetting`, which averages P⁻¹ where this averages P. In silence both
//! return to a fixed covariance. Here P̄ is also at least (1 − λ) P_∞ at every sample, so that a
//! direction that was informed about for long is forgotten at once as far as that.
//!
//! - Proper (A1): if P₀ ≤ P_∞; P_k ≤ P_∞ then holds for ever.
//! - P̄ bounded above without excitation (A2): always, by the larger of P₀ and P_∞.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded: after a sample with φ̄ᵀφ̄ ≤ β I,
//!   P⁻¹ ≤ β I + P_∞⁻¹/(1 − λ_max).
//! - Cost: O((p + 1) n²), at n ≤ 10 with P_∞ = c·I about twice that of `exponential`; O(n³) for a full P_∞.
//!   State: P alone, in n²/2 numbers more for a diagonal P_∞.
//! - Use it when the gain must neither wind up nor fall asleep, with both bounds stated
//!   beforehand. The smallest variance that it keeps, (1 − λ) P_∞, is noise in the estimate.
//! - Not where the estimate must come to rest: P̄ is at least (1 − λ) P_∞ at every sample.
//!
//! Reference: R. Kulhavý, F. J. Kraus, *On duality of regularized exponential and linear
//! forgetting*, Automatica 32, 1996; with P_∞ = c·I the linear case of J. E. Parkum, N. K. Poulsen,
//! J. Holst, *Recursive forgetting algorithms*, International Journal of Control 55, 1992, which
//! measures first and forgets afterwards.

use super::{Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::rules::root::Root;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::Real;

const COVARIANCE: Parameter = Parameter::elements(
    "covariance",
    Kind::Matrix,
    100.0,
    Range::POSITIVE,
    "covariance that silence returns to: c for c*I, n numbers for a diagonal, or n x n",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    squares: 3,
    cost: "O((p + 1) n^2), O(n^3) for a matrix",
    guarantees: Some(Guarantees {
        proper: Guarantee::when(
            "P_0 <= covariance",
            Setting::usual(Input::Exciting(1)).with(&[("covariance", Value::Real(1.0))]),
        ),
        bounded_above: Guarantee::ALWAYS,
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[COVARIANCE])
};

/// Forgets towards P_∞; see [`self`](crate::rules::stabilised).
#[derive(Clone, Debug)]
pub struct Stabilised<M: Memory> {
    covariance: Root<M>,
    trace: M::Real,
}

impl<M: Memory> Stabilised<M> {
    /// Towards the covariance with this root.
    ///
    /// # Errors
    /// [`Error::Indefinite`] names `covariance` unless it is positive definite.
    pub fn new(covariance: Root<M>) -> Result<Self, Error> {
        if covariance.rank() < covariance.parameters() {
            let (parameter, allowed) = (COVARIANCE.name, "positive definite");
            return Err(Error::Indefinite { parameter, pivot: 0.0, allowed });
        }
        let trace = covariance.rows().fold(M::Real::ZERO, |sum, row| sum + dot(row, row));
        Ok(Self { covariance, trace })
    }
}

impl<M: Memory> Forgetting<M> for Stabilised<M> {
    type State = ();

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        Self::new(Root::configure(&COVARIANCE, values, memory)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.covariance.describe(COVARIANCE.name, each);
    }

    fn start(&self, _: M) {}

    fn is_bounded(&self) -> bool {
        true
    }

    fn defers(&self) -> bool {
        self.covariance.is_diagonal()
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (least, most) = self.covariance.extremes();
        let added = (1.0 - constants.forgetting_factors.1) * least.to_f64();
        Bounds { below: constants.least_after(added), above: positive(most.to_f64()) }
    }

    /// A walk, where P_∞ = c·I and parameters are few.
    #[inline]
    fn form(&self, forgetting_factor: M::Real, _: M::Real) -> Option<Form<M::Real>> {
        let limit = self.covariance.scalar_given()?;
        let noise = (M::Real::ONE - forgetting_factor) * limit;
        let walks = noise >= M::Real::FLOOR && self.covariance.parameters() <= FEW;
        walks.then_some(Form::Walk { noise, per_bound: M::Real::ONE / limit })
    }

    fn forget(&self, (): &mut (), step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let (lambda, n) = (step.forgetting_factor, step.factor.parameters());
        if lambda >= M::Real::ONE {
            return Ok(Forgotten::rank(0));
        }
        let weight = M::Real::ONE - lambda;
        // refuses before anything changes; there is then room for less, too
        step.factor.reserve(M::Real::ONE, weight * self.trace)?;
        step.factor.hold_trace(lambda * step.factor.trace());
        step.factor.reserve(M::Real::ONE, weight * self.trace)?;
        if step.factor.is_deferring() {
            let added = |i| weight * self.covariance.element(i, i);
            step.factor.defer_diagonal(added, step.work.gain.as_mut());
            return Ok(Forgotten::rank(n));
        }
        let direction = &mut step.work.first.as_mut()[..n];
        for row in self.covariance.rows() {
            direction.copy_from_slice(row);
            step.factor.add_covariance(direction, weight);
        }
        Ok(Forgotten::rank(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Defaults;
    use crate::testing::{covariance, forget, memory, Dense};

    #[test]
    fn the_covariance_is_the_average() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let rule = Stabilised::configure(&Defaults, memory(&phi, 1)).unwrap();
        let found = forget(&rule, &mut (), &p, &phi, 0.9);
        let average = |i: usize, j: usize| 0.9 * p.at(i, j) + if i == j { 10.0 } else { 0.0 };
        let average: alloc::vec::Vec<f64> = (0..9).map(|k| average(k / 3, k % 3)).collect();
        assert!(found.covariance.distance(&Dense::new(3, &average)) < 1e-14);
    }

    #[test]
    fn a_singular_covariance_is_refused() {
        struct Singular;
        impl Values for Singular {
            fn get(&self, _: &str) -> Option<Value<'_>> {
                Some(Value::Matrix { rows: 2, columns: 2, elements: &|_| 1.0 })
            }
        }
        let memory = crate::memory::Dynamic::<f64>::new(2, 1, 1).unwrap();
        let refused = Stabilised::configure(&Singular, memory).unwrap_err();
        assert!(matches!(refused, Error::Indefinite { parameter: "covariance", .. }));
    }
}
