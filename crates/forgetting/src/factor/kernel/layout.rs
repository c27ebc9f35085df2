//! Where the numbers of U are kept.
//!
//! The columns follow each other in blocks of [`BLOCK`]. In block b each column holds 8 (b + 1)
//! rows: those above the diagonal, the 1 on it, and zeros below. A block is so a plain matrix,
//! and a loop over it needs to know nothing of triangles; the ones and zeros stay what they are
//! through every operation. It costs about 4.5 n numbers beside the n (n + 1)/2.
//!
//! ```text
//! block       0          1
//! column   0 ... 7    8 ... 15
//!          ┌───────┬──────────┐
//! rows 0–7 │ 1 u u │ u  u  u  │
//!          └───────┤ 1  u  u  │ 8–15
//!                  └──────────┘
//! ```

use crate::state::Visitor;
use crate::vector::HALF;
use crate::Real;

/// The most columns of a block.
pub const BLOCK: usize = HALF;

/// How many numbers U of n columns takes.
pub const fn length(n: usize) -> usize {
    start(n)
}

/// Where column j starts.
pub const fn start(j: usize) -> usize {
    let (block, c) = (j / BLOCK, j % BLOCK);
    BLOCK * (block + 1) * (BLOCK / 2 * block + c)
}

/// Column j of U above the diagonal, j numbers.
#[inline(always)]
pub fn column<T>(columns: &[T], j: usize) -> &[T] {
    let start = start(j);
    &columns[start..start + j]
}

/// Column j of U above the diagonal, to be written.
#[inline(always)]
pub fn column_mut<T>(columns: &mut [T], j: usize) -> &mut [T] {
    let start = start(j);
    &mut columns[start..start + j]
}

/// U ← I, of n columns.
pub fn set_identity<T: Real>(columns: &mut [T], n: usize) {
    columns.fill(T::ZERO);
    for j in 0..n {
        columns[start(j) + j] = T::ONE;
    }
}

/// Shows the numbers above the diagonal, column by column.
pub fn visit<T: Real>(columns: &mut [T], n: usize, visitor: &mut dyn Visitor<T>) {
    for j in 0..n {
        visitor.reals(column_mut(columns, j));
    }
}

#[cfg(test)]
mod tests {
    use super::{length, start};

    #[test]
    fn columns_follow_each_other() {
        for j in 0..100 {
            let rows = 8 * (j / 8 + 1);
            assert_eq!(start(j + 1), start(j) + rows);
            assert!(rows > j);
        }
        assert_eq!(length(0), 0);
        assert!((1..600).all(|n| length(n) <= n * (n + 1) / 2 + 8 * n));
    }
}
