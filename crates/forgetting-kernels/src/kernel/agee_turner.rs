//! Agee and Turner's update: P ← P + c·x·xᵀ with c ≥ 0. O(n²).
//!
//! ```text
//! t = 1 / c;  for each column j of U, from the last:
//!     s = x_j,  D'_j = D_j + s² / t,  x ← x − s u,  u ← u + s / (t D'_j) x,  t ← t + s² / D_j
//! ```
//!
//! In t = 1/c the divisions of a block of columns do not wait for each other.
//!
//! Where D grows much, u is to become much shorter, and u + s / (t D'_j) x is the difference of two
//! large numbers: of it stays their rounding, which D' makes large in P. The same column as a
//! sum of which neither part is larger than P allows, with the x of before:
//!
//! ```text
//!     u ← (D_j / D'_j) u + s / (t D'_j) x
//! ```
//!
//! W. S. Agee and R. H. Turner, *Triangular decomposition of a positive definite matrix plus a
//! symmetric dyad with applications to Kalman filtering*, 1972; for t, P. E. Gill, G. H. Golub,
//! W. Murray and M. A. Saunders, *Methods for modifying matrix factorizations*, Mathematics of
//! Computation 28, 1974, method C1; for the sum, R. Fletcher and M. J. D. Powell, *On the
//! modification of LDLᵀ factorizations*, Mathematics of Computation 28, 1974.

use super::layout::{place, BLOCK, COMPACT};
use super::registers::Small;
use super::tiles::{
    block_mut, eliminate, load_per_column, store_per_column, triangle, LongMut, Tile,
};
use crate::kernel::dispatch::Kernel;
use crate::number::block_vector::BlockVector;
use crate::number::vector::Vector;
use crate::number::{copy_first, copy_some, Real};

/// The update; it uses up `x`.
pub struct AgeeTurner<'a, T> {
    /// U, in tiles
    pub columns: &'a mut [T],
    /// D
    pub diagonal: &'a mut [T],
    /// the vector
    pub x: &'a mut [T],
    /// the factor
    pub c: T,
}

impl<T: Real> Kernel<T> for AgeeTurner<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) {
        let n = self.diagonal.len();
        if GROUP < 8 && n <= BLOCK {
            if COMPACT {
                return some(&mut self);
            }
            return with_width!(n, few::<T>(&mut self));
        }
        let (mut x, mut t) = (LongMut::new(self.x), T::ONE / self.c);
        for b in (0..n.div_ceil(BLOCK)).rev() {
            let block = block_mut(self.columns, b);
            let mut d = load_per_column::<T, V::BlockVector>(self.diagonal, b, T::FLOOR).numbers();
            let scalars;
            (t, scalars) = pass(&triangle(block, b), &mut d, x.per_column(b), t);
            store_per_column(self.diagonal, b, V::BlockVector::read(&d));
            let Scalars { slope, less_s, kept } = &scalars;
            if loses_digits(kept) {
                add_up(block, b, &mut x, &scalars);
            } else {
                eliminate::<T, V, GROUP>(block, &mut x, (slope, less_s));
            }
        }
    }
}

/// Whether as a difference a column would lose more than half of its digits. Up to there it is the
/// better way: next to what is added to it, it is not rounded.
#[inline(always)]
fn loses_digits<T: Real, const C: usize>(kept: &[T; C]) -> bool {
    kept.iter().fold(false, |any, &kept| any | (kept < T::EPSILON.sqrt()))
}

/// What to do with each column.
struct Scalars<T, const C: usize> {
    /// s / (t D')
    slope: [T; C],
    /// −s
    less_s: [T; C],
    /// D / D'
    kept: [T; C],
}

