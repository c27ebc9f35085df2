//! Forgets each parameter, or each block of parameters, at a rate of its own.
//!
//! ```text
//! P̄ = P + blkdiag((1/λ_b − 1) P_bb)        West & Harrison, discounting by component
//! F_k = R − P̄⁻¹                            the same as Theorem 1 of GF-RLS has it; the form
//!                                          used: P_bb = V diag(d) Vᵀ, one dyad for each v; for blocks
//!                                          of one parameter the part that the sample depends on
//! P̄ = P + (1/λ_bᶜ − 1) P_bb, b = k mod c   cyclic: one of the c blocks a sample, for c samples
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | n_b | blocks | sizes of consecutive blocks, whole numbers from 1 that sum to n, or one size for all | 1 |
//! | λ_b | factors | (0, 1], one number a block or one for all | the forgetting factor λ_k |
//! | | schedule | "every_sample" forgets all blocks at each sample, "cyclic" one block | "every_sample" |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. In silence the variances of block b grow as
//!   λ_b⁻ᵏ (windup).
//! - P bounded below (A3): if λ_b ≤ λ_max < 1 and φ is bounded.
//! - Cost: O((p + 1) n²) with blocks of one parameter; O(n³) with larger ones, one dyad for each parameter;
//!   O(p n²) with one block of all parameters, which is `exponential`; cyclic O((p + n_b) n²) for blocks of n_b.
//!   State: P, in n²/2 numbers more for blocks of one parameter, and whose turn it is.
//! - Use it when parameters are known to drift at different rates. `multiple` drops what the
//!   blocks know of each other and is rarely proper; this rule keeps it. Use the cyclic schedule
//!   where n and the blocks are large and λ_bᶜ is not small: in silence P is that of the other after each cycle,
//!   exactly, and the same is guaranteed. k counts the samples used.
//!
//! Reference: M. West, J. Harrison, *Bayesian Forecasting and Dynamic Models*, 2nd edition,
//! Springer, 1997, section 6.3.

use super::block_root::BlockRoot;
use super::blocks::Blocks;
use super::cycle::{self, Cycle};
use super::{Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::memory::state::{State, Visitor};
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::factor_after;
use forgetting_kernels::Real;

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

const SCHEDULE: Parameter = cycle::schedule(
    "when blocks are forgotten: all of them at each sample, or one block a sample, in O(n^2)",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    squares: 2,
    cost: "O((p + 1) n^2), with blocks O(n^3); cyclic O((p + largest block) n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(Setting::usual(Input::Fixed)),
        bounded_below: Guarantee::when(
            "forgetting factors <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[BLOCKS, FACTORS, SCHEDULE])
};

/// Forgets each block at its own rate; see [`self`](crate::rules::component).
#[derive(Clone, Debug)]
pub struct Component<M: Memory> {
    memory: M,
    blocks: Blocks<M>,
    /// λ_b for each block, where they were given
    forgetting_factors: Option<M::Vector>,
    cyclic: bool,
}

/// Whose turn it is, if the blocks take turns; and room for the root of one, which does not last.
#[derive(Clone, Debug)]
pub struct Turns<M: Memory> {
    cycle: Option<Cycle>,
    root: BlockRoot<M>,
}

impl<M: Memory> State<M::Real> for Turns<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.cycle.visit(visitor);
    }
}

impl<M: Memory> Component<M> {
    /// Each block at the common forgetting factor.
    pub fn new(memory: M, blocks: Blocks<M>) -> Self {
        Self { memory, blocks, forgetting_factors: None, cyclic: false }
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

    /// The same with one block a sample.
    #[must_use]
    pub fn cyclic(self) -> Self {
        Self { cyclic: true, ..self }
    }

    /// λ_b^Δt, `common` being that already.
    #[inline]
    fn factor(&self, block: usize, common: M::Real, elapsed: M::Real) -> M::Real {
        let own = self.forgetting_factors.as_ref();
        own.map_or(common, |factors| factor_after(factors.as_ref()[block], elapsed))
    }

    /// The smallest of them.
    #[inline]
    fn smallest(&self, common: M::Real, elapsed: M::Real) -> M::Real {
        let factors = (0..self.blocks.count()).map(|b| self.factor(b, common, elapsed));
        factors.fold(M::Real::ONE, M::Real::min)
    }
}

impl<M: Memory> Forgetting<M> for Component<M> {
    type State = Turns<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let cyclic = cycle::is_cyclic(&SCHEDULE, values)?;
        let rule = Self::new(memory, Blocks::configure(&BLOCKS, values, memory)?);
        let rule = Self { cyclic, ..rule };
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
        each(SCHEDULE.name, cycle::word(self.cyclic));
    }

