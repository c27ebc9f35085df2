//! Neighbouring numbers that go through the same operations together.

use crate::Real;
use core::array::from_fn;

/// A chunk of numbers ([`Real::Chunk`]) in vector registers.
///
/// A number type has one for every set of instructions that it may run on; all give the same
/// bits.
pub trait Vector<T: Real>: Copy {
    /// `x` in every lane.
    fn splat(x: T) -> Self;
    /// The numbers of `chunk`.
    fn load(chunk: &T::Chunk) -> Self;
    /// The numbers of `half`, [`HALF`] of them; 0 in the other lanes.
    fn load_half(half: &[T; HALF]) -> Self;
    /// Writes all lanes to `chunk`.
    fn store(self, chunk: &mut T::Chunk);
    /// Writes the first [`HALF`] lanes to `half`.
    fn store_half(self, half: &mut [T; HALF]);
    /// `self * factor + term`, lane by lane.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// The sum of all lanes: halves added to halves down to four, then pairs.
    fn sum(self) -> T;
}

/// Numbers in the smaller of two kinds of chunks; a chunk has as many or twice as many.
pub const HALF: usize = 8;

/// `L` numbers, 8 or 16, as an array: what the compiler makes of it.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<T, const L: usize>([T; L]);

impl<T: Real<Chunk = [T; L]>, const L: usize> Vector<T> for Lanes<T, L> {
    #[inline(always)]
    fn splat(x: T) -> Self {
        Self([x; L])
    }
    #[inline(always)]
    fn load(chunk: &[T; L]) -> Self {
        Self(*chunk)
    }
    #[inline(always)]
    fn load_half(half: &[T; HALF]) -> Self {
        Self(from_fn(|lane| if lane < HALF { half[lane] } else { T::ZERO }))
    }
    #[inline(always)]
    fn store(self, chunk: &mut [T; L]) {
        *chunk = self.0;
    }
    #[inline(always)]
    fn store_half(self, half: &mut [T; HALF]) {
        *half = from_fn(|lane| self.0[lane]);
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(from_fn(|lane| self.0[lane].mul_add(factor.0[lane], term.0[lane])))
    }
    #[inline(always)]
    fn sum(self) -> T {
        let other =
            |lane| if L > HALF { self.0[lane] + self.0[lane + L / 2] } else { self.0[lane] };
        let eight: [T; 8] = from_fn(other);
        let four: [T; 4] = from_fn(|lane| eight[lane] + eight[lane + 4]);
        (four[0] + four[1]) + (four[2] + four[3])
    }
}
