//! Sums across the numbers of vectors.

use crate::number::block_vector::BlockVector;
use crate::number::lane::Lane;
use crate::number::lanes::Lanes;
use crate::number::Real;

/// A vector whose numbers can be added up, alone or side by side with others.
///
/// Every sum is taken in the same order: halves are added to halves until four numbers are left, then
/// (first + second) + (third + fourth).
pub trait Sums<T: Real>: Lane<T> {
    /// a number for each of four vectors
    type Four: Copy;
    /// a number for each of eight, as for the columns of a block
    type BlockVector: BlockVector<T>;

    /// The sum of its numbers.
    fn sum(self) -> T;
    /// The sums of four vectors.
    fn four_sums(vectors: [Self; 4]) -> Self::Four;
    /// Four numbers, to memory.
    fn numbers(four: Self::Four) -> [T; 4];
    /// Four numbers and the four after them.
    fn join(first: Self::Four, second: Self::Four) -> Self::BlockVector;

    /// The sums of eight vectors.
    #[inline(always)]
    fn eight_sums([a, b, c, d, e, f, g, h]: [Self; 8]) -> Self::BlockVector {
        Self::join(Self::four_sums([a, b, c, d]), Self::four_sums([e, f, g, h]))
    }

    /// The sums of `C` vectors, to memory.
    #[inline(always)]
    fn sums<const C: usize>(vectors: [Self; C]) -> [T; C] {
        let mut sums = [T::ZERO; C];
        let (fours, rest) = vectors.as_chunks::<4>();
        let (sums_of_fours, sums_of_rest) = sums.as_chunks_mut::<4>();
        for i in 0..fours.len() {
            sums_of_fours[i] = Self::numbers(Self::four_sums(fours[i]));
        }
        for i in 0..rest.len() {
            sums_of_rest[i] = rest[i].sum();
        }
        sums
    }
}

impl<T: Real, const L: usize> Sums<T> for Lanes<T, L> {
    type Four = [T; 4];
    type BlockVector = Lanes<T, 8>;

    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
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
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn four_sums([a, b, c, d]: [Self; 4]) -> [T; 4] {
        [a.sum(), b.sum(), c.sum(), d.sum()]
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn numbers(four: [T; 4]) -> [T; 4] {
        four
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn join([a, b, c, d]: [T; 4], [e, f, g, h]: [T; 4]) -> Lanes<T, 8> {
        Lanes([a, b, c, d, e, f, g, h])
    }
}
