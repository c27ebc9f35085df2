//! Forgets along the last gain only: the information may shrink, but not where nothing was measured.
//!
//! ```text
//! s_k = φ̄_k P_k φ̄_kᵀ,  β_k = λ_k − (1 − λ_k)/s_k          GF-RLS (69)
//! P_{k+1}⁻¹ = P_k⁻¹ + β_k φ̄_kᵀ φ̄_k                        (67); β_k < 0 if λ_k < 1/(1 + s_k)
//!           = (P₊ + (1 − λ_k)/λ_k · P₊ Vᵀ (V P₊ Vᵀ)⁻¹ V P₊)⁻¹
//!                                       P₊ after the data; V spans the rows of φ̄_k
//! F_k = (1 − λ_{k−1}) Vᵀ (V P_k Vᵀ)⁻¹ V, V of sample k − 1  (73) with s_{k−1}; F_0 = 0
//! ```
//!
//! The published algorithm measures, then forgets. Here it is Theorem 1 shifted by one step: the
//! state keeps φ̄_k and λ_k, sample k + 1 forgets with them before it is measured, and P is that
//! after the data. θ is the same. The form used is one dyad P₊v for each direction v of φ̄_k, so
//! that P stays positive definite although β_k may be negative.
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//!
//! For several rows (not published), V spans those directions of φ̄ whose singular values are
//! above √(machine epsilon) times the largest; for one row, V = φ̄.
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. In silence P stays as it is, but weakly
//!   excited directions wind up slowly.
//! - P bounded below (A3): no.
//! - Cost: O(p n²). State: P, φ̄ and λ of the sample before.
//! - Use it to reproduce the literature on directional forgetting; `subspace` is bounded.
//!
//! Reference: R. Kulhavý, M. Kárný, *Tracking of slowly varying parameters by directional
//! forgetting*, 9th IFAC World Congress, 1984; S. Bittanti, P. Bolzern, M. Campi, *Convergence and
//! exponential convergence of identification algorithms with directional forgetting factor*,
//! Automatica 26, 1990.

use super::{Forgetting, Forgotten, Step};
use crate::choice::{About, Guarantee, Guarantees, Input, Setting, Value, Values};
use crate::memory::state::{State, Visitor, is_factor};
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::{Sample, Work};
use forgetting_kernels::Real;
use core::marker::PhantomData;
use forgetting_kernels::kernel::functions::{add_scaled, dot};

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    cost: "O(p n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(Setting::usual(Input::Fading(1e-6))),
        bounded_below: Guarantee::no(Setting::usual(Input::Alternating)),
    }),
    ..About::new(&[])
};

/// Forgets along the last gain; see [`self`](crate::rules::restricted).
#[derive(Clone, Copy, Debug, Default)]
pub struct Restricted<M>(PhantomData<M>);

impl<M> Restricted<M> {
    /// The rule.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

/// The sample that is still to be forgotten.
#[derive(Clone, Debug)]
pub struct Pending<M: Memory> {
    /// its rows, those that do not count set to zero
    regressors: M::Rows,
    /// its λ; 1 when nothing is to be forgotten
    forgetting_factor: M::Real,
    /// not state: where the rotation of the rows puts what belongs to ē
    unused: M::Errors,
}

impl<M: Memory> State<M::Real> for Pending<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.regressors.as_mut());
        visitor.reals(core::slice::from_mut(&mut self.forgetting_factor));
    }

    fn is_sound(&self) -> bool {
        let regressors = self.regressors.as_ref();
        is_factor(self.forgetting_factor) && dot(regressors, regressors) <= M::Real::CEILING
    }
}

impl<M: Memory> Forgetting<M> for Restricted<M> {
    type State = Pending<M>;

    fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
        Ok(Self::new())
    }

    fn describe(&self, _: &mut dyn FnMut(&'static str, Value<'_>)) {}

    fn start(&self, memory: M) -> Pending<M> {
        Pending {
            regressors: memory.regressors(),
            forgetting_factor: M::Real::ONE,
            unused: memory.errors(),
        }
    }

    fn change_units(&self, pending: &mut Pending<M>, ratios: &[M::Real]) {
        for row in pending.regressors.as_mut().chunks_exact_mut(ratios.len()) {
            row.iter_mut().zip(ratios).for_each(|(x, &ratio)| *x /= ratio);
        }
    }

    fn restart(&self, pending: &mut Pending<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        pending.keep(step.sample, step.forgetting_factor);
        Ok(Forgotten::rank(0))
    }

    #[inline]
    fn forget(&self, pending: &mut Pending<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let rank = pending.forget(step.factor, step.work)?;
        pending.keep(step.sample, step.forgetting_factor);
        Ok(Forgotten::rank(rank))
    }
}

