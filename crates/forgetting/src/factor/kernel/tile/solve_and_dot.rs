//! The first sweep of forgetting along a regressor: see [`super::super::along`].

use super::{splat, Long, LongMut, PerColumn, Tile, BLOCK};
use crate::vector::Vector;
use crate::Real;

/// `x` += c u for each column of a block and its factor c, and u · f, the unit diagonal included
/// in both.
#[inline(always)]
pub fn solve_and_dot<T: Real, V: Vector<T>, const GROUP: usize>(
    block: &[Tile<T>],
    (x, factors): (&mut LongMut<'_, T>, &PerColumn<T>),
    f: &Long<'_, T>,
) -> PerColumn<T> {
    let mut sums = [T::ZERO; BLOCK];
    if GROUP >= 8 {
        sums = V::sums(columns::<T, V, 8, 0>(block, (x, factors), f));
    } else {
        let (low, high) = sums.split_at_mut(4);
        high.copy_from_slice(&V::sums(columns::<T, V, 4, 4>(block, (x, factors), f)));
        low.copy_from_slice(&V::sums(columns::<T, V, 4, 0>(block, (x, factors), f)));
    }
    sums
}

#[inline(always)]
fn columns<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    block: &[Tile<T>],
    (x, factors): (&mut LongMut<'_, T>, &PerColumn<T>),
    f: &Long<'_, T>,
) -> [V; C] {
    let factors = splat::<T, V, C, FIRST>(factors);
    let mut sums = [V::splat(T::ZERO); C];
    let (full, tail) = x.first(block.len());
    let (full_f, tail_f) = f.first(block.len());
    for ((tile, x), f) in block.iter().zip(full).zip(full_f) {
        on_tile::<T, V, C, FIRST>(tile, (x, f), &factors, &mut sums);
    }
    if let (Some(tile), Some(x), Some(f)) = (block.last(), tail, tail_f) {
        on_tile::<T, V, C, FIRST>(tile, (x, f), &factors, &mut sums);
    }
    sums
}

#[inline(always)]
fn on_tile<T: Real, V: Vector<T>, const C: usize, const FIRST: usize>(
    tile: &Tile<T>,
    (x, f): (&mut T::Chunk, &T::Chunk),
    factors: &[V; C],
    sums: &mut [V; C],
) {
    let (mut rest, f) = (V::load(x), V::load(f));
    for c in (0..C).rev() {
        let u = V::load(&tile[FIRST + c]);
        rest = factors[c].mul_add(u, rest);
        sums[c] = u.mul_add(f, sums[c]);
    }
    rest.store(x);
}
