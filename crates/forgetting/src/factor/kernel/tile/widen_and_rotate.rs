//! The second sweep of forgetting along a regressor: see [`super::super::along`].

use super::{splat, LongMut, PerColumn, Tile};
use crate::vector::Vector;
use crate::Real;

/// What the sweep adds to each column of a block: `widening` times x, then `slope` times k.
pub struct Slopes<T> {
    pub widening: PerColumn<T>,
    pub z: PerColumn<T>,
    pub slope: PerColumn<T>,
    pub v: PerColumn<T>,
}

/// For each column of a block, from the left: u' = u + widening `x` and `x` += z u, then
/// u ← u' + slope `k` and `k` += v u'.
#[inline(always)]
pub fn widen_and_rotate<T: Real, V: Vector<T>>(
    block: &mut [Tile<T>],
    x: &mut LongMut<'_, T>,
    k: &mut LongMut<'_, T>,
    slopes: &Slopes<T>,
) {
    columns::<T, V, 4, 0>(block, x, k, slopes);
    columns::<T, V, 4, 4>(block, x, k, slopes);
}

#[inline(always)]
fn columns<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    block: &mut [Tile<T>],
    x: &mut LongMut<'_, T>,
    k: &mut LongMut<'_, T>,
    slopes: &Slopes<T>,
) {
    let factors = [
        splat::<T, V, C, FIRST>(&slopes.widening),
        splat::<T, V, C, FIRST>(&slopes.z),
        splat::<T, V, C, FIRST>(&slopes.slope),
        splat::<T, V, C, FIRST>(&slopes.v),
    ];
    let (full_x, tail_x) = x.first(block.len());
    let (full_k, tail_k) = k.first(block.len());
    for ((tile, x), k) in block.iter_mut().zip(full_x).zip(full_k) {
        on_tile::<T, V, C, FIRST>(tile, (x, k), &factors);
    }
    if let (Some(tile), Some(x), Some(k)) = (block.last_mut(), tail_x, tail_k) {
        on_tile::<T, V, C, FIRST>(tile, (x, k), &factors);
    }
}

#[inline(always)]
fn on_tile<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    tile: &mut Tile<T>,
    (x, k): (&mut T::Chunk, &mut T::Chunk),
    [widening, z, slope, v]: &[[V; C]; 4],
) {
    let (mut rest, mut gain) = (V::load(x), V::load(k));
    for c in 0..C {
        let before = V::load(&tile[FIRST + c]);
        let widened = widening[c].mul_add(rest, before);
        rest = z[c].mul_add(before, rest);
        slope[c].mul_add(gain, widened).store(&mut tile[FIRST + c]);
        gain = v[c].mul_add(widened, gain);
    }
    rest.store(x);
    gain.store(k);
}
