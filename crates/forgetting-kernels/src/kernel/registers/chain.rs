//! D after a measurement, column by column.

use super::{floor, Gain, Small, Unit};
use crate::number::lane::Lane;
use crate::number::Real;

/// What passes through the columns in Bierman's update.
pub struct Chain<A, const N: usize> {
    pub v: [A; N],
    /// 1/a before each column, unless w is divided by it
    pub inverse: [A; N],
    s: A,
    a: A,
    inverse_a: A,
    largest: A,
    /// what to multiply each column of U with at the end
    shares: [A; N],
    /// whether any of those is not 1
    lifted: bool,
}

impl<A: Copy, const N: usize, U: Unit<A, N>> Small<A, N, U> {
    /// D after the measurement of a regressor with w = Uᵀf, and what goes with it; the changes of U
    /// are then (−`w` k)·`inverse`.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    #[cfg_attr(target_arch = "wasm32", inline(never))]
    pub fn chain<T: Real, const NEAR: bool>(&mut self, w: &mut [A; N]) -> Chain<A, N>
    where
        A: Lane<T>,
    {
        let (one, zero) = (A::splat(T::ONE), A::splat(T::ZERO));
        let (mut v, mut inverse, mut s) = ([zero; N], [one; N], zero);
        let (mut largest, mut least) = (A::splat(T::FLOOR), A::splat(T::CEILING));
        let (mut a, mut inverse_a, n) = (one, one, self.u.count());
        for c in 0..n {
            let d = self.d[c];
            v[c] = d * w[c];
            let next = w[c].mul_add(v[c], a);
            inverse[c] = inverse_a;
            inverse_a = one / next;
            self.d[c] = d * (a * inverse_a);
            largest = largest.max(self.d[c]);
            least = least.min(self.d[c]);
            a = next;
        }
        for c in (0..n).rev() {
            s = w[c].mul_add(v[c], s);
        }
        let mut chain =
            Chain { v, inverse, s, a, inverse_a, largest, shares: [one; N], lifted: false };
        if NEAR && !A::all(floor::far_after(least, a)) {
            (self.d, *w, chain) = lift(n, self.d, *w, chain);
        }
        chain
    }

    /// The columns of which D was lifted add to P what they added before.
    #[inline(always)]
    pub fn narrow<T: Real>(&mut self, chain: &Chain<A, N>)
    where
        A: Lane<T>,
    {
        if !chain.lifted {
            return;
        }
        for c in 0..self.u.count() {
            for i in 0..c {
                self.u.set(c, i, self.u.get(c, i) * chain.shares[c]);
            }
        }
    }
}

/// D, just measured, at the floor where it is below.
///
/// It takes and returns values, so that they may stay in registers elsewhere.
#[inline(always)]
fn lift<T: Real, A: Lane<T>, const N: usize>(
    n: usize,
    mut d: [A; N],
    mut w: [A; N],
    mut chain: Chain<A, N>,
) -> ([A; N], [A; N], Chain<A, N>) {
    let mut inverse_after = chain.inverse_a;
    for c in (0..n).rev() {
        let inverse = chain.inverse[c];
        let column = floor::Column { d: d[c], w: w[c], v: chain.v[c], inverse };
        let (column, share) = column.lift(inverse_after, chain.a);
        (d[c], w[c], chain.inverse[c]) = (column.d, column.w, column.inverse);
        chain.shares[c] = share;
        inverse_after = inverse;
    }
    chain.lifted = true;
    (d, w, chain)
}

impl<A: Copy, const N: usize> Chain<A, N> {
    #[inline(always)]
    pub fn gain(self, k: [A; N]) -> Gain<A, N> {
        let Self { s, a, inverse_a, largest, .. } = self;
        Gain { k, s, a, inverse_a, largest }
    }
}
