//! Forgets each parameter, or each block of parameters, at a rate of its own.
//!
//! ```text
//! P̄ = P + blkdiag((1/λ_b − 1) P_bb)        West & Harrison, discounting by component
//! F_k = R − P̄⁻¹                            the same as Theorem 1 of GF-RLS has it; the form
//!                                          used: P_bb = V diag(d) Vᵀ, one dyad for each v
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | n_b | blocks | sizes of consecutive blocks, whole numbers from 1 that sum to n, or one size for all | 1 |
//! | λ_b | factors | (0, 1], one number a block or one for all | the forgetting factor λ_k |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. In silence the variances of block b grow as
//!   λ_b⁻ᵏ (windup).
//! - P bounded below (A3): if λ_b ≤ λ_max < 1 and φ is bounded.
//! - Cost: O(n³), one dyad for each parameter; O(p n²) with one block of all parameters, which is
//!   `exponential`. State: P alone.
//! - Use it when parameters are known to drift at different rates. `multiple` drops what the
//!   blocks know of each other and is rarely proper; this rule keeps it.
//!
//! Reference: M. West, J. Harrison, *Bayesian Forecasting and Dynamic Models*, 2nd edition,
//! Springer, 1997, section 6.3.

use super::blocks::Blocks;
use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::memory::state::{State, Visitor};
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;
use core::ops::Range as Places;
use forgetting_kernels::kernel::{functions, layout};

const BLOCKS: Parameter = Parameter::elements(
    "blocks",
    Kind::List,
    1.0,
    Range::AT_LEAST_ONE,
    "sizes of consecutive blocks of parameters, or one size for all",
);
const FACTORS: Parameter = Parameter::elements(
    "factors",
    Kind::List,
    1.0,
    Range::FRACTION,
    "forgetting factor of each block; the rule's forgetting factor for all if not given",
)
.optional();

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    squares: 1,
    cost: "O(n^3)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(Setting::usual(Input::Fixed)),
        bounded_below: Guarantee::when(
            "forgetting factors <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[BLOCKS, FACTORS])
};

/// Forgets each block at its own rate; see [`self`](crate::rules::component).
#[derive(Clone, Debug)]
pub struct Component<M: Memory> {
    memory: M,
    blocks: Blocks<M>,
    /// λ_b for each block, where they were given
    forgetting_factors: Option<M::Vector>,
}

/// Nothing that lasts: room for V and d of one block.
#[derive(Clone, Debug)]
pub struct BlockRoot<M: Memory> {
    columns: M::Packed,
    diagonal: M::Vector,
}

impl<M: Memory> State<M::Real> for BlockRoot<M> {
    fn visit(&mut self, _: &mut dyn Visitor<M::Real>) {}
}

impl<M: Memory> Component<M> {
    /// Each block at the common forgetting factor.
    pub fn new(memory: M, blocks: Blocks<M>) -> Self {
        Self { memory, blocks, forgetting_factors: None }
    }

    /// Each block at a forgetting factor of its own, in place of the common one.
    ///
    /// # Errors
    /// [`Error`] names `factors`: their number, or one that is not in (0, 1].
    pub fn with_factors(mut self, forgetting_factors: &[M::Real]) -> Result<Self, Error> {
        let name = FACTORS.name;
        Error::check_length(name, forgetting_factors.len(), self.blocks.count())?;
        let mut factors = self.memory.vector();
        for (kept, &factor) in factors.as_mut().iter_mut().zip(forgetting_factors) {
            *kept = FACTORS.check(factor)?;
        }
        self.forgetting_factors = Some(factors);
        Ok(self)
    }

    /// λ_b
    #[inline]
    fn factor(&self, block: usize, common: M::Real) -> M::Real {
        self.forgetting_factors.as_ref().map_or(common, |factors| factors.as_ref()[block])
    }

    /// The smallest λ_b.
    #[inline]
    fn smallest(&self, common: M::Real) -> M::Real {
        (0..self.blocks.count()).fold(M::Real::ONE, |least, b| least.min(self.factor(b, common)))
    }
}

