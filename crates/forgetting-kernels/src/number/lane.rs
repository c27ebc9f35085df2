//! The arithmetic of the recursions: on one number, or on one number of each of several streams
//! side by side.

use crate::number::Real;
use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// One number of type `T`, or several in vector registers, each for a stream of its own.
///
/// What is written over this trait has no branches on values, so that it does the same for every
/// stream: [`Lane::select`] takes their place.
pub trait Lane<T>:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// a yes or no for each lane
    type Mask: Copy;

    /// `x` in every lane.
    fn splat(x: T) -> Self;
    /// `self * factor + term`, rounded as the type prefers.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// The larger of two numbers, neither of them NaN.
    fn max(self, other: Self) -> Self;
    /// The smaller of two numbers, neither of them NaN.
    fn min(self, other: Self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Where `self` ≤ `limit`: not where either is NaN.
    fn at_most(self, limit: Self) -> Self::Mask;
    /// Where `self` < `limit`: not where either is NaN.
    fn less_than(self, limit: Self) -> Self::Mask;
    /// Where both are so.
    fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Whether it is so in every lane.
    fn all(mask: Self::Mask) -> bool;
    /// `yes` where `mask` says so, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Each of `numbers` in every lane.
    // a loop, as every place that holds vectors: what `map` calls is compiled without their
    // instructions
    #[inline(always)]
    fn splat_each<const N: usize>(numbers: &[T; N]) -> [Self; N]
    where
        T: Copy,
    {
        let mut lanes = [Self::splat(numbers[0]); N];
        for i in 1..N {
            lanes[i] = Self::splat(numbers[i]);
        }
        lanes
    }
}

/// One number, in whatever form a machine works fastest with one.
pub trait One<T>: Lane<T> {
    /// The number itself.
    fn get(self) -> T;

    /// Each of `numbers` itself.
    #[inline(always)]
    fn get_each<const N: usize>(numbers: &[Self; N]) -> [T; N]
    where
        T: Copy,
    {
        let mut each = [numbers[0].get(); N];
        for i in 1..N {
            each[i] = numbers[i].get();
        }
        each
    }
}

impl<T: Real> One<T> for T {
    #[inline(always)]
    fn get(self) -> T {
        self
    }
}

impl<T: Real> Lane<T> for T {
    type Mask = bool;

    #[inline(always)]
    fn splat(x: T) -> T {
        x
    }
    #[inline(always)]
    fn mul_add(self, factor: T, term: T) -> T {
        Real::mul_add(self, factor, term)
    }
    #[inline(always)]
    fn max(self, other: T) -> T {
        Real::max(self, other)
    }
    #[inline(always)]
    fn min(self, other: T) -> T {
        Real::min(self, other)
    }
    #[inline(always)]
    fn abs(self) -> T {
        Real::abs(self)
    }
    #[inline(always)]
    fn sqrt(self) -> T {
        Real::sqrt(self)
    }
    #[inline(always)]
    fn at_most(self, limit: T) -> bool {
        self <= limit
    }
    #[inline(always)]
    fn less_than(self, limit: T) -> bool {
        self < limit
    }
    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn all(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn select(mask: bool, yes: T, no: T) -> T {
        if mask {
            yes
        } else {
            no
        }
    }
}
