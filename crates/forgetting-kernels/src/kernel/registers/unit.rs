//! Where U is while a sample is taken.

use crate::kernel::layout::{length, place, COMPACT};
use crate::number::lane::One;
use crate::number::Real;
use core::hint::black_box;

/// Where the numbers of U are while a sample is taken.
pub trait Unit<A, const N: usize> {
    /// Row i < c of column c.
    fn get(&self, c: usize, i: usize) -> A;
    fn set(&mut self, c: usize, i: usize, u: A);
    /// How many columns it has: N, a constant, unless one kernel is for all sizes up to that.
    #[inline(always)]
    fn count(&self) -> usize {
        N
    }
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
pub struct InPlace<'a, T> {
    columns: &'a mut [T],
    count: usize,
}

impl<'a, T: Real> InPlace<'a, T> {
    /// U of N columns.
    #[inline(always)]
    pub fn of<const N: usize>(columns: &'a mut [T]) -> Self {
        Self::of_some(columns, N)
    }

    /// U of so many columns.
    #[inline(always)]
    pub fn of_some(columns: &'a mut [T], count: usize) -> Self {
        Self { columns: &mut columns[..length::<T>(count)], count }
    }
}

impl<T: Real, A: One<T>, const N: usize> Unit<A, N> for InPlace<'_, T> {
    #[inline(always)]
    fn get(&self, c: usize, i: usize) -> A {
        A::splat(self.columns[place::<T>(i, c)])
    }
    #[inline(always)]
    fn set(&mut self, c: usize, i: usize, u: A) {
        self.columns[place::<T>(i, c)] = u.get();
    }
    #[inline(always)]
    fn count(&self) -> usize {
        if COMPACT {
            self.count
        } else {
            N
        }
    }
    #[inline(always)]
    fn last_pass(&mut self, _: &[A; N]) {
        if !COMPACT {
            *self = Self::of::<N>(black_box(core::mem::take(&mut self.columns)));
        }
    }
}
