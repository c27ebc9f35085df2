//! Forgets towards a fixed information matrix, one of its directions at each sample, in O(n²).
//!
//! ```text
//! R_∞ = Σ_j w_j w_jᵀ, j = 0 … r − 1        the rows of its root; at sample k, j = k mod r:
//! v_k = √((1 − λ_kʳ) / λ_kʳ⁻¹⁻ʲ) w_j
//! F_k = (1 − λ_k) R_k − v_k v_kᵀ           Lai & Bernstein (CR-RLS)
//! R̄ = λ R + v vᵀ                           the form used: D ← D / λ, then one information row
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | R_∞ | information | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 0.01 |
//!
//! A diagonal R_∞ is taken in the order of its elements, a full one in the order of the pivots
//! of Cholesky's factorization with diagonal pivots. k counts the samples used.
//!
//! - Proper (A1): no. One cycle without data is R → λʳ R + (1 − λʳ) R_∞ exactly, but within it
//!   information is added before it is due.
//! - P̄ bounded above without excitation (A2): if R_∞ > 0: by 1/(λʳ⁻¹ μ), μ = λ_min(R_∞), for a
//!   constant λ and P₀ ≤ λʳ⁻¹/μ I. Within a cycle P may exceed 1/μ.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded: P ≥ (1 − λ_max)/(β + v) I once it
//!   is, for φ̄ᵀφ̄ ≤ β I and v_k v_kᵀ ≤ v I.
//! - Cost: O((p + 1) n²). State: P and the place in the cycle.
//! - Use it in the place of `exponential_resetting` when n is large. With λ_k that varies within
//!   a cycle the inserted weights are those of each sample's λ_k, and the cycle is approximate.
//! - Not where n is small: `exponential_resetting` then costs little more, and is exact at every
//!   sample.
//!
//! Reference: B. Lai, D. S. Bernstein, *Exponential resetting and cyclic resetting recursive
//! least squares*, IEEE Control Systems Letters 7, 2023.

use super::{Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::rules::cycle::Cycle;
use crate::rules::root::Root;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::Kernels;

const INFORMATION: Parameter = Parameter::elements(
    "information",
    Kind::Matrix,
    0.01,
    Range::NON_NEGATIVE,
    "information that silence returns to: c for c*I, n numbers for a diagonal, or n x n",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    squares: 3,
    cost: "O((p + 1) n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::no(Setting { variance: 100.0, ..Setting::usual(Input::Silent) }),
        bounded_above: Guarantee::when(
            "information is positive definite",
            Setting::usual(Input::Silent).factor(0.99).with(&[("information", Value::Real(0.0))]),
        ),
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[INFORMATION])
};

/// Forgets towards R_∞ in cycles; see [`self`](crate::rules::cyclic_resetting).
#[derive(Clone, Debug)]
pub struct CyclicResetting<M: Memory> {
    information: Root<M>,
}

impl<M: Memory> CyclicResetting<M> {
    /// Towards the information matrix with this root.
    pub fn new(information: Root<M>) -> Self {
        Self { information }
    }
}

impl<M: Memory> CyclicResetting<M> {
    /// A whole cycle leads R to m or above, m the least of R_∞ where λ is constant. Within one, R
    /// may fall by λʳ⁻¹ before anything is inserted, and it may begin within one.
    fn bound_above(&self, constants: &Constants) -> Option<f64> {
        let (rank, (least, _)) = (self.information.rank() as i32, self.information.extremes());
        let (smallest, largest) = constants.forgetting_factors;
        if smallest >= 1.0 {
            return positive(constants.initial.1);
        }
        let kept = power(smallest, rank - 1);
        // else the weights inserted are cut to the range of the number type
        if rank < self.information.parameters() as i32 || kept < M::Real::FLOOR.to_f64() {
            return None;
        }
        let uneven = power(smallest / largest, rank - 1);
        let whole = uneven * (1.0 - power(largest, rank)) / (1.0 - power(smallest, rank));
        let least = (whole * least.to_f64()).min(kept / constants.initial.1);
        positive(1.0 / (kept * least))
    }
}

fn power(lambda: f64, exponent: i32) -> f64 {
    libm::pow(lambda, f64::from(exponent))
}

impl<M: Memory> Forgetting<M> for CyclicResetting<M> {
    type State = Cycle;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        Root::configure(&INFORMATION, values, memory).map(Self::new)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.information.describe(INFORMATION.name, each);
    }

    fn start(&self, _: M) -> Cycle {
        Cycle::default()
    }

    fn is_bounded(&self) -> bool {
        self.information.rank() == self.information.parameters()
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (rank, (_, most)) = (self.information.rank() as i32, self.information.extremes());
        let (smallest, largest) = constants.forgetting_factors;
        let inserted = most.to_f64() * (1.0 - power(smallest, rank)) / power(smallest, rank - 1);
        let below = (1.0 - largest) / (constants.regressor_bound + inserted);
        Bounds { below: positive(below), above: self.bound_above(constants) }
    }

    #[inline]
    fn forget(&self, cycle: &mut Cycle, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let (lambda, n) = (step.forgetting_factor, step.factor.parameters());
        let rank = self.information.rank();
        if lambda < M::Real::ONE {
            step.factor.scale(M::Real::ONE / lambda)?;
        }
        if rank == 0 {
            return Ok(Forgotten::rank(if lambda < M::Real::ONE { n } else { 0 }));
        }
        let j = cycle.turn(rank);
        cycle.pass(rank);
        if lambda >= M::Real::ONE {
            return Ok(Forgotten::rank(0));
        }
        let row = self.information.row(j);
        let weight = insertion_weight(lambda, rank, j, row);
        let scaled = &mut step.work.first.as_mut()[..n];
        for (x, &w) in scaled.iter_mut().zip(row) {
            *x = weight * w;
        }
        step.factor.add_information(scaled, step.work.gain.as_mut());
        Ok(Forgotten::rank(n))
    }
}

/// √((1 − λʳ) / λ^(r−1−j)), but no more than makes of `row` the largest regressor that an update
/// can take.
fn insertion_weight<T: Kernels>(lambda: T, rank: usize, j: usize, row: &[T]) -> T {
    let power = |exponent: usize| (0..exponent).fold(T::ONE, |product, _| product * lambda);
    let weight = (T::ONE - power(rank)) / power(rank - 1 - j).max(T::FLOOR);
    weight.min(T::CEILING / dot(row, row).max(T::FLOOR)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Defaults;
    use crate::testing::{covariance, forget, memory, Dense};

    #[test]
    fn one_cycle_without_data_is_exact() {
        let (mut p, silence) = (covariance(), Dense::new(1, &[0.0; 3]));
        let rule = CyclicResetting::configure(&Defaults, memory(&silence, 1)).unwrap();
        let mut cycle = Cycle::default();
        let kept = 0.9f64.powi(3);
        let expected = kept * p.inverse() + (1.0 - kept) * 0.01 * Dense::identity(3);
        for _ in 0..3 {
            p = forget(&rule, &mut cycle, &p, &silence, 0.9).covariance;
        }
        assert!(p.inverse().distance(&expected) < 1e-14);
        assert_eq!(cycle.turn(3), 0);
    }

    #[test]
    fn the_information_inserted_fits_the_number_type() {
        let row = [1.0f32, 1.0];
        assert!(insertion_weight(1e-30, 2, 0, &row).powi(2) * 2.0 <= f32::CEILING * 1.001);
    }
}
