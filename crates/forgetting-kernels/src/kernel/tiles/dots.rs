//! Products of a vector with the columns of a block.

use super::{Long, Tile};
use crate::number::lane::Lane;
use crate::number::vector::Vector;
use crate::number::Real;

/// u · f for each column of a block, the unit diagonal included.
#[inline(always)]
pub fn dots<T: Real, V: Vector<T>, const GROUP: usize>(
    block: &[Tile<T>],
    f: &Long<'_, T>,
) -> V::BlockVector {
    if GROUP >= 8 {
        return V::eight_sums(of_columns::<T, V, 8, 0>(block, f));
    }
    let first = V::four_sums(of_columns::<T, V, 4, 0>(block, f));
    V::join(first, V::four_sums(of_columns::<T, V, 4, 4>(block, f)))
}

/// The same for each of `S` vectors that lie side by side.
#[inline(always)]
pub fn dots_beside<T: Real, V: Vector<T>, const GROUP: usize, const S: usize>(
    block: &[Tile<T>],
    f: &[[T::Chunk; S]],
) -> [V::BlockVector; S] {
    let mut dots = [V::BlockVector::splat(T::ZERO); S];
    for s in 0..S {
        if GROUP < 8 {
            let [first] = beside::<T, V, 4, 0, S, 1>(block, f, s);
            let [second] = beside::<T, V, 4, 4, S, 1>(block, f, s);
            dots[s] = V::join(V::four_sums(first), V::four_sums(second));
        } else if s + 1 == S && S % 2 == 1 {
            let [sums] = beside::<T, V, 8, 0, S, 1>(block, f, s);
            dots[s] = V::eight_sums(sums);
        } else if s % 2 == 0 {
            // a column in a register serves both
            let [sums, next] = beside::<T, V, 8, 0, S, 2>(block, f, s);
            (dots[s], dots[s + 1]) = (V::eight_sums(sums), V::eight_sums(next));
        }
    }
    dots
}

/// The terms of the sums for `W` of the vectors from `s` on.
#[inline(always)]
fn beside<T, V, const C: usize, const FIRST: usize, const S: usize, const W: usize>(
    block: &[Tile<T>],
    f: &[[T::Chunk; S]],
    s: usize,
) -> [[V; C]; W]
where
    T: Real,
    V: Vector<T>,
{
    let mut sums = [[V::splat(T::ZERO); C]; W];
    for t in 0..block.len().min(f.len()) {
        let mut own = [V::splat(T::ZERO); W];
        for w in 0..W {
            own[w] = V::load(&f[t][s + w]);
        }
        for c in 0..C {
            let u = V::load(&block[t][FIRST + c]);
            for w in 0..W {
                sums[w][c] = u.mul_add(own[w], sums[w][c]);
            }
        }
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
    for t in 0..block.len().min(full.len()) {
        add_tile::<T, V, C, FIRST>(&block[t], &full[t], &mut sums);
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
