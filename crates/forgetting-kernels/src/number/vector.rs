//! Neighbouring numbers that go through the same operations together.

use crate::number::lane::{Lane, One};
use crate::number::lanes::Lanes;
use crate::number::sums::Sums;
use crate::number::Real;

/// A chunk of numbers ([`Real::Chunk`]) in vector registers.
///
/// A number type has one for every set of instructions that it may run on; all give the same
/// bits.
pub trait Vector<T: Real>: Sums<T> {
    /// A single number, as this set of instructions works fastest with one.
    type One: One<T>;
    /// What the streams of a fleet run in.
    type StreamVector: StreamVector<T>;

    /// The numbers of `chunk`.
    fn load(chunk: &T::Chunk) -> Self;
    /// Writes all lanes to `chunk`.
    fn store(self, chunk: &mut T::Chunk);
    /// The first `count` lanes, zeros in the rest.
    #[inline(always)]
    fn first(self, count: usize) -> Self {
        let mut position = T::chunk(&[]);
        for (i, position) in position.as_mut().iter_mut().enumerate() {
            *position = T::from_f64(i as f64);
        }
        let within = Self::load(&position).less_than(Self::splat(T::from_f64(count as f64)));
        Self::select(within, self, Self::splat(T::ZERO))
    }
}

/// One number of each of COUNT streams in one register. Narrower than [`Vector`], so that a long
/// recursion has registers left for its own values.
pub trait StreamVector<T: Real>: Lane<T> {
    /// How many streams, at most those of a chunk.
    const COUNT: usize;
    /// The first [`StreamVector::COUNT`] of `numbers`, of which there are as many at least.
    fn read(numbers: &[T]) -> Self;
    /// Writes them to the first [`StreamVector::COUNT`] of `numbers`, of which there are as many.
    fn write(self, numbers: &mut [T]);
    /// The number at each position.
    fn at(number: impl Fn(usize) -> T) -> Self;
    /// The columns of [`StreamVector::COUNT`] rows, with a row in each lane.
    #[inline(always)]
    fn columns<const N: usize>(rows: &[[T; N]]) -> [Self; N] {
        let mut columns = [Self::splat(T::ZERO); N];
        for i in 0..N {
            columns[i] = Self::at(|lane| rows[lane][i]);
        }
        columns
    }
    /// Asks memory for what will be needed soon, where a machine has an instruction for that.
    #[inline(always)]
    fn prefetch<L>(_line: &L) {}
}

impl<T: Real> StreamVector<T> for T {
    const COUNT: usize = 1;

    #[inline(always)]
    fn read(numbers: &[T]) -> T {
        numbers[0]
    }
    #[inline(always)]
    fn write(self, numbers: &mut [T]) {
        numbers[0] = self;
    }
    #[inline(always)]
    fn at(number: impl Fn(usize) -> T) -> T {
        number(0)
    }
}

impl<T: Real<Chunk = [T; L]>, const L: usize> Vector<T> for Lanes<T, L> {
    type StreamVector = T;
    type One = T;

    #[inline(always)]
    fn load(chunk: &[T; L]) -> Self {
        Self(*chunk)
    }
    #[inline(always)]
    fn store(self, chunk: &mut [T; L]) {
        *chunk = self.0;
    }
}
