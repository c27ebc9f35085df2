//! The numbers an estimator computes with: `f64` and `f32`.

pub mod block_vector;
pub mod lane;
pub mod lanes;
pub mod sums;
pub mod vector;

use crate::number::lanes::Lanes;
use crate::number::vector::Vector;
use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A floating-point number.
///
/// Every algorithm of this crate is written once, over this trait. A type that rounds
/// differently (a fused multiply-add, say) is another implementation, not another algorithm.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
{
    /// The numbers of one vector: 8 of eight bytes or 16 of four.
    type Chunk: Copy + Debug + Send + Sync + AsRef<[Self]> + AsMut<[Self]>;
    /// A vector that needs no particular instructions.
    type Lanes: Vector<Self>;

    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;
    /// Distance from 1 to the next number.
    const EPSILON: Self;
    /// Largest trace of P, largest ‖φ̄‖² and largest whitened error that are accepted.
    ///
    /// It is the square root of the largest number, less a margin: products of any two
    /// quantities of one update then stay finite, so that no accepted sample can overflow.
    const CEILING: Self;
    /// Smallest diagonal element that D may take: the reciprocal of [`Real::CEILING`].
    const FLOOR: Self;
    /// Numbers of a vector: 8 or 16.
    const ROWS: usize;
    /// Bytes of one number in a saved state.
    const BYTES: usize;

    /// The nearest number to `x`.
    fn from_f64(x: f64) -> Self;
    /// This number as `f64`, exactly.
    fn to_f64(self) -> f64;
    /// `self * factor + term`, rounded as the type prefers.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// At most [`Real::ROWS`] numbers, and zeros.
    fn chunk(numbers: &[Self]) -> Self::Chunk;
    /// `numbers` as chunks, and what is left.
    fn chunks(numbers: &[Self]) -> (&[Self::Chunk], &[Self]);
    /// The same, to be written.
    fn chunks_mut(numbers: &mut [Self]) -> (&mut [Self::Chunk], &mut [Self]);

    /// The larger of two numbers, neither of them NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other {
            self
        } else {
            other
        }
    }

    /// The smaller of two numbers, neither of them NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other {
            self
        } else {
            other
        }
    }
}

/// Copies `from` to the beginning of `to`, or as much as there is room for.
///
/// One by one: a copy of any length would be a call, for which all registers are cleared.
#[inline(always)]
pub fn copy_some<T: Copy, const L: usize>(to: &mut [T; L], from: &[T]) {
    for (i, to) in to.iter_mut().enumerate() {
        if i < from.len() {
            *to = from[i];
        }
    }
}

/// Copies the first of `from`, as many as there is room for; `from` is short.
///
/// One by one, as [`copy_some`].
#[inline(always)]
pub fn copy_first<T: Copy>(to: &mut [T], from: &[T]) {
    for (i, &x) in from.iter().enumerate() {
        if i < to.len() {
            to[i] = x;
        }
    }
}

macro_rules! real {
    ($float:ident, $lanes:literal, $ceiling:expr, $floor:expr, $sqrt:path, $ln:path, $exp:path) => {
        impl Real for $float {
            type Chunk = [Self; $lanes];
            type Lanes = Lanes<Self, $lanes>;
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const EPSILON: Self = $float::EPSILON;
            const CEILING: Self = $ceiling;
            const FLOOR: Self = $floor;
            const ROWS: usize = $lanes;
            const BYTES: usize = core::mem::size_of::<$float>();

            #[inline(always)]
            fn chunk(numbers: &[Self]) -> Self::Chunk {
                let mut chunk = [0.0; $lanes];
                copy_some(&mut chunk, numbers);
                chunk
            }
            #[inline(always)]
            fn chunks(numbers: &[Self]) -> (&[Self::Chunk], &[Self]) {
                numbers.as_chunks()
            }
            #[inline(always)]
            fn chunks_mut(numbers: &mut [Self]) -> (&mut [Self::Chunk], &mut [Self]) {
                numbers.as_chunks_mut()
            }
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                self * factor + term
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                $ln(self)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                $exp(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
        }
    };
}

// 2^500 and 2^62, with their reciprocals
real!(f64, 8, 3.273390607896142e150, 3.054_936_363_499_605e-151, libm::sqrt, libm::log, libm::exp);
real!(f32, 16, 4.611686e18, 2.1684043e-19, libm::sqrtf, libm::logf, libm::expf);

#[cfg(test)]
mod tests {
    use super::Real;

    #[test]
    fn the_floor_is_the_reciprocal_of_the_ceiling() {
        assert_eq!(f64::CEILING * f64::FLOOR, 1.0);
        assert_eq!(f32::CEILING * f32::FLOOR, 1.0);
        assert_eq!(f64::CEILING, 2f64.powi(500));
        assert_eq!(f32::CEILING, 2f32.powi(62));
    }
}
