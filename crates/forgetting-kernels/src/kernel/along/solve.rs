//! U⁻¹f for several f side by side.

use super::super::triangle::solve_triangle;
use super::{block, z_of, z_of_mut, PerColumn, BLOCK};
use crate::number::vector::Vector;
use crate::number::Real;

/// Each of `xs` ← U⁻¹ times it, for so many blocks of U.
#[inline(always)]
pub fn solve<T: Real, V: Vector<T>, const B: usize>(
    columns: &[T],
    blocks: usize,
    xs: &mut [[T::Chunk; B]],
) {
    for b in (0..blocks).rev() {
        let tiles = block(columns, b);
        let Some((last, above)) = tiles.split_last() else { continue };
        let mut solved = [[T::ZERO; BLOCK]; B];
        for (l, solved) in solved.iter_mut().enumerate() {
            *solved = solve_triangle(tiles, b, z_of(xs, l, b));
        }
        if !(b * BLOCK).is_multiple_of(T::ROWS) {
            subtract::<T, V, B>(last, &mut xs[above.len()], &solved);
        }
        // from below: the next block waits for the rows just above
        for t in (0..above.len()).rev() {
            subtract::<T, V, B>(&above[t], &mut xs[t], &solved);
        }
        for (l, solved) in solved.into_iter().enumerate() {
            *z_of_mut(xs, l, b) = solved;
        }
    }
}

/// x −= c u for each column of a tile and its number c of `solved`.
#[inline(always)]
fn subtract<T: Real, V: Vector<T>, const B: usize>(
    tile: &[T::Chunk; BLOCK],
    xs: &mut [T::Chunk; B],
    solved: &[PerColumn<T>; B],
) {
    let mut x = [V::splat(T::ZERO); B];
    for l in 0..B {
        x[l] = V::load(&xs[l]);
    }
    for c in (0..BLOCK).rev() {
        let u = V::load(&tile[c]);
        for l in 0..B {
            x[l] = V::splat(-solved[l][c]).mul_add(u, x[l]);
        }
    }
    for l in 0..B {
        x[l].store(&mut xs[l]);
    }
}
