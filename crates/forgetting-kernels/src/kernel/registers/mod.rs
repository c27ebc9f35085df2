//! One sample of at most ten parameters, in registers: of one stream, or of one in each lane.
//!
//! Measuring is Bierman's update (see [`super::bierman`]).

use super::layout::place;
use crate::number::lane::{Lane, One};
use crate::number::Real;

mod along;
mod chain;
mod columns;
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

impl<A: Copy, const N: usize, U: Unit<A, N>> Small<A, N, U> {
    /// P ← `growth`·P, then P⁻¹ ← P⁻¹ + fᵀf. `NEAR` is false if [`floor::far_before`] is known.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    #[cfg_attr(target_arch = "wasm32", inline(never))]
    pub fn scale_and_measure<T: Real, const NEAR: bool>(
        &mut self,
        growth: A,
        f: &[A; N],
    ) -> Gain<A, N>
    where
        A: Lane<T>,
    {
        let n = self.u.count();
        for d in &mut self.d {
            *d = *d * growth;
        }
        let mut w = transposed(&self.u, f);
        let chain = self.chain::<T, NEAR>(&mut w);
        self.u.last_pass(&self.d);
        let mut k = [A::splat(T::ZERO); N];
        // two loops, here and below: the compiler does not unroll one over ten columns
        for c in 0..n / 2 {
            self.measured(c, (-w[c], chain.inverse[c], chain.v[c]), &mut k);
        }
        for c in n / 2..n {
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
        for c in 0..self.u.count() {
            sum = (self.d[c] * w[c]).mul_add(w[c], sum);
        }
        sum
    }

    /// The trace of P.
    #[inline(always)]
    pub fn trace<T: Real>(&self) -> A
    where
        A: Lane<T>,
    {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        let mut trace = zero;
        for c in 0..self.u.count() {
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
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
#[cfg_attr(target_arch = "wasm32", inline(never))]
fn transposed<T, A, U, const N: usize>(u: &U, f: &[A; N]) -> [A; N]
where
    T: Real,
    A: Lane<T>,
    U: Unit<A, N>,
{
    let (mut w, n) = (*f, u.count());
    for c in 0..n / 2 {
        w[c] = dot(u, c, f);
    }
    for c in n / 2..n {
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
