//! Forgets along the eigenvectors of the information matrix that the sample excites.
//!
//! ```text
//! R = V diag(r) Vᵀ,  ψ = φ̄ V                         tutorial (66)
//! F_k = V diag((1 − λ_k) r_i [‖ψ_i‖ > threshold]) Vᵀ  (64), (67)–(69)
//! P̄ = P + (1 − λ)/λ · Σ v_i v_iᵀ/r_i, the excited i   the form used: one dyad for each excited
//!                                                     i, or, where these are most,
//! P̄⁻¹ = λ R + (1 − λ) Σ r_i v_i v_iᵀ, the other i     D ← D/λ and one row for each of the rest
//! ```
//!
//! Eigenvalues that differ by less than √precision, relatively, have no eigenvectors of their
//! own (P₀ = c·I has none at all). Among them the sample decides: the directions forgotten are
//! the right singular vectors of φ̄V_c with singular values above the threshold, V_c any basis
//! of their space. What is forgotten then depends on P and φ̄ only.
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | ε | threshold | (0, ∞) | 1e-6 |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. An eigenvector that φ̄ meets at a small angle is
//!   forgotten like any other, and may gain less than it loses. Under persistent excitation,
//!   with R_k ≥ λᴺ α I.
//! - P bounded below (A3): no. A sample along which every ‖ψ_i‖ is at or below the threshold is
//!   not forgotten but still accumulated, as published; without end it drives P to 0. `subspace`
//!   leaves such samples out.
//! - Cost: O(n³), most of it one product of n x n matrices a row. State: P and the
//!   eigenvectors and eigenvalues of P⁻¹, which follow P by rank-one updates (the secular
//!   equation) and are computed from its factor every 128 samples; P is never inverted.
//! - Use it to reproduce work that used it, or where directions should be forgotten by the
//!   principal axes of what is known. `subspace` forgets exactly what the sample informs, for
//!   O(p n²), with bounds.
//!
//! Reference: A. Goel, A. L. Bruce, D. S. Bernstein, *Recursive least squares with
//! variable-direction forgetting*, IEEE Control Systems Magazine 40(4), 2020, (64)–(71), with
//! the transposes that (70) lost.

use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value, Values,
};
use crate::covariance::spectrum::Spectrum;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const THRESHOLD: Parameter = Parameter::real(
    "threshold",
    1e-6,
    Range::POSITIVE,
    "an eigenvector is forgotten if the whitened regressor along it is longer (units of phi)",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    squares: 3,
    cost: "O(p n^3)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(
            Setting::usual(Input::Fixed).with(&[("threshold", Value::Real(1e-9))]),
        ),
        bounded_below: Guarantee::no(
            Setting::usual(Input::Exciting(1)).with(&[("threshold", Value::Real(2.0))]),
        ),
    }),
    ..About::new(&[THRESHOLD])
};

/// Forgets along excited eigenvectors; see [`self`](crate::rules::variable_direction).
#[derive(Clone, Copy, Debug)]
pub struct VariableDirection<M: Memory> {
    threshold: M::Real,
}

impl<M: Memory> VariableDirection<M> {
    /// With the length of φ̄ along an eigenvector above which it is forgotten.
    ///
    /// # Errors
    /// [`Error::Value`] unless `threshold` is positive.
    pub fn new(threshold: M::Real) -> Result<Self, Error> {
        Ok(Self { threshold: THRESHOLD.check(threshold)? })
    }

    /// Marks the excited eigenvectors with 1 in `work.second`, and forgets along those of
    /// uneven clusters, where P may grow by `room`; returns the number of excited ones and of
    /// those dealt with.
    #[inline]
    fn find(
        &self,
        spectrum: &mut Spectrum<M>,
        step: &mut Step<'_, '_, M>,
        room: &mut M::Real,
    ) -> (usize, usize) {
        let n = step.factor.parameters();
        let growth = M::Real::ONE / step.forgetting_factor;
        let rows = step.sample.rows();
        let components = &mut step.work.first.as_mut()[..rows * n];
        for (i, components) in components.chunks_exact_mut(n).enumerate() {
            spectrum.project(step.sample.row(i), components);
        }
        step.work.second.as_mut()[..n].fill(M::Real::ZERO);
        let (mut start, mut rank, mut done) = (0, 0, 0);
        while start < n {
            let cluster = spectrum.cluster(start);
            let uneven = spectrum.is_uneven(cluster.clone());
            let components = &mut step.work.first.as_mut()[..rows * n];
            let found = spectrum.align(cluster.clone(), components, self.threshold);
            if uneven && found > 0 {
                for i in start..start + found {
                    let weight = (growth - M::Real::ONE) * spectrum.variance(cluster.clone(), i);
                    spectrum.widen(i, (weight, room), step.factor, step.work.gain.as_mut());
                }
                spectrum.settle(cluster.clone(), found, growth);
                done += found;
            } else {
                step.work.second.as_mut()[start..start + found].fill(M::Real::ONE);
            }
            rank += found;
            start = cluster.end;
        }
        (rank, done)
    }
}