impl<M: Memory> Pending<M> {
    /// Takes note of a sample: what the next one is to forget.
    #[inline]
    fn keep(&mut self, sample: &Sample<'_, M>, forgetting_factor: M::Real) {
        self.forgetting_factor = forgetting_factor;
        let regressors = self.regressors.as_mut();
        regressors.fill(M::Real::ZERO);
        if forgetting_factor >= M::Real::ONE {
            return;
        }
        regressors[..sample.regressors().len()].copy_from_slice(sample.regressors());
        if sample.rows() > 1 {
            let mut copy = Sample::new(sample.memory(), regressors, self.unused.as_mut());
            copy.orthogonalize();
            copy.clear_shorter_than(M::Real::EPSILON.sqrt() * copy.longest_row());
        }
    }

    /// P ← P + (1 − λ)/λ · P Vᵀ (V P Vᵀ)⁻¹ V P; returns the number of directions.
    #[inline]
    fn forget(&self, factor: &mut Factor<M>, work: &mut Work<M>) -> Result<usize, Error> {
        let lambda = self.forgetting_factor;
        if !(lambda < M::Real::ONE && lambda > M::Real::ZERO) {
            return Ok(0);
        }
        let (n, weight) = (factor.parameters(), (M::Real::ONE - lambda) / lambda);
        let directions = work.first.as_mut();
        let rank = orthonormalize(factor, self.regressors.as_ref(), directions);
        let directions = &mut directions[..rank * n];
        for direction in directions.chunks_exact_mut(n) {
            factor.apply_root(direction);
        }
        factor.reserve(M::Real::ONE, weight * dot(directions, directions))?;
        for direction in directions.chunks_exact_mut(n) {
            factor.add_covariance(direction, weight);
        }
        Ok(rank)
    }
}

/// Orthonormal z_i that span D^(1/2) Uᵀ φ̄ᵀ: with P = (U D^(1/2)) (U D^(1/2))ᵀ, the sum of the
/// dyads of U D^(1/2) z_i is P Vᵀ (V P Vᵀ)⁻¹ V P. Returns their number.
fn orthonormalize<M: Memory>(factor: &Factor<M>, rows: &[M::Real], out: &mut [M::Real]) -> usize {
    let n = factor.parameters();
    let mut rank = 0;
    for row in rows.chunks_exact(n) {
        let (done, z) = out.split_at_mut(rank * n);
        let z = &mut z[..n];
        z.copy_from_slice(row);
        factor.apply_root_transposed(z);
        let before = dot(z, z);
        // twice is enough: the second pass removes what rounding left
        for _ in 0..2 {
            for v in done.chunks_exact(n) {
                add_scaled(z, -dot(v, z), v);
            }
        }
        let after = dot(z, z);
        let tolerance = M::Real::EPSILON * M::Real::from_f64(64.0 * n as f64);
        if after > tolerance * tolerance * before && after.is_finite() {
            let scale = M::Real::ONE / after.sqrt();
            z.iter_mut().for_each(|x| *x *= scale);
            rank += 1;
        }
    }
    rank
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Defaults;
    use crate::testing::{covariance, forget, measured, memory, two_rows, Dense};

    #[test]
    fn information_shrinks_as_published() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let rule = Restricted::configure(&Defaults, memory(&phi, 1)).unwrap();
        let mut pending = rule.start(memory(&phi, 1));
        let first = forget(&rule, &mut pending, &p, &phi, 0.2);
        assert!(first.covariance.distance(&p) < 1e-15, "the first sample forgets nothing");
        let after = measured(&p, &phi);
        let second = forget(&rule, &mut pending, &after, &phi, 0.2);
        let s = (phi.clone() * p.clone() * phi.transpose()).at(0, 0);
        let beta = 0.2 - 0.8 / s; // (69)
        assert!(beta < 0.0);
        let expected = (p.inverse() + beta * (phi.transpose() * phi)).inverse(); // (67)
        assert!(second.covariance.distance(&expected) < 1e-14);
    }

    #[test]
    fn several_rows_lose_what_they_span() {
        let (p, phi) = (covariance(), two_rows());
        let rule = Restricted::new();
        let mut pending = rule.start(memory(&phi, 1));
        forget(&rule, &mut pending, &p, &phi, 0.7);
        let after = measured(&p, &phi);
        let second = forget(&rule, &mut pending, &after, &phi, 0.7);
        let reach = after.clone() * phi.transpose();
        let gram = (phi * reach.clone()).inverse();
        let expected = after + (0.3 / 0.7) * (reach.clone() * gram * reach.transpose());
        assert!(second.covariance.distance(&expected) < 1e-14);
        assert_eq!(second.forgotten.rank, 2);
    }
}
