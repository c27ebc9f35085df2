//! Neighbouring numbers that go through the same operations together.

use crate::Real;

/// A chunk of numbers ([`Real::Chunk`]) in vector registers.
///
/// A number type has one for every set of instructions that it may run on; all give the same
/// bits.
pub trait Vector<T: Real>: Copy {
    /// `x` in every lane.
    fn splat(x: T) -> Self;
    /// The numbers of `chunk`.
    fn load(chunk: &T::Chunk) -> Self;
    /// The numbers of `first`, at most [`HALF`]; 0 in the other lanes.
    fn load_first(first: &[T]) -> Self;
    /// The numbers of `half`; 0 in the other lanes.
    fn load_half(half: &[T; HALF]) -> Self;
    /// Writes all lanes to `chunk`.
    fn store(self, chunk: &mut T::Chunk);
    /// Writes the first lanes to `first`, at most [`HALF`] numbers.
    fn store_first(self, first: &mut [T]);
    /// Writes the first [`HALF`] lanes to `half`.
    fn store_half(self, half: &mut [T; HALF]);
    /// `self * factor + term`, lane by lane.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// The sum of all lanes: halves added to halves down to four, then pairs.
    fn sum(self) -> T;
    /// The sum of each of `C` vectors.
    #[inline(always)]
    fn sums<const C: usize>(vectors: [Self; C]) -> [T; C] {
        let mut sums = [T::ZERO; C];
        for c in 0..C {
            sums[c] = vectors[c].sum();
        }
        sums
    }
}

/// Half a chunk of small numbers, a whole one of large: the columns of a block of U.
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
    fn load_first(first: &[T]) -> Self {
        let mut lanes = [T::ZERO; L];
        for (lane, &x) in lanes[..HALF].iter_mut().zip(first) {
            *lane = x;
        }
        Self(lanes)
    }
    #[inline(always)]
    fn load_half(half: &[T; HALF]) -> Self {
        let mut lanes = [T::ZERO; L];
        lanes[..HALF].copy_from_slice(half);
        Self(lanes)
    }
    #[inline(always)]
    fn store(self, chunk: &mut [T; L]) {
        *chunk = self.0;
    }
    #[inline(always)]
    fn store_first(self, first: &mut [T]) {
        for (x, &lane) in first.iter_mut().zip(&self.0[..HALF]) {
            *x = lane;
        }
    }
    #[inline(always)]
    fn store_half(self, half: &mut [T; HALF]) {
        half.copy_from_slice(&self.0[..HALF]);
    }
    #[inline(always)]
    fn mul_add(mut self, factor: Self, term: Self) -> Self {
        for lane in 0..L {
            self.0[lane] = self.0[lane].mul_add(factor.0[lane], term.0[lane]);
        }
        self
    }
    #[inline(always)]
    fn sum(self) -> T {
        let mut lanes = self.0;
        let mut count = L;
        while count > 4 {
            count /= 2;
            for lane in 0..count {
                lanes[lane] += lanes[lane + count];
            }
        }
        (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
    }
}
