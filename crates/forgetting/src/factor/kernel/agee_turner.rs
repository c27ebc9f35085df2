//! Agee and Turner's update: P ← P + c·x·xᵀ with c ≥ 0. O(n²).
//!
//! ```text
//! t = 1 / c;  for each column j of U, from the last:
//!     s = x_j,  D'_j = D_j + s² / t,  x ← x − s u,  u ← u + s / (t D'_j) x,  t ← t + s² / D_j
//! ```
//!
//! In t = 1/c the divisions of a block of columns do not wait for each other.
//!
//! W. S. Agee and R. H. Turner, *Triangular decomposition of a positive definite matrix plus a
//! symmetric dyad with applications to Kalman filtering*, 1972; for t, P. E. Gill, G. H. Golub,
//! W. Murray and M. A. Saunders, *Methods for modifying matrix factorizations*, Mathematics of
//! Computation 28, 1974, method C1.

#![allow(clippy::needless_range_loop, reason = "constant bounds unroll")]

use super::layout::BLOCK;
use super::small::Small;
use super::tile::{block_mut, eight, eliminate, put_eight, triangle, LongMut};
use crate::vector::Vector;
use crate::{Kernel, Real};

/// The update; it uses up `x`.
pub struct AgeeTurner<'a, T> {
    pub columns: &'a mut [T],
    pub diagonal: &'a mut [T],
    pub x: &'a mut [T],
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
        if n <= BLOCK {
            return with_width!(n, few::<T>(&mut self));
        }
        let (mut x, mut t) = (LongMut::new(self.x), T::ONE / self.c);
        for b in (0..n.div_ceil(BLOCK)).rev() {
            let block = block_mut(self.columns, b);
            let mut d = eight(self.diagonal, b, T::FLOOR);
            let (slope, less_s);
            (t, slope, less_s) = scalars(&triangle(block, b), &mut d, x.eight(b), t);
            put_eight(self.diagonal, b, &d);
            eliminate::<T, V, GROUP>(block, &mut x, (&slope, &less_s));
        }
    }
}

/// t after a block, and the slopes and −s of its columns.
#[inline(always)]
fn scalars<T: Real, const C: usize>(
    u: &[[T; C]; C],
    d: &mut [T; C],
    x: &[T; C],
    mut t: T,
) -> (T, [T; C], [T; C]) {
    let [mut slope, mut less_s, mut before] = [[T::ZERO; C]; 3];
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
        d[c] = scaled.mul_add(less_s[c], d[c]);
        slope[c] = -(scaled / d[c]);
    }
    (t, slope, less_s)
}

/// For at most eight parameters.
#[inline(always)]
fn few<T: Real, const N: usize>(task: &mut AgeeTurner<'_, T>) {
    let AgeeTurner { columns, diagonal, x, c } = task;
    let (Some(d), Some(x)) = (diagonal.first_chunk_mut::<N>(), x.first_chunk_mut::<N>()) else {
        return;
    };
    let mut small = Small::<T, N>::load(columns, d);
    let (_, slope, less_s) = scalars(&small.u, &mut small.d, x, T::ONE / *c);
    for c in (0..N).rev() {
        for i in 0..c {
            let before = small.u[c][i];
            x[i] = less_s[c].mul_add(before, x[i]);
            small.u[c][i] = slope[c].mul_add(x[i], before);
        }
    }
    small.store(columns, d);
}