    fn start(&self, memory: M) -> Turns<M> {
        Turns { cycle: self.cyclic.then(Cycle::default), root: BlockRoot::new(memory) }
    }

    /// Where every block is a parameter.
    fn defers(&self) -> bool {
        !self.cyclic && self.blocks.count() == self.memory.parameters()
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let common = M::Real::from_f64(constants.forgetting_factors.1);
        let factors = (0..self.blocks.count()).map(|b| self.factor(b, common, M::Real::ONE).to_f64());
        let largest = factors.fold(0.0, f64::max);
        if !self.cyclic {
            return Bounds { below: constants.least_remembered(largest), above: None };
        }
        // R grows by β a sample until it is a block's turn, which makes it λᶜ of what it was there
        let count = self.blocks.count() as f64;
        let (grown, kept) = (count * constants.regressor_bound, libm::pow(largest, count));
        let after = (1.0 / constants.initial.0).max(kept * grown / (1.0 - kept));
        Bounds { below: positive(1.0 / (grown + after)), above: None }
    }

    #[inline]
    fn forget(&self, turns: &mut Turns<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let (factor, common, elapsed) = (step.factor, step.forgetting_factor, step.elapsed);
        let (smallest, count) = (self.smallest(common, elapsed), self.blocks.count());
        if count == 1 {
            factor.scale(M::Real::ONE / smallest)?;
            let rank = if smallest < M::Real::ONE { factor.parameters() } else { 0 };
            return Ok(Forgotten::rank(rank).with_factor(smallest.to_f64()));
        }
        let turn = turns.cycle.map(|cycle| cycle.turn(count));
        let samples = if turn.is_some() { count } else { 1 };
        let due = || {
            let ranges = self.blocks.ranges().enumerate();
            let due = ranges.filter(move |&(b, _)| turn.is_none_or(|turn| turn == b));
            due.map(|(b, range)| (growth(self.factor(b, common, elapsed), samples), range))
                .filter(|(weight, _)| *weight > M::Real::ZERO)
        };
        let variances = &mut step.work.first.as_mut()[..factor.parameters()];
        factor.variances(variances);
        let (mut added, mut rank) = (M::Real::ZERO, 0);
        for (weight, range) in due() {
            rank += range.len();
            added = variances[range].iter().fold(added, |sum, &v| weight.mul_add(v, sum));
        }
        factor.reserve(M::Real::ONE, added)?;
        if factor.is_deferring() {
            let weight = |i| growth(self.factor(i, common, elapsed), samples);
            factor.defer_diagonal(|i| weight(i) * variances[i], step.work.gain.as_mut());
            return Ok(Forgotten::rank(rank).with_factor(smallest.to_f64()));
        }
        for (weight, range) in due() {
            turns.root.compute(factor, range.clone(), variances, step.work.gain.as_mut());
            turns.root.add_to(factor, range, weight, step.work.gain.as_mut());
        }
        if let Some(cycle) = &mut turns.cycle {
            cycle.pass(count);
        }
        Ok(Forgotten::rank(rank).with_factor(smallest.to_f64()))
    }
}

/// 1/λᶜ − 1 for c samples.
#[inline]
fn growth<T: Real>(lambda: T, samples: usize) -> T {
    let kept = (1..samples).fold(lambda, |product, _| product * lambda);
    (T::ONE - kept) / kept
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
    fn a_cycle_in_silence_is_as_many_samples() {
        let (mut p, silence) = (covariance(), Dense::new(1, &[0.0; 3]));
        let m = memory(&silence, 1);
        let rule = Component::new(m, Blocks::new(m, &[2, 1]).unwrap());
        let (all, turns) = (rule.clone(), rule.cyclic());
        let mut expected = p.clone();
        let mut cycle = turns.start(m);
        for _ in 0..2 {
            expected = forget(&all, &mut all.start(m), &expected, &silence, 0.8).covariance;
            p = forget(&turns, &mut cycle, &p, &silence, 0.8).covariance;
        }
        assert!(p.distance(&expected) < 1e-14);
    }

    #[test]
    fn refuses_blocks_that_do_not_fit() {
        let m = memory(&Dense::zero(1, 3), 1);
        for sizes in [&[1, 1][..], &[2, 2], &[3, 0], &[1, 1, 1, 1], &[]] {
            assert!(Blocks::new(m, sizes).is_err(), "{sizes:?}");
        }
    }
}
