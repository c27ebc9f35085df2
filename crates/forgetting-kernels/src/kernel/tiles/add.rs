//! Sums of the columns of a block.

use super::{splat, LongMut, PerColumn, Tile};
use crate::number::vector::Vector;
use crate::number::Real;

/// `x` += c u for each column of a block and its factor c, the unit diagonal included.
#[inline(always)]
pub fn add_columns<T: Real, V: Vector<T>>(
    block: &[Tile<T>],
    x: &mut LongMut<'_, T>,
    factors: &PerColumn<T>,
) {
    let factors = splat::<T, V, 8, 0>(factors);
    let (full, tail) = x.first(block.len());
    for t in 0..block.len().min(full.len()) {
        add_tile(&block[t], &mut full[t], &factors);
    }
    if let (Some(tile), Some(x)) = (block.last(), tail) {
        add_tile(tile, x, &factors);
    }
}

#[inline(always)]
fn add_tile<T: Real, V: Vector<T>>(tile: &Tile<T>, x: &mut T::Chunk, factors: &[V; 8]) {
    let mut sum = V::load(x);
    for c in (0..8).rev() {
        sum = factors[c].mul_add(V::load(&tile[c]), sum);
    }
    sum.store(x);
}
