//! One sample of at most ten parameters, in registers: of one stream, or of one in each lane.
//!
//! Measuring is Bierman's update (see [`super::bierman`]), adding covariance along the regressor
//! that of Agee and Turner (see [`super::agee_turner`]), both with one pass over U:
//!
//! ```text
//! z = U⁻¹f,  w = Uᵀf,  q = z / D;  fᵀP⁻¹f = Σ z q;  t = 1 / c
//! for each column, from the last:   D'_j = D_j + z_j² / t,  t ← t + z_j q_j,  slope_j = q_j / t
//! for each column, from the first:  w'_j = w_j + slope_j p,  p ← p + z_j w_j          (w' = U'ᵀf)
//!                                   u' = u + slope_j x,  x ← x + z_j u,  then Bierman with u', w'
//! ```

use super::layout::place;
use crate::number::lane::{Lane, One};
use crate::number::Real;

mod chain;
pub mod floor;
mod unit;
mod walk;

pub use unit::{InPlace, Unit};

/// U above its diagonal, by columns, and D.
#[derive(Clone, Copy)]
pub struct Small<A, const N: usize, U = [[A; N]; N]> {
    pub u: U,
    pub d: [A; N],
}

/// What measuring f brought.
#[derive(Clone, Copy)]
pub struct Gain<A, const N: usize> {
    /// a times the gain: P·fᵀ with the P before the measurement
    pub k: [A; N],
    /// f·P·fᵀ
    pub s: A,
    /// 1 + s
    pub a: A,
    pub inverse_a: A,
    /// the largest element of D
    pub largest: A,
}

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
    /// P ← `growth`·P, then P⁻¹ ← P⁻¹ + fᵀf. `NEAR` is false if [`floor::far_before`] is known.
    #[inline(always)]
    pub fn scale_and_measure<T: Real, const NEAR: bool>(
        &mut self,
        growth: A,
        f: &[A; N],
    ) -> Gain<A, N>
    where
        A: Lane<T>,
    {
        for d in &mut self.d {
            *d = *d * growth;
        }
        let mut w = transposed(&self.u, f);
        let chain = self.chain::<T, NEAR>(&mut w);
        self.u.last_pass(&self.d);
        let mut k = [A::splat(T::ZERO); N];
        // two loops, here and below: the compiler does not unroll one over ten columns
        for c in 0..N / 2 {
            self.measured(c, (-w[c], chain.inverse[c], chain.v[c]), &mut k);
        }
        for c in N / 2..N {
            self.measured(c, (-w[c], chain.inverse[c], chain.v[c]), &mut k);
        }
        if NEAR {
            self.narrow(&chain);
        }
        chain.gain(k)
    }

    /// Column c of U after the measurement, and k.
    #[inline(always)]
    fn measured<T: Real>(&mut self, c: usize, (less_w, inverse, v): (A, A, A), k: &mut [A; N])
    where
        A: Lane<T>,
    {
        for i in 0..c {
            let before = self.u.get(c, i);
            // the reciprocal comes last
            self.u.set(c, i, (less_w * k[i]).mul_add(inverse, before));
            k[i] = v.mul_add(before, k[i]);
        }
        k[c] = v;
    }

    /// f·P·fᵀ
    #[inline(always)]
    pub fn leverage<T: Real>(&self, f: &[A; N]) -> A
    where
        A: Lane<T>,
    {
        let w = transposed(&self.u, f);
        let mut sum = A::splat(T::ZERO);
        for c in 0..N {
            sum = (self.d[c] * w[c]).mul_add(w[c], sum);
        }
        sum
    }

    /// What P⁻¹ holds along f.
    #[inline(always)]
    pub fn along<T: Real>(&self, f: &[A; N]) -> Along<A, N>
    where
        A: Lane<T>,
    {
        let (mut z, mut q, mut information) = (*f, *f, A::splat(T::ZERO));
        for c in (N / 2..N).rev() {
            self.eliminate(c, &mut z);
        }
        for c in (0..N / 2).rev() {
            self.eliminate(c, &mut z);
        }
        for c in 0..N {
            q[c] = z[c] / self.d[c];
        }
        for c in (0..N).rev() {
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
        let (one, zero) = (A::splat(T::ONE), A::splat(T::ZERO));
        let mut w = transposed(&self.u, f);
        let (mut slope, mut inverse_t, mut p) = ([zero; N], c, zero);
        for c in (0..N).rev() {
            self.d[c] = (z[c] * inverse_t).mul_add(z[c], self.d[c]);
            t = z[c].mul_add(q[c], t);
            inverse_t = one / t;
            slope[c] = q[c] * inverse_t;
        }
        for c in 0..N {
            let before = w[c];
            w[c] = slope[c].mul_add(p, before);
            p = z[c].mul_add(before, p);
        }
        let chain = self.chain::<T, NEAR>(&mut w);
        self.u.last_pass(&self.d);
        let mut sums = [[zero; N]; 2];
        for c in 0..N / 2 {
            let measured = (-w[c], chain.inverse[c], chain.v[c]);
            self.widened_and_measured(c, (slope[c], z[c]), measured, &mut sums);
        }
        for c in N / 2..N {
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

impl<A: Copy, const N: usize, U: Unit<A, N>> Small<A, N, U> {
    /// The trace of P.
    #[inline(always)]
    pub fn trace<T: Real>(&self) -> A
    where
        A: Lane<T>,
    {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        let mut trace = zero;
        for c in 0..N {
            let mut squares = zero;
            for i in 0..c {
                let u = self.u.get(c, i);
                squares = u.mul_add(u, squares);
            }
            trace = trace + self.d[c] * (one + squares);
        }
        trace
    }
}

impl<A: Copy, const N: usize, U> Small<A, N, U> {
    /// The smallest element of D.
    #[inline(always)]
    pub fn least<T: Real>(&self) -> T
    where
        A: One<T>,
    {
        let mut least = A::splat(T::CEILING);
        for c in 0..N {
            least = least.min(self.d[c]);
        }
        least.get()
    }
}

impl<A: Copy, const N: usize> Small<A, N> {
    /// From the columns of U and from D.
    #[inline(always)]
    pub fn load<T: Real>(columns: &[T], diagonal: &[T; N]) -> Self
    where
        A: Lane<T>,
    {
        let mut u = [[A::splat(T::ZERO); N]; N];
        for c in 0..N {
            for i in 0..c {
                u[c][i] = A::splat(columns[place::<T>(i, c)]);
            }
        }
        Self { u, d: A::splat_each(diagonal) }
    }

    /// Back to where it came from.
    #[inline(always)]
    pub fn store<T: Real>(&self, columns: &mut [T], diagonal: &mut [T; N])
    where
        A: One<T>,
    {
        for c in 0..N {
            for i in 0..c {
                columns[place::<T>(i, c)] = self.u[c][i].get();
            }
        }
        *diagonal = A::get_each(&self.d);
    }
}

/// Uᵀf, in two sums of which neither waits for the other.
#[inline(always)]
fn transposed<T, A, U, const N: usize>(u: &U, f: &[A; N]) -> [A; N]
where
    T: Real,
    A: Lane<T>,
    U: Unit<A, N>,
{
    let mut w = *f;
    for c in 0..N / 2 {
        w[c] = dot(u, c, f);
    }
    for c in N / 2..N {
        w[c] = dot(u, c, f);
    }
    w
}

/// An element of it.
#[inline(always)]
fn dot<T, A, U, const N: usize>(u: &U, c: usize, f: &[A; N]) -> A
where
    T: Real,
    A: Lane<T>,
    U: Unit<A, N>,
{
    let (mut even, mut odd) = (f[c], A::splat(T::ZERO));
    for i in 0..c {
        if i % 2 == 0 {
            even = u.get(c, i).mul_add(f[i], even);
        } else {
            odd = u.get(c, i).mul_add(f[i], odd);
        }
    }
    if c > 1 {
        even + odd
    } else {
        even
    }
}
