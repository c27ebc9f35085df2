//! A vector that needs no particular instructions.
//!
//! On WebAssembly, where programs are to be small, its operations are loops, and calls unless the compiler
//! thinks otherwise: written out in every kernel they would be two thirds of the kernels' code.

use crate::number::lane::Lane;
use crate::number::Real;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// `L` numbers, 8 or 16, as an array: what the compiler makes of it.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<T, const L: usize>(pub(crate) [T; L]);

macro_rules! lane_by_lane {
    ($($Trait:ident $method:ident;)*) => {$(
        impl<T: Real, const L: usize> $Trait for Lanes<T, L> {
            type Output = Self;
            #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
            fn $method(mut self, other: Self) -> Self {
                for lane in 0..L {
                    self.0[lane] = self.0[lane].$method(other.0[lane]);
                }
                self
            }
        }
    )*};
}
lane_by_lane! { Add add; Sub sub; Mul mul; Div div; }

/// What is done to each lane `i`, written where the closure of a `map` would be: that is compiled
/// without the vector instructions.
macro_rules! each {
    ($L:ident, $i:ident: $first:expr, $of_each:expr) => {{
        let mut lanes = [$first; $L];
        for $i in 0..$L {
            lanes[$i] = $of_each;
        }
        lanes
    }};
}

impl<T: Real, const L: usize> Neg for Lanes<T, L> {
    type Output = Self;
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn neg(self) -> Self {
        Self(each!(L, i: T::ZERO, -self.0[i]))
    }
}

impl<T: Real, const L: usize> Lane<T> for Lanes<T, L> {
    type Mask = [bool; L];

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn splat(x: T) -> Self {
        Self([x; L])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(each!(L, i: T::ZERO, Real::mul_add(self.0[i], factor.0[i], term.0[i])))
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn max(self, other: Self) -> Self {
        Self(each!(L, i: T::ZERO, Real::max(self.0[i], other.0[i])))
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn min(self, other: Self) -> Self {
        Self(each!(L, i: T::ZERO, Real::min(self.0[i], other.0[i])))
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn abs(self) -> Self {
        Self(each!(L, i: T::ZERO, Real::abs(self.0[i])))
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn sqrt(self) -> Self {
        Self(each!(L, i: T::ZERO, Real::sqrt(self.0[i])))
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn at_most(self, limit: Self) -> [bool; L] {
        each!(L, i: false, self.0[i] <= limit.0[i])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn less_than(self, limit: Self) -> [bool; L] {
        each!(L, i: false, self.0[i] < limit.0[i])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn both(a: [bool; L], b: [bool; L]) -> [bool; L] {
        each!(L, i: false, a[i] & b[i])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn all(mask: [bool; L]) -> bool {
        let mut all = true;
        for lane in mask {
            all &= lane;
        }
        all
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn select(mask: [bool; L], yes: Self, no: Self) -> Self {
        Self(each!(L, i: T::ZERO, T::select(mask[i], yes.0[i], no.0[i])))
    }
}
