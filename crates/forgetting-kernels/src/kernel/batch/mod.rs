//! Several samples in each sweep over U, when P is scaled between them.
//!
//! Sample l needs Uᵀf with the U that the samples before it leave. Each of them does the same to
//! a row of numbers below U, Uᵀf of any f, as to the rows of U: so all four products with the U of
//! before are taken together, and follow from there by what passes from column to column.
//!
//! ```text
//! for each column j, each sample l, each m < l in turn:
//!     w_lj ← w_lj + slope_mj g_ml,  g_ml ← g_ml + v_mj w_lj   (the w of before; g_ml = f_l k_m)
//! then slope_lj and v_lj from w_lj as of one sample alone ([`super::bierman`])
//! for each column j:  all four changes of u_j, with one load and one store
//! ```
//!
//! The products of the next samples with a column are taken as soon as it is changed, while it is in the
//! nearest cache.
//!
//! The g are what the errors need, too: e_l = y_l − φ_l θ − Σ_{m<l} g_ml e_m / a_m with the θ of
//! before. Numbers are rounded in another order than those of samples one by one, and digits are
//! lost where a sample before takes most of what w was: not so many that it matters, as long as
//! rounding fᵀPf with the P of before costs less than the variance of the noise ([`keeps_digits`]).

mod measure;

use super::layout::BLOCK;
use super::tiles::{
    block, block_mut, change_columns, dots_beside, load_per_column, padding_d, store_per_column,
    PerColumn, RankOne,
};
use crate::number::block_vector::BlockVector;
use crate::number::lane::Lane;
use crate::number::vector::Vector;
use crate::number::Real;

/// The samples of a batch.
pub const BATCH: usize = 4;

/// A number for each sample.
pub type PerSample<T> = [T; BATCH];

/// Room beside U for a batch. The vectors lie side by side: their numbers for the rows of a tile
/// are neighbours.
pub struct Room<'a, T: Real> {
    /// f
    pub f: &'a mut [PerSample<T::Chunk>],
    /// P·f of each, with the P between scaling and measurement, at the end
    pub k: &'a mut [PerSample<T::Chunk>],
    /// [`W_THEN_SLOPE`] and [`V`]
    changes: &'a mut [PerSample<[PerColumn<T>; 2]>],
    d: &'a mut [PerColumn<T>],
}

/// Whether rounding fᵀPf does less than the variance of the noise.
#[inline(always)]
pub fn keeps_digits<T: Real>(leverage: T) -> bool {
    leverage * T::EPSILON <= T::ONE
}

/// Uᵀf, then what becomes of it.
const W_THEN_SLOPE: usize = 0;
const V: usize = 1;

impl<'a, T: Real> Room<'a, T> {
    /// In the scratch of n parameters.
    #[inline(always)]
    pub fn of(scratch: &'a mut [T], n: usize) -> Self {
        let (tiles, blocks) = (n.div_ceil(T::ROWS), n.div_ceil(BLOCK));
        let (beside, columns) = scratch.split_at_mut(2 * BATCH * tiles * T::ROWS);
        let (f, k) = T::chunks_mut(beside).0.as_chunks_mut().0.split_at_mut(tiles);
        let (changes, rest) = columns.as_chunks_mut().0.split_at_mut(2 * BATCH * blocks);
        let changes = changes.as_chunks_mut().0.as_chunks_mut().0;
        Self { f, k, changes, d: &mut rest[..blocks] }
    }

    /// Goes through the columns of U once: changes them and D by what all samples do if they are
    /// `done`, then finds w of the `next` samples, which are in f, and takes D. Returns at least
    /// the largest fᵀPf of all but the first of those, with the P of before them.
    #[inline(always)]
    pub fn sweep<V: Vector<T>, const GROUP: usize>(
        &mut self,
        (columns, diagonal): (&mut [T], &mut [T]),
        done: bool,
        next: bool,
    ) -> T {
        let mut leverages = [V::BlockVector::splat(T::ZERO); BATCH];
        for b in 0..self.d.len().min(self.changes.len()) {
            let (d, changes) = (&mut self.d[b], &mut self.changes[b]);
            if done {
                store_per_column(diagonal, b, V::BlockVector::read(d));
                let mut all = [change(&changes[0]); BATCH];
                for l in 1..BATCH {
                    all[l] = change(&changes[l]);
                }
                change_columns::<T, V, _, GROUP, BATCH>((block_mut(columns, b), b), self.k, &all);
            }
            if next {
                let own = load_per_column::<T, V::BlockVector>(diagonal, b, padding_d());
                own.write(d);
                let w = dots_beside::<T, V, GROUP, BATCH>(block(columns, b), self.f);
                for l in 0..BATCH {
                    w[l].write(&mut changes[l][W_THEN_SLOPE]);
                    leverages[l] = (own * w[l]).mul_add(w[l], leverages[l]);
                }
            }
        }
        let mut most = leverages[1];
        for l in 2..BATCH {
            most = most.max(leverages[l]);
        }
        most.running_sums().last().numbers()[0]
    }
}

/// What a sample does to the columns of a block.
#[inline(always)]
fn change<T>(changes: &[PerColumn<T>; 2]) -> RankOne<'_, T> {
    RankOne { slope: &changes[W_THEN_SLOPE], factor: &changes[V] }
}
