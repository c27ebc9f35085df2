//! Where the numbers of U are kept.
//!
//! In tiles of eight columns and as many rows as a vector has numbers ([`Real::ROWS`], 8 or 16). A
//! tile holds its columns one after the other, a block of eight columns its tiles from the top
//! down to the one with the diagonal, and the blocks follow each other: a sweep over a block reads
//! neighbouring numbers only, and needs to know nothing of triangles. Below the 1 on the diagonal
//! there are zeros, and right of column n columns of zeros; they stay what they are through
//! every operation. With at most eight parameters the missing columns are left out.
//!
//! ```text
//! block       0          1
//! column   0 ... 7    8 ... 15
//!          ┌───────┬──────────┐
//! rows 0–7 │ 1 u u │ u  u  u  │
//!          └───────┤ 1  u  u  │ 8–15
//!                  └──────────┘
//! ```
//!
//! It costs about 12 n numbers beside the n (n + 1)/2.

use crate::number::Real;

/// The columns of a tile.
pub const BLOCK: usize = 8;
/// So many parameters and less are measured in registers, without tiles.
pub const FEW: usize = 10;
/// Whether programs are to be small, as those that a browser fetches: samples are then taken one at a time,
/// estimators one by one, and of the kernels that give the same bits only the one of few instructions is
/// compiled.
pub const COMPACT: bool = cfg!(target_arch = "wasm32");
/// So many parameters and less have kernels with constant bounds, where others would give the same bits.
pub const UNROLLED: usize = if COMPACT { 0 } else { FEW };

/// How many blocks come before column 8 `block`, counted in tiles of `rows` rows.
#[inline(always)]
const fn tiles_before(block: usize, rows: usize) -> usize {
    if rows == BLOCK {
        block * (block + 1) / 2
    } else {
        block.div_ceil(2) * (block + 2).div_euclid(2)
    }
}

#[inline(always)]
const fn length_of(n: usize, rows: usize) -> usize {
    if n <= BLOCK {
        n * rows
    } else {
        tiles_before(n.div_ceil(BLOCK), rows) * BLOCK * rows
    }
}

/// How many numbers U of n columns takes.
#[inline(always)]
pub const fn length<T: Real>(n: usize) -> usize {
    length_of(n, T::ROWS)
}

/// Room for U of n columns, or for several of n columns in all.
#[inline(always)]
pub const fn capacity<T: Real>(n: usize) -> usize {
    length_of(n, T::ROWS) + if n <= BLOCK { 0 } else { BLOCK * T::ROWS }
}

/// The same for any number type.
#[inline(always)]
pub const fn most(n: usize) -> usize {
    length_of(n, 2 * BLOCK) + if n <= BLOCK { 0 } else { 2 * BLOCK * BLOCK }
}

/// The tiles of a block, by their position.
#[inline(always)]
pub fn tiles_of<T: Real>(block: usize) -> core::ops::Range<usize> {
    tiles_before(block, T::ROWS)..tiles_before(block + 1, T::ROWS)
}

/// Where the element of row i and column j is, i ≤ j.
#[inline(always)]
pub fn place<T: Real>(i: usize, j: usize) -> usize {
    let (rows, tile) = (T::ROWS, tiles_before(j / BLOCK, T::ROWS) + i / T::ROWS);
    (tile * BLOCK + j % BLOCK) * rows + i % rows
}

/// Column j of U above the diagonal, in pieces of [`Real::ROWS`] numbers, the last one shorter.
fn column<T: Real>(columns: &[T], j: usize) -> impl Iterator<Item = &[T]> {
    (0..j).step_by(T::ROWS).map(move |i| {
        let start = place::<T>(i, j);
        &columns[start..start + T::ROWS.min(j - i)]
    })
}

/// Copies column j of U above the diagonal to `copy`, j numbers.
pub fn get_column<T: Real>(columns: &[T], j: usize, copy: &mut [T]) {
    for (piece, copy) in column(columns, j).zip(copy[..j].chunks_mut(T::ROWS)) {
        copy.copy_from_slice(piece);
    }
}

/// Column j of U above the diagonal becomes `numbers`, j of them.
pub fn put_column<T: Real>(columns: &mut [T], j: usize, numbers: &[T]) {
    for (k, numbers) in numbers[..j].chunks(T::ROWS).enumerate() {
        let start = place::<T>(k * T::ROWS, j);
        columns[start..start + numbers.len()].copy_from_slice(numbers);
    }
}

/// U ← I, of n columns.
pub fn set_identity<T: Real>(columns: &mut [T], n: usize) {
    columns.fill(T::ZERO);
    for j in 0..n {
        columns[place::<T>(j, j)] = T::ONE;
    }
}

/// Whether U has its ones on the diagonal and its zeros below.
pub fn is_unit_triangular<T: Real>(columns: &[T], n: usize) -> bool {
    (0..n).all(|j| {
        let from_diagonal = &columns[place::<T>(j, j)..][..T::ROWS - j % T::ROWS];
        from_diagonal[0] == T::ONE && from_diagonal[1..].iter().all(|&u| u == T::ZERO)
    })
}

#[cfg(test)]
mod tests {
    use super::{capacity, length, most, place, tiles_of};
    use crate::number::Real;
    use std::collections::HashSet;

    fn every_element_has_a_place<T: Real>() {
        for n in [1, 2, 7, 8, 9, 16, 17, 31, 64, 100] {
            let mut places = HashSet::new();
            for (i, j) in (0..n).flat_map(|j| (0..=j).map(move |i| (i, j))) {
                assert!(places.insert(place::<T>(i, j)) && place::<T>(i, j) < length::<T>(n));
            }
        }
        for block in 0..50 {
            let rows = tiles_of::<T>(block).len() * T::ROWS;
            assert!(rows >= 8 * (block + 1) && rows < 8 * (block + 1) + T::ROWS);
        }
    }

    #[test]
    fn every_element_has_a_place_of_its_own() {
        every_element_has_a_place::<f64>();
        every_element_has_a_place::<f32>();
    }

    fn parts_fit<T: Real>() {
        for (a, b, c) in
            (1..40).flat_map(|a| (1..40).flat_map(move |b| (0..9).map(move |c| (a, b, c))))
        {
            let parts = length::<T>(a) + length::<T>(b) + if c > 0 { length::<T>(c) } else { 0 };
            assert!(parts <= capacity::<T>(a + b + c), "{a} {b} {c}");
        }
        for n in 9..600 {
            assert!(length::<T>(n) <= n * (n + 1) / 2 + (3 * n / 2 + 8) * T::ROWS);
            assert!(capacity::<T>(n) <= most(n));
        }
    }

    #[test]
    fn parts_fit_where_the_whole_does() {
        parts_fit::<f64>();
        parts_fit::<f32>();
    }
}
