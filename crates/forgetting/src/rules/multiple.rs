//! Forgets parameters, or blocks of them, each at its own rate, and keeps no information between blocks.
//!
//! ```text
//! F_k = R_k − blkdiag(λ_b R_bb,k)          GF-RLS (74)–(83), there for two parameters
//! R̄_bb = λ_b R_bb, no information else     the form used: a factor of R_bb⁻¹ for each block,
//!                                          D_b ← D_b/λ_b, then the rows φ̄_b of the sample
//! P₊ = (R̄ + φ̄ᵀφ̄)⁻¹                         the covariance shown, (79)
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | λ_b | factors | (0, 1], one number or one a block | 0.99 |
//! | | blocks | whole numbers ≥ 1: a size for all, or sizes that add up to n | 1 |
//!
//! - Proper (A1): if the correlation matrix of R_k, with its blocks normalized to I, is at least
//!   blkdiag(λ_b I); for two parameters: (1 − λ₁)(1 − λ₂) ≥ R₁₂²/(R₁₁R₂₂). That fails as soon as
//!   regressors are correlated and factors near 1. `component` is always proper.
//! - P̄ bounded above without excitation (A2): no: a block without excitation winds up.
//! - P bounded below (A3): if λ_b ≤ λ_max < 1 and φ is bounded: P ≥ (1 − λ_max)/β I for φ̄ᵀφ̄ ≤ β I,
//!   once it is.
//! - Cost: O(p n²), of which the rule itself takes O(n²), or O(p Σ n_b²) and writing U anew.
//!   State: P and a factor of each block.
//! - Use it to reproduce work that used it. It treats the blocks as if they were uncorrelated,
//!   even with every factor 1.
//!
//! Reference: A. Vahidi, A. Stefanopoulou, H. Peng, *Recursive least squares with forgetting for
//! online estimation of vehicle mass and road grade: theory and experiments*, Vehicle System
//! Dynamics 43, 2005; B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
//! stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024, V-J.

mod factors;

pub use factors::BlockFactors;

use super::blocks::Blocks;
use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const FACTORS: Parameter = Parameter::elements(
    "factors",
    Kind::List,
    0.99,
    Range::FRACTION,
    "forgetting factor of each block: one number, or one a block",
);
const BLOCKS: Parameter = Parameter::elements(
    "blocks",
    Kind::List,
    1.0,
    Range::AT_LEAST_ONE,
    "sizes of consecutive blocks of parameters: one for all, or sizes that add up to n",
);

/// The registry entry.
pub const ABOUT: About = About {
    squares: 2,
    cost: "O(p n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::when(
            "block-normalized R >= blkdiag(factors); rarely so near 1",
            Setting::usual(Input::Correlated),
        )
        .holds_in(Setting::usual(Input::Axes)),
        bounded_above: Guarantee::no(Setting::usual(Input::Silent)),
        bounded_below: Guarantee::when(
            "factors <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).with(&[("factors", Value::Real(1.0))]),
        ),
    }),
    ..About::new(&[FACTORS, BLOCKS])
};

/// Forgets each block at its own rate; see [`self`](crate::rules::multiple).
#[derive(Clone, Debug)]
pub struct Multiple<M: Memory> {
    blocks: Blocks<M>,
    /// λ_b
    factors: M::Vector,
}

impl<M: Memory> Multiple<M> {
    /// With consecutive blocks of these sizes and a forgetting factor for each.
    ///
    /// # Errors
    /// [`Error`] names `blocks` unless they sum to n, or `factors`.
    pub fn new(factors: &[M::Real], blocks: &[usize], memory: M) -> Result<Self, Error> {
        Error::check_length(FACTORS.name, factors.len(), blocks.len())?;
        let (blocks, mut kept) = (Blocks::new(memory, blocks)?, memory.vector());
        for (b, &factor) in factors.iter().enumerate() {
            kept.as_mut()[b] = FACTORS.check(factor).map_err(|error| error.at(b))?;
        }
        Ok(Self { blocks, factors: kept })
    }

    /// The factors of the blocks.
    fn factors(&self) -> &[M::Real] {
        &self.factors.as_ref()[..self.blocks.count()]
    }