/// t after a block, and what to do with its columns.
#[inline(always)]
fn pass<T: Real, const C: usize>(
    u: &[[T; C]; C],
    d: &mut [T; C],
    x: &[T; C],
    mut t: T,
) -> (T, Scalars<T, C>) {
    let [mut slope, mut less_s, mut kept, mut before] = [[T::ZERO; C]; 4];
    let mut rest = *x;
    for c in (0..C).rev() {
        less_s[c] = -rest[c];
        for i in 0..c {
            rest[i] = less_s[c].mul_add(u[c][i], rest[i]);
        }
    }
    for c in (0..C).rev() {
        before[c] = t;
        t = less_s[c].mul_add(less_s[c] / d[c], t);
    }
    for c in 0..C {
        let scaled = less_s[c] / before[c];
        let grown = scaled.mul_add(less_s[c], d[c]);
        slope[c] = -(scaled / grown);
        kept[c] = d[c] / grown;
        d[c] = grown;
    }
    (t, Scalars { slope, less_s, kept })
}

/// [`eliminate`] for block `b` with each column as a sum, number by number.
#[cold]
fn add_up<T: Real>(
    block: &mut [Tile<T>],
    b: usize,
    x: &mut LongMut<'_, T>,
    scalars: &Scalars<T, BLOCK>,
) {
    let Scalars { slope, less_s, kept } = scalars;
    let (full, tail) = x.first(block.len());
    for (k, (tile, x)) in block.iter_mut().zip(full.iter_mut().chain(tail)).enumerate() {
        for c in (0..BLOCK).rev() {
            // of the tile with the diagonal, what is above it
            let above = b * BLOCK + c - k * T::ROWS;
            for (u, x) in tile[c].as_mut().iter_mut().zip(x.as_mut()).take(above) {
                let (before, rest) = (*u, *x);
                *x = less_s[c].mul_add(before, rest);
                *u = slope[c].mul_add(rest, kept[c] * before);
            }
            // a block before may have this row in its tile, below its diagonal
            if let Some(x) = x.as_mut().get_mut(above) {
                *x = T::ZERO;
            }
        }
    }
}

/// For at most eight parameters.
#[inline(always)]
fn few<T: Real, const N: usize>(task: &mut AgeeTurner<'_, T>) {
    let AgeeTurner { columns, diagonal, x, c } = task;
    let (Some(d), Some(x)) = (diagonal.first_chunk_mut::<N>(), x.first_chunk_mut::<N>()) else {
        return;
    };
    let mut small = Small::<T, N>::load(columns, d);
    let (_, Scalars { slope, less_s, kept }) = pass(&small.u, &mut small.d, x, T::ONE / *c);
    let sum = loses_digits(&kept);
    for c in (0..N).rev() {
        for i in 0..c {
            let (before, rest) = (small.u[c][i], x[i]);
            x[i] = less_s[c].mul_add(before, rest);
            small.u[c][i] = match sum {
                true => slope[c].mul_add(rest, kept[c] * before),
                false => slope[c].mul_add(x[i], before),
            };
        }
    }
    small.store(columns, d);
}

/// The same for any number of them, where programs are to be small: past the last there is nothing to
/// be done.
fn some<T: Real>(task: &mut AgeeTurner<'_, T>) {
    let AgeeTurner { columns, diagonal, x, c } = task;
    let n = diagonal.len();
    let [mut d, mut rest] = [[T::ONE; BLOCK], [T::ZERO; BLOCK]];
    copy_some(&mut d, diagonal);
    copy_some(&mut rest, x);
    let mut u = [[T::ZERO; BLOCK]; BLOCK];
    for c in 0..n {
        for i in 0..c {
            u[c][i] = columns[place::<T>(i, c)];
        }
    }
    let (_, Scalars { slope, less_s, kept }) = pass(&u, &mut d, &rest, T::ONE / *c);
    let sum = loses_digits(&kept);
    for c in (0..n).rev() {
        for i in 0..c {
            let (before, rest) = (u[c][i], x[i]);
            x[i] = less_s[c].mul_add(before, rest);
            columns[place::<T>(i, c)] = match sum {
                true => slope[c].mul_add(rest, kept[c] * before),
                false => slope[c].mul_add(x[i], before),
            };
        }
    }
    copy_first(diagonal, &d);
}
