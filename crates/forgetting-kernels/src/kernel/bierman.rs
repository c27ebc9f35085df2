//! Bierman's update with unit variance: P⁻¹ ← P⁻¹ + fᵀf, for more than ten parameters.
//!
//! ```text
//! for each column j of U:   w = f_j + u·f,  v = D_j w,  a' = a + w v
//!                           D_j ← D_j a / a',  u ← u − (w / a) k,  k ← k + v u (the u of before)
//! then                      P₊fᵀ = k / a'
//! ```
//!
//! The columns are taken in blocks of eight, so that the divisions of a block do not wait for each other
//! and the gain k passes once through the registers for several columns. O(1.5 n²).
//!
//! G. J. Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V.

use super::layout::BLOCK;
use super::tiles::{
    block, block_mut, change_columns, dots, load_per_column, padding_d, store_per_column, Long,
    LongMut, PerColumn, RankOne, Tile,
};
use crate::kernel::measured::Measured;
use crate::number::block_vector::BlockVector;
use crate::number::lane::Lane;
use crate::number::vector::Vector;
use crate::number::Real;

/// What a block becomes: D, which may be below its floor, and the change of U, of which x is the gain
/// k, v its factor.
pub struct Pass<E> {
    pub d: E,
    pub slope: E,
    pub v: E,
    /// 1/a after each column
    pub inverse: E,
}

/// What passes from column to column, in all lanes.
#[derive(Clone, Copy)]
pub struct Chain<E> {
    /// a − 1
    s: E,
    /// 1/a
    inverse: E,
}

impl<E> Chain<E> {
    #[inline(always)]
    pub fn start<T: Real>() -> Self
    where
        E: BlockVector<T>,
    {
        Self { s: E::splat(T::ZERO), inverse: E::splat(T::ONE) }
    }

    /// Goes through the columns of a block.
    ///
    /// Only s and 1/a pass from block to block; all else is done for all columns side by side, with
    /// one division.
    #[inline(always)]
    pub fn pass<T: Real>(&mut self, d: E, w: E) -> Pass<E>
    where
        E: BlockVector<T>,
    {
        let (v, one, first) = (d * w, E::splat(T::ONE), E::splat(T::ONE) + self.s);
        let sums = (w * v).running_sums();
        let a = first + sums;
        let inverse = one / a;
        let slope = -w * inverse.before(self.inverse);
        // the ratio first: D may be as large as a number gets, and a as the square of one
        let d = d * (a.before(first) * inverse);
        (self.s, self.inverse) = ((self.s + sums).last(), inverse.last());
        Pass { d, slope, v, inverse }
    }

    /// At the end, with the largest element of D.
    #[inline(always)]
    pub fn measured<T: Real>(self, largest: T, forgot: bool) -> Measured<T>
    where
        E: BlockVector<T>,
    {
        let (leverage, one) = (self.s.numbers()[0], T::ONE);
        let variance = one + leverage;
        Measured { leverage, variance, inverse_variance: one / variance, largest, forgot }
    }
}

/// The largest of positive numbers, eight side by side.
#[inline(always)]
pub fn largest<T: Real>(numbers: &[T]) -> T {
    let (eights, rest) = numbers.as_chunks::<BLOCK>();
    let mut most = [T::ZERO; BLOCK];
    for eight in eights {
        for lane in 0..BLOCK {
            most[lane] = most[lane].max(eight[lane]);
        }
    }
    rest.iter().fold(largest_of(&most), |most, &x| most.max(x))
}

/// The largest of eight numbers: halves beside halves.
#[inline(always)]
pub fn largest_of<T: Real>(eight: &PerColumn<T>) -> T {
    let [a, b, c, d, e, f, g, h] = *eight;
    (a.max(e).max(c.max(g))).max(b.max(f).max(d.max(h)))
}

/// Whether no D is below its floor, given the largest of −D.
#[inline(always)]
pub fn above_floor<T: Real, E: BlockVector<T>>(less_least: E) -> bool {
    E::all(less_least.at_most(-E::splat(T::FLOOR)))
}

/// D of block `b` as it was measured, put at the floor where it is below it.
///
/// A column of U may be as long as D is small: lifting D alone would add to P whatever the floor is
/// times the square of that length. So the column becomes √(D/floor) of what it is.
#[inline(always)]
pub fn settle<T: Real, E: BlockVector<T>>(
    block: &mut [Tile<T>],
    (diagonal, b): (&mut [T], usize),
    mut d: E,
) {
    if !E::all(E::splat(T::FLOOR).at_most(d)) {
        d = E::read(&lift(block, b, &d.numbers()));
    }
    store_per_column(diagonal, b, d);
}

#[cold]
#[inline(never)]
fn lift<T: Real>(block: &mut [Tile<T>], b: usize, d: &PerColumn<T>) -> PerColumn<T> {
    for (t, tile) in block.iter_mut().enumerate() {
        for (c, column) in tile.iter_mut().enumerate().filter(|&(c, _)| d[c] < T::FLOOR) {
            let share = (d[c] / T::FLOOR).sqrt();
            // of the tile with the diagonal, what is above it
            let above = b * BLOCK + c - t * T::ROWS;
            column.as_mut().iter_mut().take(above).for_each(|u| *u *= share);
        }
    }
    d.map(|d| d.max(T::FLOOR))
}

/// P ← `growth`·P and P⁻¹ ← P⁻¹ + fᵀf; leaves P·fᵀ, with the P between the two, in `k`.
#[inline(always)]
pub fn scale_and_measure<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    diagonal: &mut [T],
    growth: T,
    f: &[T],
    k: &mut [T],
) -> Chain<V::BlockVector> {
    let (f, mut k, blocks) = (Long::new(f), LongMut::new(k), diagonal.len().div_ceil(BLOCK));
    let (mut chain, growth) = (Chain::start(), V::BlockVector::splat(growth));
    let mut ahead = dots::<T, V, GROUP>(block(columns, 0), &f);
    for b in 0..blocks {
        let w = ahead;
        if b + 1 < blocks {
            // needs nothing of this block: the machine does both at once
            ahead = dots::<T, V, GROUP>(block(columns, b + 1), &f);
        }
        let d = load_per_column::<T, V::BlockVector>(diagonal, b, padding_d()) * growth;
        let Pass { d, slope, v, .. } = chain.pass(d, w);
        let change = RankOne { slope: &slope.numbers(), factor: &v.numbers() };
        let block = block_mut(columns, b);
        change_columns::<T, V, _, GROUP, 1>((block, b), &mut k, &[change]);
        settle(block, (diagonal, b), d);
    }
    k.finish();
    chain
}
