//! New eigenvectors as combinations of old ones: the one step that costs O(n³).

use crate::kernel::copies::{first_of, put_first};
use crate::number::vector::Vector;
use crate::number::Real;

/// Rows of a panel, which then stays in the fastest memory.
const DEPTH: usize = 64;

/// The old eigenvectors that are combined: the rows of n numbers with a component other than 0.
#[derive(Clone, Copy)]
pub struct Rows<'a, T> {
    /// rows of n numbers
    pub vectors: &'a [T],
    /// numbers of a row
    pub n: usize,
    /// one for each row
    pub components: &'a [T],
}

/// Row j of `product` ← Σ_i turn_ji·(row i).
///
/// In tiles of `GROUP` rows and one chunk of columns that stay in registers, over panels of the
/// vectors that are copied to be neighbours. The terms of a sum are added in their order.
#[inline(always)]
pub fn combine<T: Real, V: Vector<T>, const GROUP: usize>(
    turn: &[T],
    active: usize,
    rows: Rows<'_, T>,
    product: &mut [T],
) {
    // filled before it is read; not with zeros: to clear so much is a call
    let mut panel = [T::chunk(&rows.vectors[..rows.n.min(T::ROWS)]); DEPTH];
    for column in (0..rows.n).step_by(T::ROWS) {
        let place = Place { column, width: T::ROWS.min(rows.n - column), n: rows.n };
        let (mut first, mut filled) = (0, 0);
        for (i, row) in rows.vectors.chunks_exact(rows.n).enumerate() {
            if rows.components[i] == T::ZERO {
                continue;
            }
            first_of::<T, V>(&row[column..column + place.width]).store(&mut panel[filled]);
            filled += 1;
            if first + filled == active || filled == DEPTH {
                let panel = &panel[..filled];
                add::<T, V, GROUP>(turn, active, (panel, first), place, product);
                (first, filled) = (first + filled, 0);
            }
        }
    }
}

/// The columns of the product that a panel is for.
#[derive(Clone, Copy)]
struct Place {
    column: usize,
    width: usize,
    n: usize,
}

/// Adds what a panel, of the old vectors from `first` on, contributes to all new ones; the first
/// panel replaces.
#[inline(always)]
fn add<T: Real, V: Vector<T>, const GROUP: usize>(
    turn: &[T],
    active: usize,
    (panel, first): (&[T::Chunk], usize),
    place: Place,
    product: &mut [T],
) {
    let Place { column, width, n } = place;
    let mut j = 0;
    while j < active {
        let rows = if active - j >= GROUP { GROUP } else { 1 };
        let mut sums = [V::splat(T::ZERO); GROUP];
        if rows == GROUP {
            let mut weights = [&turn[..0]; GROUP];
            for r in 0..GROUP {
                weights[r] = &turn[(j + r) * active + first..][..panel.len()];
            }
            tile::<T, V, GROUP>(weights, panel, &mut sums);
        } else {
            let mut one = [sums[0]];
            tile::<T, V, 1>([&turn[j * active + first..][..panel.len()]], panel, &mut one);
            sums[0] = one[0];
        }
        for (r, &sum) in sums.iter().take(rows).enumerate() {
            let target = &mut product[(j + r) * n + column..][..width];
            let before: V = first_of(target);
            put_first(target, if first == 0 { sum } else { before + sum });
        }
        j += rows;
    }
}

/// `R` combinations of the rows of a panel.
#[inline(always)]
fn tile<T: Real, V: Vector<T>, const R: usize>(
    weights: [&[T]; R],
    panel: &[T::Chunk],
    sums: &mut [V; R],
) {
    let mut partial = *sums;
    for (i, chunk) in panel.iter().enumerate() {
        let x = V::load(chunk);
        for r in 0..R {
            partial[r] = V::splat(weights[r][i]).mul_add(x, partial[r]);
        }
    }
    *sums = partial;
}
