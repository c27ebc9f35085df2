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

use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::memory::state::{State, Visitor, is_finite};
use crate::covariance::{trace, Factor};
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::Sample;
use forgetting_kernels::Real;
use forgetting_kernels::kernel::functions::{add_scaled, bierman, dot};
use forgetting_kernels::kernel::layout::{length, place, set_identity};

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
    /// number of blocks
    count: usize,
    /// sizes of the blocks, whole numbers
    sizes: M::Vector,
    /// λ_b
    factors: M::Vector,
}

impl<M: Memory> Multiple<M> {
    /// With consecutive blocks of these sizes and a forgetting factor for each.
    ///
    /// # Errors
    /// [`Error`] names `blocks` unless they add up to n, or `factors`.
    pub fn new(factors: &[M::Real], blocks: &[usize], memory: M) -> Result<Self, Error> {
        Error::check_length(FACTORS.name, factors.len(), blocks.len())?;
        Self::of(memory, blocks.len(), &|b| factors[b].to_f64(), &|b| blocks[b] as f64)
    }

    /// With the factors given in `values`.
    fn with_blocks(
        values: &dyn Values,
        memory: M,
        count: usize,
        size: &dyn Fn(usize) -> f64,
    ) -> Result<Self, Error> {
        match FACTORS.look_up(values)? {
            Value::Real(factor) => Self::of(memory, count, &|_| factor, size),
            Value::Matrix { rows, columns, elements } => {
                Error::check_length(FACTORS.name, rows * columns, count)?;
                Self::of(memory, count, elements, size)
            }
            _ => Err(Error::value(FACTORS.name, f64::NAN, "numbers")),
        }
    }

    fn of(
        memory: M,
        count: usize,
        factor: &dyn Fn(usize) -> f64,
        size: &dyn Fn(usize) -> f64,
    ) -> Result<Self, Error> {
        let n = memory.parameters();
        let (mut sizes, mut factors, mut end) = (memory.vector(), memory.vector(), 0.0);
        for b in 0..count {
            let one = size(b);
            end += one;
            if !(one >= 1.0 && libm::trunc(one) == one && end <= n as f64) {
                return Err(refuse(BLOCKS.name, b, one, "whole numbers >= 1 that add up to n"));
            }
            let lambda = FACTORS
                .convert(factor(b))
                .map_err(|_| refuse(FACTORS.name, b, factor(b), FACTORS.range.words))?;
            sizes.as_mut()[b] = M::Real::from_f64(one);
            factors.as_mut()[b] = lambda;
        }
        if end != n as f64 {
            return Err(Error::value(
                BLOCKS.name,
                end,
                "sizes that add up to the number of parameters",
            ));
        }
        Ok(Self { count, sizes, factors })
    }

    /// Each block: its first parameter, its size and its factor.
    #[inline]
    fn blocks(&self) -> impl Iterator<Item = (usize, usize, M::Real)> + '_ {
        let sizes = self.sizes.as_ref()[..self.count].iter().map(|size| size.to_f64() as usize);
        sizes.zip(self.factors.as_ref()).scan(0, |start, (size, &factor)| {
            *start += size;
            Some((*start - size, size, factor))
        })
    }

    /// The trace of P̄: that of each block, divided by its λ.
    fn discounted_trace(&self, state: &BlockFactors<M>) -> M::Real {
        let mut offset = 0;
        self.blocks().fold(M::Real::ZERO, |sum, (start, size, lambda)| {
            let columns = &state.columns.as_ref()[offset..];
            offset += length::<M::Real>(size);
            sum + trace(columns, &state.diagonal.as_ref()[start..start + size]) / lambda
        })
    }

    /// Takes the blocks of the first P.
    fn start_once(&self, state: &mut BlockFactors<M>, factor: &Factor<M>) {
        if state.started == 0 {
            let mut offset = 0;
            for (start, size, _) in self.blocks() {
                state.start_block(factor, start, size, offset);
                offset += length::<M::Real>(size);
            }
            state.started = 1;
        }
    }
}

/// R_bb ← R_bb + φ̄_bᵀφ̄_b for the block of parameters from `start` on.
#[inline]
fn measure_block<M: Memory>(
    (columns, diagonal): (&mut [M::Real], &mut [M::Real]),
    start: usize,
    sample: &Sample<'_, M>,
    gain: &mut [M::Real],
) {
    for i in 0..sample.rows() {
        let row = &sample.row(i)[start..start + diagonal.len()];
        bierman(columns, diagonal, row, gain);
    }
}

fn refuse(parameter: &'static str, index: usize, value: f64, allowed: &'static str) -> Error {
    Error::Value { parameter, index: Some(index), value, allowed }
}

/// R_bb⁻¹ of every block, each U D Uᵀ.
#[derive(Clone, Debug)]
pub struct BlockFactors<M: Memory> {
    /// one block after the other, each packed as in [`Factor`]
    columns: M::Packed,
    diagonal: M::Vector,
    /// 1 once taken from the first P
    started: u64,
    work: M::Square,
}

impl<M: Memory> BlockFactors<M> {
    /// Back to before the first sample.
    fn clear(&mut self) {
        self.columns.as_mut().fill(M::Real::ZERO);
        self.diagonal.as_mut().fill(M::Real::ZERO);
        self.started = 0;
    }