impl<M: Memory> Forgetting<M> for Component<M> {
    type State = BlockRoot<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let rule = Self::new(memory, Blocks::configure(&BLOCKS, values, memory)?);
        if values.get(FACTORS.name).is_none() {
            return Ok(rule);
        }
        let (count, mut factors) = (rule.blocks.count(), memory.vector());
        FACTORS.list(values, count, |b, factor| factors.as_mut()[b] = factor)?;
        Ok(Self { forgetting_factors: Some(factors), ..rule })
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.blocks.describe(BLOCKS.name, each);
        if let Some(factors) = &self.forgetting_factors {
            let elements = |b: usize| factors.as_ref()[b].to_f64();
            let columns = self.blocks.count();
            each(FACTORS.name, Value::Matrix { rows: 1, columns, elements: &elements });
        }
    }

    fn start(&self, memory: M) -> BlockRoot<M> {
        BlockRoot { columns: memory.packed(), diagonal: memory.vector() }
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let common = M::Real::from_f64(constants.forgetting_factors.1);
        let factors = (0..self.blocks.count()).map(|b| self.factor(b, common).to_f64());
        let below = constants.least_remembered(factors.fold(0.0, f64::max));
        Bounds { below, above: None }
    }

    #[inline]
    fn forget(&self, root: &mut BlockRoot<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let (factor, common) = (step.factor, step.forgetting_factor);
        let smallest = self.smallest(common);
        if smallest >= M::Real::ONE {
            return Ok(Forgotten::rank(0).with_factor(1.0));
        }
        if self.blocks.count() == 1 {
            factor.scale(M::Real::ONE / smallest)?;
            return Ok(Forgotten::rank(factor.parameters()).with_factor(smallest.to_f64()));
        }
        let variances = &mut step.work.first.as_mut()[..factor.parameters()];
        factor.variances(variances);
        let (mut added, mut rank) = (M::Real::ZERO, 0);
        for (b, range) in self.blocks.ranges().enumerate() {
            let weight = growth(self.factor(b, common));
            if weight > M::Real::ZERO {
                rank += range.len();
                added = variances[range].iter().fold(added, |sum, &v| weight.mul_add(v, sum));
            }
        }
        factor.reserve(M::Real::ONE, added)?;
        for (b, range) in self.blocks.ranges().enumerate() {
            let weight = growth(self.factor(b, common));
            if weight > M::Real::ZERO {
                root.compute(factor, range.clone(), step.work.gain.as_mut());
                root.add_to(factor, range, weight, step.work.gain.as_mut());
            }
        }
        Ok(Forgotten::rank(rank).with_factor(smallest.to_f64()))
    }
}

/// 1/λ − 1
#[inline]
fn growth<T: Real>(lambda: T) -> T {
    (T::ONE - lambda) / lambda
}

impl<M: Memory> BlockRoot<M> {
    /// P_bb = V diag(d) Vᵀ: the block's own triangle of U, and a dyad for each later column.
    fn compute(&mut self, factor: &Factor<M>, range: Places<usize>, x: &mut [M::Real]) {
        let (size, start) = (range.len(), range.start);
        let columns = &mut self.columns.as_mut()[..layout::length::<M::Real>(size)];
        let diagonal = &mut self.diagonal.as_mut()[..size];
        diagonal.copy_from_slice(&factor.diagonal_elements()[range.clone()]);
        for j in 0..size {
            for i in 0..j {
                columns[layout::place::<M::Real>(i, j)] = factor.unit(start + i, start + j);
            }
        }
        for k in range.end..factor.parameters() {
            let x = &mut x[..size];
            for (x, i) in x.iter_mut().zip(range.clone()) {
                *x = factor.unit(i, k);
            }
            functions::agee_turner(columns, diagonal, x, factor.diagonal_elements()[k]);
        }
    }

    /// P ← P + `weight`·P_bb
    fn add_to(
        &self,
        factor: &mut Factor<M>,
        range: Places<usize>,
        weight: M::Real,
        direction: &mut [M::Real],
    ) {
        for (j, &d) in self.diagonal.as_ref()[..range.len()].iter().enumerate() {
            direction.fill(M::Real::ZERO);
            layout::get_column(self.columns.as_ref(), j, &mut direction[range.start..]);
            direction[range.start + j] = M::Real::ONE;
            factor.add_covariance(direction, weight * d);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget, memory, Dense};
    use alloc::vec::Vec;

    fn check(sizes: &[usize], factors: &[f64]) {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let m = memory(&phi, 1);
        let rule = Component::new(m, Blocks::new(m, sizes).unwrap()).with_factors(factors).unwrap();
        let outcome = forget(&rule, &mut rule.start(m), &p, &phi, 0.5);
        let each = |(b, &size)| core::iter::repeat_n(b, size);
        let block: Vec<usize> = sizes.iter().enumerate().flat_map(each).collect();
        let mut expected = p.clone();
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)).filter(|&(i, j)| block[i] == block[j]) {
            expected.elements[i * 3 + j] /= factors[block[i]];
        }
        assert!(outcome.covariance.distance(&expected) < 1e-15, "{sizes:?}");
    }

    #[test]
    fn inflates_the_blocks_on_the_diagonal() {
        check(&[1, 1, 1], &[0.9, 0.8, 0.99]);
        check(&[2, 1], &[0.9, 0.5]);
        check(&[1, 2], &[1.0, 0.5]);
        check(&[3], &[0.7]);
    }

    #[test]
    fn refuses_blocks_that_do_not_fit() {
        let m = memory(&Dense::zero(1, 3), 1);
        for sizes in [&[1, 1][..], &[2, 2], &[3, 0], &[1, 1, 1, 1], &[]] {
            assert!(Blocks::new(m, sizes).is_err(), "{sizes:?}");
        }
    }
}
