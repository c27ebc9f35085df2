//! Products of a vector with the columns of a block.

use super::{Long, PerColumn, Tile, BLOCK};
use crate::number::vector::Vector;
use crate::number::Real;

/// u · f for each column of a block, the unit diagonal included.
#[inline(always)]
pub fn dots<T: Real, V: Vector<T>, const GROUP: usize>(
    block: &[Tile<T>],
    f: &Long<'_, T>,
) -> PerColumn<T> {
    let mut sums = [T::ZERO; BLOCK];
    if GROUP >= 8 {
        sums = V::sums(of_columns::<T, V, 8, 0>(block, f));
    } else {
        let (low, high) = sums.split_at_mut(4);
        low.copy_from_slice(&V::sums(of_columns::<T, V, 4, 0>(block, f)));
        high.copy_from_slice(&V::sums(of_columns::<T, V, 4, 4>(block, f)));
    }
    sums
}

/// The same for each of `S` vectors that lie side by side.
#[inline(always)]
pub fn dots_beside<T: Real, V: Vector<T>, const GROUP: usize, const S: usize>(
    block: &[Tile<T>],
    f: &[[T::Chunk; S]],
) -> [PerColumn<T>; S] {
    let mut dots = [[T::ZERO; BLOCK]; S];
    for s in 0..S {
        if GROUP >= 8 {
            dots[s] = V::sums(beside::<T, V, 8, 0, S>(block, f, s));
        } else {
            let [a, b, c, d] = V::sums(beside::<T, V, 4, 0, S>(block, f, s));
            let [e, f, g, h] = V::sums(beside::<T, V, 4, 4, S>(block, f, s));
            dots[s] = [a, b, c, d, e, f, g, h];
        }
    }
    dots
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
