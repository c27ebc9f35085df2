//! Adding covariance along the regressor and measuring it, in registers: Agee and Turner's update (see
//! [`crate::kernel::agee_turner`]), then Bierman's, both with one pass over U:
//!
//! ```text
//! z = U⁻¹f,  w = Uᵀf,  q = z / D;  fᵀP⁻¹f = Σ z q;  t = 1 / c
//! for each column, from the last:   D'_j = D_j + z_j² / t,  t ← t + z_j q_j,  slope_j = q_j / t
//! for each column, from the first:  w'_j = w_j + slope_j p,  p ← p + z_j w_j          (w' = U'ᵀf)
//!                                   u' = u + slope_j x,  x ← x + z_j u,  then Bierman with u', w'
//! ```

use super::{transposed, Gain, Small, Unit};
use crate::number::lane::Lane;
use crate::number::Real;

/// f in the coordinates of the factor.
#[derive(Clone, Copy)]
pub struct Along<A, const N: usize> {
    /// U⁻¹f
    pub z: [A; N],
    /// z / D
    pub q: [A; N],
    /// fᵀP⁻¹f
    pub information: A,
}

impl<A: Copy, const N: usize, U: Unit<A, N>> Small<A, N, U> {
    /// What P⁻¹ holds along f.
    #[inline(always)]
    pub fn along<T: Real>(&self, f: &[A; N]) -> Along<A, N>
    where
        A: Lane<T>,
    {
        let (mut z, mut q, mut information) = (*f, *f, A::splat(T::ZERO));
        let n = self.u.count();
        for c in (n / 2..n).rev() {
            self.eliminate(c, &mut z);
        }
        for c in (0..n / 2).rev() {
            self.eliminate(c, &mut z);
        }
        for c in 0..n {
            q[c] = z[c] / self.d[c];
        }
        for c in (0..n).rev() {
            information = z[c].mul_add(q[c], information);
        }
        Along { z, q, information }
    }

    /// z without what column c holds of it.
    #[inline(always)]
    fn eliminate<T: Real>(&self, c: usize, z: &mut [A; N])
    where
        A: Lane<T>,
    {
        let less_z = -z[c];
        for i in 0..c {
            z[i] = less_z.mul_add(self.u.get(c, i), z[i]);
        }
    }

    /// P ← P + c·fᵀf, then P⁻¹ ← P⁻¹ + fᵀf, with t = 1/c; where z and q are 0, c is 0 instead.
    #[inline(always)]
    pub fn add_and_measure<T: Real, const NEAR: bool>(
        &mut self,
        (c, mut t): (A, A),
        Along { z, q, .. }: &Along<A, N>,
        f: &[A; N],
    ) -> Gain<A, N>
    where
        A: Lane<T>,
    {
        let (one, zero, n) = (A::splat(T::ONE), A::splat(T::ZERO), self.u.count());
        let mut w = transposed(&self.u, f);
        let (mut slope, mut inverse_t, mut p) = ([zero; N], c, zero);
        for c in (0..n).rev() {
            self.d[c] = (z[c] * inverse_t).mul_add(z[c], self.d[c]);
            t = z[c].mul_add(q[c], t);
            inverse_t = one / t;
            slope[c] = q[c] * inverse_t;
        }
        for c in 0..n {
            let before = w[c];
            w[c] = slope[c].mul_add(p, before);
            p = z[c].mul_add(before, p);
        }
        let chain = self.chain::<T, NEAR>(&mut w);
        self.u.last_pass(&self.d);
        let mut sums = [[zero; N]; 2];
        for c in 0..n / 2 {
            let measured = (-w[c], chain.inverse[c], chain.v[c]);
            self.widened_and_measured(c, (slope[c], z[c]), measured, &mut sums);
        }
        for c in n / 2..n {
            let measured = (-w[c], chain.inverse[c], chain.v[c]);
            self.widened_and_measured(c, (slope[c], z[c]), measured, &mut sums);
        }
        let [_, k] = sums;
        if NEAR {
            self.narrow(&chain);
        }
        chain.gain(k)
    }

    /// Column c of U after both updates, and x and k.
    #[inline(always)]
    fn widened_and_measured<T: Real>(
        &mut self,
        c: usize,
        (slope, z): (A, A),
        (less_w, inverse, v): (A, A, A),
        [x, k]: &mut [[A; N]; 2],
    ) where
        A: Lane<T>,
    {
        for i in 0..c {
            let before = self.u.get(c, i);
            let widened = slope.mul_add(x[i], before);
            x[i] = z.mul_add(before, x[i]);
            self.u.set(c, i, (less_w * k[i]).mul_add(inverse, widened));
            k[i] = v.mul_add(widened, k[i]);
        }
        (x[c], k[c]) = (z, v);
    }
}
