//! The information of each block of parameters, apart from that of the others.

use crate::covariance::{trace, Factor};
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use crate::rules::Blocks;
use crate::sample::Sample;
use core::mem::take;
use core::ops::Range;
use forgetting_kernels::kernel::functions::{add_scaled, bierman, dot};
use forgetting_kernels::kernel::layout::{length, place, set_identity};
use forgetting_kernels::{Kernels, Real};

/// R_bb⁻¹ of every block, each U D Uᵀ.
#[derive(Clone, Debug)]
pub struct BlockFactors<M: Memory> {
    /// one block after the other, each packed as in [`Factor`]
    columns: M::Packed,
    diagonal: M::Vector,
    /// 1 once taken from the first P
    started: u64,
    /// not state: the rows from which a block is started
    rows: M::Square,
}

impl<M: Memory> BlockFactors<M> {
    /// Before the first sample.
    pub(super) fn new(memory: M) -> Self {
        let (columns, diagonal) = (memory.packed(), memory.vector());
        Self { columns, diagonal, started: 0, rows: memory.square() }
    }

    /// Back to before the first sample.
    pub(super) fn clear(&mut self) {
        self.columns.as_mut().fill(M::Real::ZERO);
        self.diagonal.as_mut().fill(M::Real::ZERO);
        self.started = 0;
    }

    /// Whether the blocks were taken from a P.
    pub(super) fn is_started(&self) -> bool {
        self.started != 0
    }

    /// Takes the blocks of the first P.
    pub(super) fn start_once(&mut self, blocks: &Blocks<M>, factor: &Factor<M>) {
        if self.started == 0 {
            let rows = self.rows.as_mut();
            for mut block in each(self.columns.as_mut(), self.diagonal.as_mut(), blocks.ranges()) {
                block.take_from(factor, rows);
            }
            self.started = 1;
        }
    }

    /// Every block.
    #[inline]
    pub(super) fn each<'a>(
        &'a mut self,
        blocks: &'a Blocks<M>,
    ) -> impl Iterator<Item = Block<'a, M::Real>> {
        each(self.columns.as_mut(), self.diagonal.as_mut(), blocks.ranges())
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

/// R_bb⁻¹ = U D Uᵀ of one block.
pub(super) struct Block<'a, T> {
    /// its first parameter
    pub start: usize,
    /// U
    pub columns: &'a mut [T],
    /// D
    pub diagonal: &'a mut [T],
}

/// The block of each of these ranges of parameters.
#[inline]
fn each<'a, T: Real>(
    mut columns: &'a mut [T],
    mut diagonal: &'a mut [T],
    ranges: impl Iterator<Item = Range<usize>> + 'a,
) -> impl Iterator<Item = Block<'a, T>> {
    ranges.map(move |range| {
        let (own, others) = take(&mut columns).split_at_mut(length::<T>(range.len()));
        let (own_diagonal, others_diagonal) = take(&mut diagonal).split_at_mut(range.len());
        (columns, diagonal) = (others, others_diagonal);
        Block { start: range.start, columns: own, diagonal: own_diagonal }
    })
}

impl<T: Kernels> Block<'_, T> {
    /// R_bb⁻¹ = (B Bᵀ)⁻¹ with B the rows D^(−1/2)U⁻¹e_i of the block, from the U and D of P: when
    /// q_t = Σ_u U_ut B_u are the rows made orthogonal one after the other, D_t = 1/‖q_t‖².
    fn take_from<M: Memory<Real = T>>(&mut self, factor: &Factor<M>, rows: &mut [T]) {
        let (n, size) = (factor.parameters(), self.diagonal.len());
        set_identity(self.columns, size);
        for t in 0..size {
            let (done, row) = rows.split_at_mut(t * n);
            let row = &mut row[..n];
            row.fill(T::ZERO);
            row[self.start + t] = T::ONE;
            factor.solve(row);
            for (x, &d) in row.iter_mut().zip(factor.diagonal_elements()) {
                *x /= d.sqrt();
            }
            for (u, q) in done.chunks_exact(n).enumerate() {
                let share = dot(q, row) / dot(q, q);
                add_scaled(row, -share, q);
                self.columns[place::<T>(u, t)] -= share;
                for i in 0..u {
                    let above = self.columns[place::<T>(i, u)];
                    self.columns[place::<T>(i, t)] -= share * above;
                }
            }
            self.diagonal[t] = within_range(T::ONE / dot(row, row));
        }
    }

    /// tr R_bb⁻¹
    pub fn trace(&self) -> T {
        trace(self.columns, self.diagonal)
    }

    /// R_bb ← λ R_bb
    #[inline]
    pub fn discount(&mut self, lambda: T) {
        self.diagonal.iter_mut().for_each(|d| *d = (*d / lambda).min(T::CEILING));
    }

    /// R_bb ← R_bb + φ̄_bᵀφ̄_b
    #[inline]
    pub fn measure<M: Memory<Real = T>>(&mut self, sample: &Sample<'_, M>, gain: &mut [T]) {
        for i in 0..sample.rows() {
            let row = &sample.row(i)[self.start..self.start + self.diagonal.len()];
            bierman(self.columns, self.diagonal, row, gain);
        }
    }

    /// R_bb⁻¹ ← S_b R_bb⁻¹ S_b with S = diag(`ratios`), of all parameters.
    pub fn change_units(&mut self, ratios: &[T]) {
        let ratios = &ratios[self.start..self.start + self.diagonal.len()];
        for (j, &ratio) in ratios.iter().enumerate() {
            for (i, &above) in ratios[..j].iter().enumerate() {
                self.columns[place::<T>(i, j)] *= above / ratio;
            }
            self.diagonal[j] = within_range(self.diagonal[j] * ratio * ratio);
        }
    }
}

/// The nearest element that D can have.
fn within_range<T: Real>(d: T) -> T {
    d.max(T::FLOOR).min(T::CEILING)
}