/// Forgets along the eigenvectors marked in `work.second`, each alone in its cluster; P may grow
/// by `room`.
#[inline]
fn forget_marked<M: Memory>(
    spectrum: &mut Spectrum<M>,
    step: &mut Step<'_, '_, M>,
    rest_is_small: bool,
    room: &mut M::Real,
) -> Result<(), Error> {
    let lambda = step.forgetting_factor;
    let lost = M::Real::ONE - lambda;
    if rest_is_small {
        step.factor.scale(M::Real::ONE / lambda)?;
    }
    for i in 0..step.factor.parameters() {
        let marked = step.work.second.as_ref()[i] > M::Real::ZERO;
        let information = spectrum.information()[i];
        if rest_is_small && !marked {
            spectrum.narrow(
                i,
                lost * information,
                step.factor,
                (step.work.first.as_mut(), step.work.gain.as_mut()),
            );
        } else if marked {
            if !rest_is_small {
                let weight = lost / (lambda * information);
                spectrum.widen(i, (weight, room), step.factor, step.work.gain.as_mut());
            }
            spectrum.set_information(i, lambda * information);
        }
    }
    Ok(())
}

impl<M: Memory> Forgetting<M> for VariableDirection<M> {
    type State = Spectrum<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(THRESHOLD.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(THRESHOLD.name, Value::Real(self.threshold.to_f64()));
    }

    fn start(&self, memory: M) -> Spectrum<M> {
        Spectrum::new(memory)
    }

    fn follow(&self, spectrum: &mut Spectrum<M>, step: Step<'_, '_, M>) {
        if step.sample.squared_regressors() > M::Real::ZERO {
            spectrum.follow(step.factor);
            spectrum.learn_rows(step.sample.regressors());
        }
    }

    fn change_units(&self, spectrum: &mut Spectrum<M>, _: &[M::Real]) {
        spectrum.discard();
    }

    fn restart(
        &self,
        spectrum: &mut Spectrum<M>,
        step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        spectrum.discard();
        Ok(Forgotten::rank(step.factor.parameters()))
    }

    #[inline]
    fn forget(
        &self,
        spectrum: &mut Spectrum<M>,
        mut step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        if step.sample.squared_regressors() == M::Real::ZERO {
            return Ok(Forgotten::rank(0)); // nothing forgotten, nothing learned
        }
        let (lambda, mut rank) = (step.forgetting_factor, 0);
        if lambda < M::Real::ONE {
            // P̄ ≤ P/λ; from here on nothing can fail
            step.factor.reserve(M::Real::ONE / lambda, M::Real::ZERO)?;
        }
        spectrum.follow(step.factor);
        if lambda < M::Real::ONE {
            let mut room = step.factor.room(lambda);
            let done;
            (rank, done) = self.find(spectrum, &mut step, &mut room);
            let rest = step.factor.parameters() - rank;
            let rest_is_small =
                done == 0 && 3 * rest < 2 * rank && lambda >= M::Real::from_f64(0.5);
            forget_marked(spectrum, &mut step, rest_is_small, &mut room)?;
        }
        spectrum.learn_rows(step.sample.regressors());
        Ok(Forgotten::rank(rank))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget, memory, Dense};

    fn rule() -> VariableDirection<crate::memory::Dynamic<f64>> {
        VariableDirection::new(1e-3).unwrap()
    }

    #[test]
    fn only_excited_eigenvectors_lose_information() {
        let p = Dense::new(2, &[2.0, 0.0, 0.0, 8.0]);
        let phi = Dense::new(1, &[3.0, 1e-3]); // at the threshold is not above it
        let mut state = rule().start(memory(&phi, 1));
        let found = forget(&rule(), &mut state, &p, &phi, 0.5);
        assert_eq!(found.covariance.elements, [4.0, 0.0, 0.0, 8.0]);
        assert_eq!(found.forgotten.rank, 1);
    }

    #[test]
    fn of_equal_eigenvalues_the_direction_of_the_sample_is_forgotten() {
        let p = Dense::new(2, &[2.0, 0.0, 0.0, 2.0]);
        let phi = Dense::new(1, &[3.0, 4.0]);
        let mut state = rule().start(memory(&phi, 1));
        let found = forget(&rule(), &mut state, &p, &phi, 0.5);
        // 2 I + 2 v vᵀ with v = (0.6, 0.8)
        let expected = Dense::new(2, &[2.72, 0.96, 0.96, 3.28]);
        assert!(found.covariance.distance(&expected) < 1e-15);
        assert_eq!(found.forgotten.rank, 1);
    }

    #[test]
    fn where_all_are_excited_it_is_exponential() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let mut state = rule().start(memory(&phi, 1));
        let found = forget(&rule(), &mut state, &p, &phi, 0.9);
        assert!(found.covariance.distance(&((1.0 / 0.9) * p)) < 1e-15);
        assert_eq!(found.forgotten.rank, 3);
    }

    #[test]
    fn factor_one_forgets_nothing() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let mut state = rule().start(memory(&phi, 1));
        let found = forget(&rule(), &mut state, &p, &phi, 1.0);
        assert!(found.covariance.distance(&p) < 1e-15);
        assert_eq!(found.forgotten.rank, 0);
    }
}