    /// R_bb⁻¹ = (B Bᵀ)⁻¹ with B the rows D^(−1/2)U⁻¹e_i of the block: when q_t = Σ_u U_ut B_u are
    /// the rows made orthogonal one after the other, D_t = 1/‖q_t‖².
    fn start_block(&mut self, factor: &Factor<M>, start: usize, size: usize, offset: usize) {
        let n = factor.parameters();
        let rows = &mut self.work.as_mut()[..size * n];
        let columns = &mut self.columns.as_mut()[offset..offset + length::<M::Real>(size)];
        set_identity(columns, size);
        for t in 0..size {
            let (done, row) = rows.split_at_mut(t * n);
            let row = &mut row[..n];
            row.fill(M::Real::ZERO);
            row[start + t] = M::Real::ONE;
            factor.solve(row);
            for (x, &d) in row.iter_mut().zip(factor.diagonal_elements()) {
                *x /= d.sqrt();
            }
            for (u, q) in done.chunks_exact(n).enumerate() {
                let share = dot(q, row) / dot(q, q);
                add_scaled(row, -share, q);
                columns[place::<M::Real>(u, t)] -= share;
                for i in 0..u {
                    let above = columns[place::<M::Real>(i, u)];
                    columns[place::<M::Real>(i, t)] -= share * above;
                }
            }
            self.diagonal.as_mut()[start + t] =
                (M::Real::ONE / dot(row, row)).max(M::Real::FLOOR).min(M::Real::CEILING);
        }
    }
}

impl<M: Memory> Forgetting<M> for Multiple<M> {
    type State = BlockFactors<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        match BLOCKS.look_up(values)? {
            Value::Real(size) => {
                let count = memory.parameters() as f64 / BLOCKS.check(size)?;
                Self::with_blocks(values, memory, libm::floor(count) as usize, &|_| size)
            }
            Value::Matrix { rows, columns, elements } => {
                Self::with_blocks(values, memory, rows * columns, elements)
            }
            _ => Err(Error::value(BLOCKS.name, f64::NAN, "numbers")),
        }
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        let (rows, columns) = (1, self.count);
        let factors = |b: usize| self.factors.as_ref()[b].to_f64();
        each(FACTORS.name, Value::Matrix { rows, columns, elements: &factors });
        let sizes = |b: usize| self.sizes.as_ref()[b].to_f64();
        each(BLOCKS.name, Value::Matrix { rows, columns, elements: &sizes });
    }

    fn start(&self, memory: M) -> BlockFactors<M> {
        let (columns, diagonal) = (memory.packed(), memory.vector());
        BlockFactors { columns, diagonal, started: 0, work: memory.square() }
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        // R_bb ≤ β/(1 − λ_b), and R is at most blkdiag(λ_b R_bb) + β I after a sample
        let most = self.blocks().fold(0.0, |most, (_, _, lambda)| lambda.to_f64().max(most));
        Bounds { below: constants.least_remembered(most), above: None }
    }

    fn follow(&self, state: &mut BlockFactors<M>, step: Step<'_, '_, M>) {
        self.start_once(state, step.factor);
        let mut offset = 0;
        for (start, size, _) in self.blocks() {
            let columns = &mut state.columns.as_mut()[offset..offset + length::<M::Real>(size)];
            let diagonal = &mut state.diagonal.as_mut()[start..start + size];
            measure_block((columns, diagonal), start, step.sample, step.work.gain.as_mut());
            offset += length::<M::Real>(size);
        }
    }

    fn change_units(&self, state: &mut BlockFactors<M>, ratios: &[M::Real]) {
        let mut offset = 0;
        for (start, size, _) in self.blocks() {
            let columns = &mut state.columns.as_mut()[offset..offset + length::<M::Real>(size)];
            let ratios = &ratios[start..start + size];
            for (j, &ratio) in ratios.iter().enumerate() {
                for (i, &above) in ratios[..j].iter().enumerate() {
                    columns[place::<M::Real>(i, j)] *= above / ratio;
                }
                let d = state.diagonal.as_ref()[start + j] * ratio * ratio;
                let d = d.max(M::Real::FLOOR).min(M::Real::CEILING);
                // 0 before the first sample
                if state.started != 0 {
                    state.diagonal.as_mut()[start + j] = d;
                }
            }
            offset += length::<M::Real>(size);
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
        let fresh = state.started == 0;
        self.start_once(state, step.factor);
        // of the blocks themselves: what rounding made of P says nothing of them
        if let Err(error) = step.factor.set_bound(self.discounted_trace(state)) {
            if fresh {
                state.clear();
            }
            return Err(error);
        }
        step.factor.clear_columns();
        let mut offset = 0;
        for (start, size, lambda) in self.blocks() {
            let columns = &mut state.columns.as_mut()[offset..offset + length::<M::Real>(size)];
            let diagonal = &mut state.diagonal.as_mut()[start..start + size];
            diagonal.iter_mut().for_each(|d| *d = (*d / lambda).min(M::Real::CEILING));
            step.factor.put_block(start, columns, diagonal);
            measure_block((columns, diagonal), start, step.sample, step.work.gain.as_mut());
            offset += length::<M::Real>(size);
        }
        Ok(Forgotten::rank(step.factor.parameters()))
    }
}

impl<M: Memory> State<M::Real> for BlockFactors<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.columns.as_mut());
        visitor.reals(self.diagonal.as_mut());
        visitor.whole(&mut self.started);
    }

    fn is_sound(&self) -> bool {
        let in_range = |d: &M::Real| *d >= M::Real::FLOOR && *d <= M::Real::CEILING;
        is_finite(self) && (self.started == 0 || self.diagonal.as_ref().iter().all(in_range))
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
        assert!(Multiple::new(&[0.9, 1.1], &[1, 2], memory).is_err());
        assert!(Multiple::new(&[0.9], &[1, 2], memory).is_err());
    }
}
