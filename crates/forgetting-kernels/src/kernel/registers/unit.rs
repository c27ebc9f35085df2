//! Where U is while a sample is taken.

use crate::kernel::layout::{length, place};
use crate::number::lane::One;
use crate::number::Real;
use core::hint::black_box;

/// Where the numbers of U are while a sample is taken.
pub trait Unit<A, const N: usize> {
    /// Row i < c of column c.
    fn get(&self, c: usize, i: usize) -> A;
    fn set(&mut self, c: usize, i: usize, u: A);
    /// D is final, and U is read for the last time.
    fn last_pass(&mut self, d: &[A; N]);
}

/// In registers, as many as there are.
impl<A: Copy, const N: usize> Unit<A, N> for [[A; N]; N] {
    #[inline(always)]
    fn get(&self, c: usize, i: usize) -> A {
        self[c][i]
    }
    #[inline(always)]
    fn set(&mut self, c: usize, i: usize, u: A) {
        self[c][i] = u;
    }
    #[inline(always)]
    fn last_pass(&mut self, _: &[A; N]) {}
}

/// Where the factor keeps it: where there are more numbers than registers, a copy gains nothing.
pub struct InPlace<'a, T>(&'a mut [T]);

impl<'a, T: Real> InPlace<'a, T> {
    /// U of N columns.
    #[inline(always)]
    pub fn of<const N: usize>(columns: &'a mut [T]) -> Self {
        Self(&mut columns[..length::<T>(N)])
    }
}

impl<T: Real, A: One<T>, const N: usize> Unit<A, N> for InPlace<'_, T> {
    #[inline(always)]
    fn get(&self, c: usize, i: usize) -> A {
        A::splat(self.0[place::<T>(i, c)])
    }
    #[inline(always)]
    fn set(&mut self, c: usize, i: usize, u: A) {
        self.0[place::<T>(i, c)] = u.get();
    }
    #[inline(always)]
    fn last_pass(&mut self, _: &[A; N]) {
        *self = Self::of::<N>(black_box(core::mem::take(&mut self.0)));
    }
}
