//! Rows made orthogonal: the singular value decomposition of a sample of several rows.

use super::Sample;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::Real;

impl<M: Memory> Sample<'_, M> {
    /// Rotates the rows until they are orthogonal (one-sided Jacobi): with the compact singular
    /// value decomposition φ̄ = W S Vᵀ, φ̄ becomes S Vᵀ and ē becomes Wᵀē.
    pub fn orthogonalize(&mut self) {
        const SWEEPS: usize = 30;
        for _ in 0..SWEEPS {
            let mut rotated = false;
            for i in 0..self.rows {
                for k in i + 1..self.rows {
                    rotated |= self.rotate(i, k);
                }
            }
            if !rotated {
                break;
            }
        }
    }

    /// Makes rows i < k orthogonal; says whether they were not.
    fn rotate(&mut self, i: usize, k: usize) -> bool {
        let (a, b) = (dot(self.row(i), self.row(i)), dot(self.row(k), self.row(k)));
        let c = dot(self.row(i), self.row(k));
        if c.abs() <= M::Real::EPSILON * (a * b).sqrt() {
            return false;
        }
        let zeta = (b - a) / (c + c);
        let sign = if zeta < M::Real::ZERO { -M::Real::ONE } else { M::Real::ONE };
        let t = sign / (zeta.abs() + (M::Real::ONE + zeta * zeta).sqrt());
        let cosine = M::Real::ONE / (M::Real::ONE + t * t).sqrt();
        let sine = cosine * t;
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        for (block, width) in [(&mut *self.regressors, n), (&mut *self.errors, m)] {
            let (above, from) = block.split_at_mut(k * width);
            for (x, y) in above[i * width..].iter_mut().zip(&mut from[..width]) {
                let (before_x, before_y) = (*x, *y);
                *x = cosine * before_x - sine * before_y;
                *y = sine * before_x + cosine * before_y;
            }
        }
        true
    }
}
