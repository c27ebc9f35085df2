//! Agee and Turner's update of the columns of a block.

use super::{splat, LongMut, PerColumn, Tile};
use crate::number::vector::Vector;
use crate::number::Real;

/// For each column of a block, from the right: `x` += (−s) u, then u += slope `x`.
#[inline(always)]
pub fn eliminate<T: Real, V: Vector<T>, const GROUP: usize>(
    block: &mut [Tile<T>],
    x: &mut LongMut<'_, T>,
    (slope, less_s): (&PerColumn<T>, &PerColumn<T>),
) {
    if GROUP >= 8 {
        columns::<T, V, 8, 0>(block, x, slope, less_s);
    } else {
        columns::<T, V, 4, 4>(block, x, slope, less_s);
        columns::<T, V, 4, 0>(block, x, slope, less_s);
    }
}

#[inline(always)]
fn columns<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    block: &mut [Tile<T>],
    x: &mut LongMut<'_, T>,
    slope: &PerColumn<T>,
    less_s: &PerColumn<T>,
) {
    let factors = (splat::<T, V, C, FIRST>(slope), splat::<T, V, C, FIRST>(less_s));
    let (full, tail) = x.first(block.len());
    for t in 0..block.len().min(full.len()) {
        eliminate_tile::<T, V, C, FIRST>(&mut block[t], &mut full[t], &factors);
    }
    if let (Some(tile), Some(x)) = (block.last_mut(), tail) {
        eliminate_tile::<T, V, C, FIRST>(tile, x, &factors);
    }
}

#[inline(always)]
fn eliminate_tile<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    tile: &mut Tile<T>,
    x: &mut T::Chunk,
    (slope, less_s): &([V; C], [V; C]),
) {
    let mut rest = V::load(x);
    for c in (0..C).rev() {
        let before = V::load(&tile[FIRST + c]);
        rest = less_s[c].mul_add(before, rest);
        slope[c].mul_add(rest, before).store(&mut tile[FIRST + c]);
    }
    rest.store(x);
}
