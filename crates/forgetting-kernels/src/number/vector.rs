//! Neighbouring numbers that go through the same operations together.

use crate::number::lane::{Lane, One};
use crate::number::sums::Sums;
use crate::number::Real;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A chunk of numbers ([`Real::Chunk`]) in vector registers.
///
/// A number type has one for every set of instructions that it may run on; all give the same
/// bits.
pub trait Vector<T: Real>: Sums<T> {
    /// A single number, as this set of instructions works fastest with one.
    type One: One<T>;
    /// What the streams of a fleet run in.
    type Abreast: Abreast<T>;

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
pub trait Abreast<T: Real>: Lane<T> {
    /// How many streams, at most those of a chunk.
    const COUNT: usize;
    /// The first [`Abreast::COUNT`] of `numbers`, of which there are as many at least.
    fn read(numbers: &[T]) -> Self;
    /// Writes them to the first [`Abreast::COUNT`] of `numbers`, of which there are as many.
    fn write(self, numbers: &mut [T]);
    /// The number at each position.
    fn at(number: impl Fn(usize) -> T) -> Self;
    /// Asks memory for what will be needed soon, where a machine has an instruction for that.
    #[inline(always)]
    fn prefetch<L>(_line: &L) {}
}

impl<T: Real> Abreast<T> for T {
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

/// `L` numbers, 8 or 16, as an array: what the compiler makes of it.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<T, const L: usize>(pub(crate) [T; L]);

macro_rules! lane_by_lane {
    ($($Trait:ident $method:ident;)*) => {$(
        impl<T: Real, const L: usize> $Trait for Lanes<T, L> {
            type Output = Self;
            #[inline(always)]
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
    #[inline(always)]
    fn neg(self) -> Self {
        Self(each!(L, i: T::ZERO, -self.0[i]))
    }
}

impl<T: Real, const L: usize> Lane<T> for Lanes<T, L> {
    type Mask = [bool; L];

    #[inline(always)]
    fn splat(x: T) -> Self {
        Self([x; L])
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(each!(L, i: T::ZERO, Real::mul_add(self.0[i], factor.0[i], term.0[i])))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(each!(L, i: T::ZERO, Real::max(self.0[i], other.0[i])))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(each!(L, i: T::ZERO, Real::min(self.0[i], other.0[i])))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(each!(L, i: T::ZERO, Real::abs(self.0[i])))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(each!(L, i: T::ZERO, Real::sqrt(self.0[i])))
    }
    #[inline(always)]
    fn at_most(self, limit: Self) -> [bool; L] {
        each!(L, i: false, self.0[i] <= limit.0[i])
    }
    #[inline(always)]
    fn less_than(self, limit: Self) -> [bool; L] {
        each!(L, i: false, self.0[i] < limit.0[i])
    }
    #[inline(always)]
    fn both(a: [bool; L], b: [bool; L]) -> [bool; L] {
        each!(L, i: false, a[i] & b[i])
    }
    #[inline(always)]
    fn all(mask: [bool; L]) -> bool {
        let mut all = true;
        for lane in mask {
            all &= lane;
        }
        all
    }
    #[inline(always)]
    fn select(mask: [bool; L], yes: Self, no: Self) -> Self {
        Self(each!(L, i: T::ZERO, T::select(mask[i], yes.0[i], no.0[i])))
    }
}

impl<T: Real<Chunk = [T; L]>, const L: usize> Vector<T> for Lanes<T, L> {
    type Abreast = T;
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

impl<T: Real, const L: usize> Sums<T> for Lanes<T, L> {
    type Four = [T; 4];
    type Eight = Lanes<T, 8>;

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
    #[inline(always)]
    fn four_sums([a, b, c, d]: [Self; 4]) -> [T; 4] {
        [a.sum(), b.sum(), c.sum(), d.sum()]
    }
    #[inline(always)]
    fn numbers(four: [T; 4]) -> [T; 4] {
        four
    }
    #[inline(always)]
    fn join([a, b, c, d]: [T; 4], [e, f, g, h]: [T; 4]) -> Lanes<T, 8> {
        Lanes([a, b, c, d, e, f, g, h])
    }
}
