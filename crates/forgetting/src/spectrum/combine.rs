//! New eigenvectors as combinations of old ones: the one step that costs O(n³).

use crate::Real;

const TILE: usize = 4;
const DEPTH: usize = 64;

/// Row j of `product` ← Σ_i turn_ji·(row i of `vectors`), over the rows with a component ≠ 0.
///
/// In tiles of 4 x 4 numbers that stay in registers, over panels of the vectors that are copied
/// to be neighbours.
#[inline(always)]
pub fn combine<T: Real>(
    turn: &[T],
    active: usize,
    vectors: &[T],
    n: usize,
    components: &[T],
    product: &mut [T],
) {
    let mut panel = [[T::ZERO; TILE]; DEPTH];
    for column in (0..n).step_by(TILE) {
        let width = TILE.min(n - column);
        let mut done = 0;
        let mut filled = 0;
        for (i, &component) in components.iter().enumerate() {
            if component == T::ZERO {
                continue;
            }
            panel[filled][..width].copy_from_slice(&vectors[i * n + column..][..width]);
            filled += 1;
            if filled == DEPTH {
                let place = Place { column, width, n, first: done };
                add(turn, active, &panel[..filled], place, product);
                done += filled;
                filled = 0;
            }
        }
        if filled > 0 {
            let place = Place { column, width, n, first: done };
            add(turn, active, &panel[..filled], place, product);
        }
    }
}

/// Which columns of the product a panel is for, and which of the old vectors it starts with.
#[derive(Clone, Copy)]
struct Place {
    column: usize,
    width: usize,
    n: usize,
    first: usize,
}

/// Adds what a panel contributes to all new vectors; the first panel replaces.
#[inline(always)]
fn add<T: Real>(turn: &[T], active: usize, panel: &[[T; TILE]], place: Place, product: &mut [T]) {
    let Place { column, width, n, first } = place;
    let weights = |j: usize| &turn[j * active + first..][..panel.len()];
    let mut put = |j: usize, sums: &[T; TILE]| {
        let target = &mut product[j * n + column..][..width];
        for (x, &sum) in target.iter_mut().zip(sums) {
            *x = if first == 0 { sum } else { *x + sum };
        }
    };
    let mut j = 0;
    while j + TILE <= active {
        let sums = tile([weights(j), weights(j + 1), weights(j + 2), weights(j + 3)], panel);
        for (r, sums) in sums.iter().enumerate() {
            put(j + r, sums);
        }
        j += TILE;
    }
    while j < active {
        put(j, &strip(weights(j), panel));
        j += 1;
    }
}

/// Four combinations of the rows of a panel.
#[inline(always)]
fn tile<T: Real>(weights: [&[T]; TILE], panel: &[[T; TILE]]) -> [[T; TILE]; TILE] {
    let mut sums = [[T::ZERO; TILE]; TILE];
    let [a, b, c, d] = weights;
    for ((((row, &a), &b), &c), &d) in panel.iter().zip(a).zip(b).zip(c).zip(d) {
        for (sums, weight) in sums.iter_mut().zip([a, b, c, d]) {
            for (sum, &x) in sums.iter_mut().zip(row) {
                *sum = weight.mul_add(x, *sum);
            }
        }
    }
    sums
}

/// One combination of the rows of a panel.
#[inline(always)]
fn strip<T: Real>(weights: &[T], panel: &[[T; TILE]]) -> [T; TILE] {
    let mut sums = [T::ZERO; TILE];
    for (row, &weight) in panel.iter().zip(weights) {
        for (sum, &x) in sums.iter_mut().zip(row) {
            *sum = weight.mul_add(x, *sum);
        }
    }
    sums
}