    /// The trace of P̄: that of each block, divided by its λ.
    fn discounted_trace(&self, state: &mut BlockFactors<M>) -> M::Real {
        let blocks = state.each(&self.blocks).zip(self.factors());
        blocks.fold(M::Real::ZERO, |sum, (block, &lambda)| sum + block.trace() / lambda)
    }
}

impl<M: Memory> Forgetting<M> for Multiple<M> {
    type State = BlockFactors<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let (blocks, mut factors) = (Blocks::configure(&BLOCKS, values, memory)?, memory.vector());
        FACTORS.list(values, blocks.count(), |b, factor| factors.as_mut()[b] = factor)?;
        Ok(Self { blocks, factors })
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        let (rows, columns) = (1, self.blocks.count());
        let factors = |b: usize| self.factors()[b].to_f64();
        each(FACTORS.name, Value::Matrix { rows, columns, elements: &factors });
        let sizes = |b: usize| self.blocks.size(b);
        each(BLOCKS.name, Value::Matrix { rows, columns, elements: &sizes });
    }

    fn start(&self, memory: M) -> BlockFactors<M> {
        BlockFactors::new(memory)
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        // R_bb ≤ β/(1 − λ_b), and R is at most blkdiag(λ_b R_bb) + β I after a sample
        let most = self.factors().iter().fold(0.0, |most, lambda| lambda.to_f64().max(most));
        Bounds { below: constants.least_remembered(most), above: None }
    }

    fn follow(&self, state: &mut BlockFactors<M>, step: Step<'_, '_, M>) {
        state.start_once(&self.blocks, step.factor);
        for mut block in state.each(&self.blocks) {
            block.measure(step.sample, step.work.gain.as_mut());
        }
    }

    fn change_units(&self, state: &mut BlockFactors<M>, ratios: &[M::Real]) {
        if state.is_started() {
            state.each(&self.blocks).for_each(|mut block| block.change_units(ratios));
        }
    }

    fn restart(
        &self,
        state: &mut BlockFactors<M>,
        step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        state.clear();
        Ok(Forgotten::rank(step.factor.parameters()))
    }

    #[inline]
    fn forget(
        &self,
        state: &mut BlockFactors<M>,
        step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        let fresh = !state.is_started();
        state.start_once(&self.blocks, step.factor);
        // of the blocks themselves: what rounding made of P says nothing of them
        if let Err(error) = step.factor.set_bound(self.discounted_trace(state)) {
            if fresh {
                state.clear();
            }
            return Err(error);
        }
        step.factor.clear_columns();
        for (mut block, &lambda) in state.each(&self.blocks).zip(self.factors()) {
            block.discount(lambda);
            step.factor.put_block(block.start, block.columns, block.diagonal);
            block.measure(step.sample, step.work.gain.as_mut());
        }
        Ok(Forgotten::rank(step.factor.parameters()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget, memory, Dense};

    #[test]
    fn keeps_the_discounted_blocks_and_nothing_between_them() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let memory = memory(&phi, 1);
        let rule = Multiple::new(&[0.9, 0.5], &[2, 1], memory).unwrap();
        let found = forget(&rule, &mut rule.start(memory), &p, &phi, 1.0);
        let r = p.inverse();
        let kept = |i: usize, j: usize| match (i < 2, j < 2) {
            (true, true) => 0.9 * r.at(i, j),
            (false, false) => 0.5 * r.at(i, j),
            _ => 0.0,
        };
        let kept: alloc::vec::Vec<f64> = (0..9).map(|k| kept(k / 3, k % 3)).collect();
        assert!(found.covariance.inverse().distance(&Dense::new(3, &kept)) < 1e-14);
    }

    #[test]
    fn blocks_must_add_up() {
        let memory = crate::memory::Dynamic::<f64>::new(3, 1, 1).unwrap();
        for blocks in [&[1, 1][..], &[2, 2], &[0, 3], &[4]] {
            let factors = [0.9; 2];
            assert!(Multiple::new(&factors[..blocks.len()], blocks, memory).is_err());
        }
        let second = Multiple::new(&[0.9, 1.1], &[1, 2], memory).unwrap_err();
        assert!(matches!(second, Error::Value { parameter: "factors", index: Some(1), .. }));
        assert!(Multiple::new(&[0.9], &[1, 2], memory).is_err());
    }
}
