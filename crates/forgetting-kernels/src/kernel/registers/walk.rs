//! Adding the same variance to every parameter: P ← shrink·P + noise·I, in registers.
//!
//! The rows of [U, I] are made orthogonal in the metric of diag(shrink·D, noise·I), from the last to
//! the first (the modified weighted Gram-Schmidt update of Thornton and Bierman):
//!
//! ```text
//! for each row w_j, from the last:   D_j ← w_j Δ w_jᵀ
//!     for i < j:                     U_ij ← w_i Δ w_jᵀ / D_j,  w_i ← w_i − U_ij w_j
//! ```
//!
//! U_ij changes by the share of noise in D_j: it is this change that is computed, so that a little noise
//! changes U by little more than rounding.
//!
//! It takes 2n³/3 products and n divisions; one dyad after the other would take half the products and
//! n²/2 divisions. Row j is 0 before its diagonal in both halves.

use super::{Small, Unit};
use crate::number::lane::Lane;
use crate::number::Real;

impl<A: Copy, const N: usize, U: Unit<A, N>> Small<A, N, U> {
    /// P ← `shrink`·P + `noise`·I.
    #[inline(always)]
    pub fn walk<T: Real>(&mut self, shrink: A, noise: A)
    where
        A: Lane<T>,
    {
        let (one, zero) = (A::splat(T::ONE), A::splat(T::ZERO));
        // the rows of U and of I as they become orthogonal
        let (mut left, mut right) = ([[zero; N]; N], [[zero; N]; N]);
        let mut weights = self.d;
        for m in 0..N {
            weights[m] = weights[m] * shrink;
            left[m][m] = one;
            right[m][m] = one;
            for i in 0..m {
                left[i][m] = self.u.get(m, i);
            }
        }
        for j in (0..N).rev() {
            let (mut heavy, mut light) = ([zero; N], [zero; N]);
            let light_j = noise * right[j][j];
            light[j] = light_j;
            let mut added = light_j * right[j][j];
            for m in j + 1..N {
                heavy[m] = weights[m] * left[j][m];
                light[m] = noise * right[j][m];
                added = heavy[m].mul_add(left[j][m], added);
                added = light[m].mul_add(right[j][m], added);
            }
            self.d[j] = weights[j] + added;
            let inverse = one / self.d[j];
            for i in 0..j {
                let before = left[i][j];
                let mut sum = -(before * added);
                for m in j + 1..N {
                    sum = left[i][m].mul_add(heavy[m], sum);
                    sum = right[i][m].mul_add(light[m], sum);
                }
                let change = sum * inverse;
                let u = before + change;
                self.u.set(j, i, u);
                let less = -u;
                left[i][j] = -change;
                right[i][j] = less.mul_add(right[j][j], right[i][j]);
                for m in j + 1..N {
                    left[i][m] = less.mul_add(left[j][m], left[i][m]);
                    right[i][m] = less.mul_add(right[j][m], right[i][m]);
                }
            }
        }
    }
}
