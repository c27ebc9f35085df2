//! Products of a vector with the columns of a block.

use super::{Long, Tile};
use crate::number::vector::Vector;
use crate::number::Real;

/// u · f for each column of a block, the unit diagonal included.
#[inline(always)]
pub fn dots<T: Real, V: Vector<T>, const GROUP: usize>(
    block: &[Tile<T>],
    f: &Long<'_, T>,
) -> V::Eight {
    if GROUP >= 8 {
        return V::eight_sums(of_columns::<T, V, 8, 0>(block, f));
    }
    let first = V::four_sums(of_columns::<T, V, 4, 0>(block, f));
    V::join(first, V::four_sums(of_columns::<T, V, 4, 4>(block, f)))
}

/// The same for vector `s` of `S` that lie side by side.
#[inline(always)]
pub fn dots_beside<T: Real, V: Vector<T>, const GROUP: usize, const S: usize>(
    block: &[Tile<T>],
    f: &[[T::Chunk; S]],
    s: usize,
) -> V::Eight {
    if GROUP >= 8 {
        return V::eight_sums(beside::<T, V, 8, 0, S>(block, f, s));
    }
    let first = V::four_sums(beside::<T, V, 4, 0, S>(block, f, s));
    V::join(first, V::four_sums(beside::<T, V, 4, 4, S>(block, f, s)))
}

#[inline(always)]
fn beside<T: Real, V: Vector<T>, const C: usize, const FIRST: usize, const S: usize>(
    block: &[Tile<T>],
    f: &[[T::Chunk; S]],
    s: usize,
) -> [V; C] {
    let mut sums = [V::splat(T::ZERO); C];
    for (tile, f) in block.iter().zip(f) {
        add_tile::<T, V, C, FIRST>(tile, &f[s], &mut sums);
    }
    sums
}

#[inline(always)]
fn of_columns<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    block: &[Tile<T>],
    f: &Long<'_, T>,
) -> [V; C] {
    let mut sums = [V::splat(T::ZERO); C];
    let (full, tail) = f.first(block.len());
    for (tile, f) in block.iter().zip(full) {
        add_tile::<T, V, C, FIRST>(tile, f, &mut sums);
    }
    if let (Some(tile), Some(f)) = (block.last(), tail) {
        add_tile::<T, V, C, FIRST>(tile, f, &mut sums);
    }
    sums
}

#[inline(always)]
fn add_tile<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    tile: &Tile<T>,
    f: &T::Chunk,
    sums: &mut [V; C],
) {
    let f = V::load(f);
    for c in 0..C {
        sums[c] = V::load(&tile[FIRST + c]).mul_add(f, sums[c]);
    }
}
