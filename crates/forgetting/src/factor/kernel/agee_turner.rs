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

use super::block::{eliminate, load_triangle, with_width, PerColumn};
use super::layout::BLOCK;
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
        let mut t = T::ONE / self.c;
        for j in (0..self.diagonal.len()).step_by(BLOCK).rev() {
            let width = BLOCK.min(self.diagonal.len() - j);
            let (slope, less_s);
            (t, slope, less_s) = with_width!(width, corner::<T>(&mut self, j, t));
            eliminate::<T, V, GROUP>(self.columns, j, width, self.x, (&slope, &less_s));
        }
    }
}

/// The triangle of a block: t after it, and the slopes and −s of its columns.
#[inline(always)]
fn corner<T: Real, const C: usize>(
    task: &mut AgeeTurner<'_, T>,
    j: usize,
    mut t: T,
) -> (T, PerColumn<T>, PerColumn<T>) {
    let (mut slope, mut less_s) = ([T::ZERO; BLOCK], [T::ZERO; BLOCK]);
    let (Some(d), Some(&x)) =
        (task.diagonal[j..].first_chunk_mut::<C>(), task.x[j..].first_chunk::<C>())
    else {
        return (t, slope, less_s);
    };
    let u = load_triangle::<T, C>(task.columns, j);
    let mut rest = x;
    for c in (0..C).rev() {
        less_s[c] = -rest[c];
        for i in 0..c {
            rest[i] = less_s[c].mul_add(u[c][i], rest[i]);
        }
    }
    let mut before = [T::ZERO; C];
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
