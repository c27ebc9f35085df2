//! Products of a vector with the columns of a block.

use super::{Long, PerColumn, Tile, BLOCK};
use crate::vector::Vector;
use crate::Real;

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
