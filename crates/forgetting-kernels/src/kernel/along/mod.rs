//! Forgetting along a regressor and measuring it, in two sweeps over U: for more than ten
//! parameters, and for `B` samples together.
//!
//! P ← P + c·fᵀf is Agee and Turner's update (see [`super::agee_turner`]). Its x starts with f and
//! loses z_j u_j at column j, from the last to the first; as f = U z, the x of column j is also
//! the sum of z_i u_i over the columns before it, and can be built from the first to the last,
//! as Bierman's gain is. So both updates are one sweep, after one that finds z = U⁻¹f and w = Uᵀf:
//!
//! ```text
//! from the last block:   z, w, q = z / D;  fᵀP⁻¹f = Σ z q;  t_j = 1/c + Σ_{i>j} z_i q_i
//! from the first:        D'_j = D_j + z_j² / t_j,  widening_j = q_j / (t_j + z_j q_j) = q_j / t_{j−1}
//!                        w'_j = w_j + widening_j p,  p ← p + z_j w_j                  (w' = U'ᵀf)
//!                        u' = u + widening x,  x ← x + z u,  then Bierman with u' and w'
//! ```
//!
//! What the first sample does to U it does to the w of the second, too, as in [`super::batch`]; what
//! it does to the z of the second is the inverse, with sums from the other end:
//!
//! ```text
//! z_j ← z_j − (z_j / t_j of the first) Σ_{i>j} q_i z_i        the inverse of u' = u + widening x
//! z_j ← z_j + (v_j / a_j of the first) Σ_{i>j} w'_i z_i       the inverse of Bierman's update
//! ```
//!
//! O(3 n²) a sample, twice Bierman's update alone.

mod sample;
mod solve;

use super::bierman::settle;
use super::layout::BLOCK;
use super::tiles::{
    block, block_mut, change_columns, dots_beside, load_per_column, padding_d, PerColumn, RankOne,
};
use crate::number::block_vector::BlockVector;
use crate::number::vector::Vector;
use crate::number::Real;
use solve::solve;

/// How many vectors of n numbers `B` samples need to work with.
pub const fn each(samples: usize) -> usize {
    OF_ALL + samples * (4 + OF_ONE)
}

/// Vectors of numbers for each column: what is kept of one sample, …
const OF_ONE: usize = 4;
/// … and of all.
const OF_ALL: usize = 6;

/// Room beside U for `B` samples, with `R` = 2 `B` vectors that build up on the way through the
/// columns. The vectors lie side by side: their numbers for the rows of a tile are neighbours.
pub struct Room<'a, T: Real, const B: usize, const R: usize> {
    /// f
    pub f: &'a mut [[T::Chunk; B]],
    z: &'a mut [[T::Chunk; B]],
    /// x and k of each
    sums: &'a mut [[T::Chunk; R]],
    of_one: &'a mut [[[PerColumn<T>; OF_ONE]; B]],
    of_all: &'a mut [[PerColumn<T>; OF_ALL]],
}

// what is kept of one sample
const W: usize = 0;
const WIDENING: usize = 1;
const SLOPE: usize = 2;
const V: usize = 3;
// what is kept of all
const D: usize = 0;
/// z / D
const Q: usize = 1;
/// the sum of z q over the columns after each
const LATER: usize = 2;
/// z / t of the first
const Z_OVER_T: usize = 3;
/// w' of the first
const WIDENED: usize = 4;
/// v / a of the first
const V_OVER_A: usize = 5;

impl<'a, T: Real, const B: usize, const R: usize> Room<'a, T, B, R> {
    /// In the scratch of n parameters.
    #[inline(always)]
    pub fn of(scratch: &'a mut [T], n: usize) -> Self {
        let (tiles, blocks) = (n.div_ceil(T::ROWS), n.div_ceil(BLOCK));
        let (beside, columns) = scratch.split_at_mut((2 * B + R) * tiles * T::ROWS);
        let (f, rest) = T::chunks_mut(beside).0.split_at_mut(B * tiles);
        let (z, sums) = rest.split_at_mut(B * tiles);
        let (f, z, sums) = (f.as_chunks_mut().0, z.as_chunks_mut().0, sums.as_chunks_mut().0);
        let (of_one, rest) = columns.as_chunks_mut().0.split_at_mut(OF_ONE * B * blocks);
        let of_one = of_one.as_chunks_mut().0.as_chunks_mut().0;
        let of_all = rest[..OF_ALL * blocks].as_chunks_mut().0;
        Self { f, z, sums, of_one, of_all }
    }

    /// Finds z and w of all samples, with the U and D of before them.
    #[inline(always)]
    pub fn look<V: Vector<T>, const GROUP: usize>(&mut self, columns: &[T], diagonal: &[T]) {
        for b in 0..self.of_all.len() {
            let d = load_per_column::<T, V::BlockVector>(diagonal, b, padding_d());
            d.write(&mut self.of_all[b][D]);
            let w = dots_beside::<T, V, GROUP, B>(block(columns, b), self.f);
            for l in 0..B {
                w[l].write(&mut self.of_one[b][l][W]);
            }
        }
        for t in 0..self.z.len().min(self.f.len()) {
            for l in 0..B {
                V::load(&self.f[t][l]).store(&mut self.z[t][l]);
            }
        }
        solve::<T, V, B>(columns, self.of_all.len(), self.z);
    }

    /// Changes U and D by what all samples do.
    #[inline(always)]
    pub fn carry_out<V: Vector<T>, const GROUP: usize>(
        &mut self,
        columns: &mut [T],
        diagonal: &mut [T],
    ) {
        for b in 0..self.of_all.len() {
            let mut changes =
                [RankOne { slope: &self.of_all[b][D], factor: &self.of_all[b][D] }; R];
            for l in 0..B {
                let own = &self.of_one[b][l];
                changes[2 * l] = RankOne { slope: &own[WIDENING], factor: z_of(self.z, l, b) };
                changes[2 * l + 1] = RankOne { slope: &own[SLOPE], factor: &own[V] };
            }
            let block = block_mut(columns, b);
            change_columns::<T, V, _, GROUP, R>((block, b), self.sums, &changes);
            settle(block, (diagonal, b), V::BlockVector::read(&self.of_all[b][D]));
        }
    }

    /// P·f of sample l, with the P between forgetting and measurement, for the rows of tile t.
    #[inline(always)]
    pub fn gain(&self, l: usize, t: usize) -> &T::Chunk {
        &self.sums[t][2 * l + 1]
    }
}

/// The numbers of z of sample l that belong to block b.
#[inline(always)]
fn z_of<T: Real, const B: usize>(z: &[[T::Chunk; B]], l: usize, b: usize) -> &PerColumn<T> {
    let first = b * BLOCK;
    match z[first / T::ROWS][l].as_ref()[first % T::ROWS..].first_chunk() {
        Some(eight) => eight,
        None => unreachable!("a chunk holds whole blocks"),
    }
}

/// The same, to be written.
#[inline(always)]
fn z_of_mut<T: Real, const B: usize>(
    z: &mut [[T::Chunk; B]],
    l: usize,
    b: usize,
) -> &mut PerColumn<T> {
    let first = b * BLOCK;
    match z[first / T::ROWS][l].as_mut()[first % T::ROWS..].first_chunk_mut() {
        Some(eight) => eight,
        None => unreachable!("a chunk holds whole blocks"),
    }
}
