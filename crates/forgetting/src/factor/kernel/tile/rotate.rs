//! Bierman's update of the columns of a block.

use super::{splat, LongMut, PerColumn, Tile};
use crate::vector::Vector;
use crate::Real;

/// For each column of a block, from the left: `k` += v u and u += slope `k`, each with the other
/// of before.
#[inline(always)]
pub fn rotate<T: Real, V: Vector<T>, const GROUP: usize>(
    block: &mut [Tile<T>],
    k: &mut LongMut<'_, T>,
    (slope, v): (&PerColumn<T>, &PerColumn<T>),
) {
    if GROUP >= 8 {
        columns::<T, V, 8, 0>(block, k, slope, v);
    } else {
        columns::<T, V, 4, 0>(block, k, slope, v);
        columns::<T, V, 4, 4>(block, k, slope, v);
    }
}

#[inline(always)]
fn columns<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    block: &mut [Tile<T>],
    k: &mut LongMut<'_, T>,
    slope: &PerColumn<T>,
    v: &PerColumn<T>,
) {
    let factors = (splat::<T, V, C, FIRST>(slope), splat::<T, V, C, FIRST>(v));
    let (full, tail) = k.first(block.len());
    for (tile, k) in block.iter_mut().zip(full) {
        rotate_tile::<T, V, C, FIRST>(tile, k, &factors);
    }
    if let (Some(tile), Some(k)) = (block.last_mut(), tail) {
        rotate_tile::<T, V, C, FIRST>(tile, k, &factors);
    }
}

#[inline(always)]
fn rotate_tile<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    tile: &mut Tile<T>,
    k: &mut T::Chunk,
    (slope, v): &([V; C], [V; C]),
) {
    let mut gain = V::load(k);
    for c in 0..C {
        let before = V::load(&tile[FIRST + c]);
        slope[c].mul_add(gain, before).store(&mut tile[FIRST + c]);
        gain = v[c].mul_add(before, gain);
    }
    gain.store(k);
}
