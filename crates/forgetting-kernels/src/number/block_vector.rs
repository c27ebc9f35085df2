//! A number for each of the eight columns of a block of U, in vector registers.

use crate::number::lane::Lane;
use crate::number::lanes::Lanes;
use crate::number::Real;

/// BlockVector numbers: what passes from column to column is done for all eight side by side.
pub trait BlockVector<T: Real>: Lane<T> {
    /// Loads `numbers`.
    fn read(numbers: &[T; 8]) -> Self;
    /// Stores into `numbers`.
    fn write(self, numbers: &mut [T; 8]);
    /// The sums of the first one, two, … of them, none of more than three additions: pairs, then
    /// pairs of pairs, then the two halves.
    fn running_sums(self) -> Self;
    /// The number before each; before the first comes that of `first`.
    fn before(self, first: Self) -> Self;
    /// The last, eight times.
    fn last(self) -> Self;
    /// The sums of all from each on to the last: [`BlockVector::running_sums`] from the other end.
    fn remaining_sums(self) -> Self;
    /// The number after each; after the last comes that of `last`.
    fn after(self, last: Self) -> Self;
    /// The first, eight times.
    fn first(self) -> Self;

    /// These numbers, as an array.
    #[inline(always)]
    fn numbers(self) -> [T; 8] {
        let mut numbers = [T::ZERO; 8];
        self.write(&mut numbers);
        numbers
    }
}

impl<T: Real> BlockVector<T> for Lanes<T, 8> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn read(numbers: &[T; 8]) -> Self {
        Self(*numbers)
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn write(self, numbers: &mut [T; 8]) {
        *numbers = self.0;
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn running_sums(self) -> Self {
        let [a, b, c, d, e, f, g, h] = self.0;
        // the first of each pair gets a zero in a register, which changes the sign of −0
        let (a, c, e, g) = (a + T::ZERO, c + T::ZERO, e + T::ZERO, g + T::ZERO);
        let (ab, cd, ef, gh) = (a + b, c + d, e + f, g + h);
        let abcd = ab + cd;
        Self([a, ab, ab + c, abcd, abcd + e, abcd + ef, abcd + (ef + g), abcd + (ef + gh)])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn before(self, first: Self) -> Self {
        let [a, b, c, d, e, f, g, _] = self.0;
        Self([first.0[0], a, b, c, d, e, f, g])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn last(self) -> Self {
        Self([self.0[7]; 8])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn remaining_sums(self) -> Self {
        self.backwards().running_sums().backwards()
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn after(self, last: Self) -> Self {
        let [_, b, c, d, e, f, g, h] = self.0;
        Self([b, c, d, e, f, g, h, last.0[0]])
    }
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn first(self) -> Self {
        Self([self.0[0]; 8])
    }
}

impl<T: Real> Lanes<T, 8> {
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn backwards(self) -> Self {
        let [a, b, c, d, e, f, g, h] = self.0;
        Self([h, g, f, e, d, c, b, a])
    }
}

#[cfg(test)]
mod tests {
    use super::BlockVector;
    use crate::number::lanes::Lanes;

    #[test]
    fn sums_and_neighbours() {
        let of = |numbers| <Lanes<f64, 8> as BlockVector<f64>>::read(&numbers);
        let x = of([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        assert_eq!(x.running_sums().numbers(), [1.0, 3.0, 6.0, 10.0, 15.0, 21.0, 28.0, 36.0]);
        assert_eq!(x.remaining_sums().numbers(), [36.0, 35.0, 33.0, 30.0, 26.0, 21.0, 15.0, 8.0]);
        assert_eq!(x.before(of([9.0; 8])).numbers(), [9.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        assert_eq!(x.after(of([9.0; 8])).numbers(), [2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert_eq!((x.first().numbers(), x.last().numbers()), ([1.0; 8], [8.0; 8]));
    }
}
