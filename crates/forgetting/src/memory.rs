//! Where an estimator keeps its numbers: on the stack, of a size known to the compiler
//! ([`Fixed`]), or on the heap, of a size known when it is made ([`Dynamic`]).
//!
//! The algorithms see slices only, so that both give the same bits.

use crate::factor::kernel::{most, scratch, set_identity};
use crate::Real;
use core::fmt::Debug;
use core::marker::PhantomData;

/// A block of numbers that is read and written as one slice.
pub trait Buffer<T>: Clone + Debug + Send + Sync + AsRef<[T]> + AsMut<[T]> {}
impl<T, B: Clone + Debug + Send + Sync + AsRef<[T]> + AsMut<[T]>> Buffer<T> for B {}

/// The sizes of an estimation problem, and buffers to match.
///
/// | symbol | method | meaning |
/// |---|---|---|
/// | n | `parameters` | parameters of each target |
/// | p | `rows` | rows of φ, measurements a sample, that share one θ |
/// | m | `targets` | parameter vectors that share φ and one P |
pub trait Memory: Copy + Debug + Send + Sync + 'static {
    /// The number type.
    type Real: Real;
    /// n numbers
    type Vector: Buffer<Self::Real>;
    /// the columns of U: at least [`capacity`](crate::factor::kernel::capacity) of n numbers
    type Packed: Buffer<Self::Real>;
    /// n x n numbers
    type Square: Buffer<Self::Real>;
    /// p x n numbers, row by row
    type Rows: Buffer<Self::Real>;
    /// p x p numbers
    type Noise: Buffer<Self::Real>;
    /// p x m numbers, row by row
    type Errors: Buffer<Self::Real>;
    /// m x n numbers, one target after the other
    type Parameters: Buffer<Self::Real>;
    /// a few times n numbers, for the kernels to work with
    type Scratch: Buffer<Self::Real>;
    /// numbers of a count that only the configuration knows, such as a window of past samples
    type List: Buffer<Self::Real>;

    /// n
    fn parameters(&self) -> usize;
    /// p
    fn rows(&self) -> usize;
    /// m
    fn targets(&self) -> usize;

    /// n zeros
    fn vector(&self) -> Self::Vector;
    /// U = I
    fn packed(&self) -> Self::Packed;
    /// n x n zeros
    fn square(&self) -> Self::Square;
    /// p x n zeros
    fn regressors(&self) -> Self::Rows;
    /// p x p zeros
    fn noise(&self) -> Self::Noise;
    /// p x m zeros
    fn errors(&self) -> Self::Errors;
    /// m x n zeros
    fn theta(&self) -> Self::Parameters;
    /// zeros for the kernels to work with
    fn scratch(&self) -> Self::Scratch;
    /// at least `length` zeros, at most [`Memory::longest_list`]
    fn list(&self, length: usize) -> Self::List;
    /// the most numbers that a list can hold
    fn longest_list(&self) -> usize;
}

/// `B` blocks of `A` numbers on the stack.
#[derive(Clone, Copy, Debug)]
pub struct Grid<T, const A: usize, const B: usize>([[T; A]; B]);

impl<T, const A: usize, const B: usize> AsRef<[T]> for Grid<T, A, B> {
    #[inline(always)]
    fn as_ref(&self) -> &[T] {
        self.0.as_flattened()
    }
}

impl<T, const A: usize, const B: usize> AsMut<[T]> for Grid<T, A, B> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [T] {
        self.0.as_flattened_mut()
    }
}

/// A number of parameters for which the packed triangle has a type (1 to 32).
pub trait Packed<T> {
    /// [`most`] of n numbers
    type Triangle: Buffer<T>;
    /// [`scratch`] of n numbers
    type Scratch: Buffer<T>;
    /// U = I
    fn triangle() -> Self::Triangle;
    /// Zeros.
    fn scratch() -> Self::Scratch;
}

/// The size `N` as a type.
#[derive(Clone, Copy, Debug)]
pub struct Size<const N: usize>;

macro_rules! packed {
    ($($n:literal)*) => {$(
        impl<T: Real> Packed<T> for Size<$n> {
            type Triangle = [T; most($n)];
            type Scratch = [T; scratch($n)];
            fn triangle() -> Self::Triangle {
                let mut triangle = [T::ZERO; most($n)];
                set_identity(&mut triangle, $n);
                triangle
            }
            fn scratch() -> Self::Scratch {
                [T::ZERO; scratch($n)]
            }
        }
    )*};
}
packed!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32);

/// Sizes known to the compiler: `N` parameters (1 to 32), `P` rows, `M` targets; no heap.
///
/// `L` is the room for lists: a rate that looks back over a window needs as many numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fixed<T, const N: usize, const P: usize = 1, const M: usize = 1, const L: usize = 0>(
    PhantomData<T>,
);

impl<T, const N: usize, const P: usize, const M: usize, const L: usize> Fixed<T, N, P, M, L> {
    /// These sizes.
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<T: Real, const N: usize, const P: usize, const M: usize, const L: usize> Memory
    for Fixed<T, N, P, M, L>
where
    Size<N>: Packed<T>,
{
    type Real = T;
    type Vector = [T; N];
    type Packed = <Size<N> as Packed<T>>::Triangle;
    type Square = Grid<T, N, N>;
    type Rows = Grid<T, N, P>;
    type Noise = Grid<T, P, P>;
    type Errors = Grid<T, M, P>;
    type Parameters = Grid<T, N, M>;
    type Scratch = <Size<N> as Packed<T>>::Scratch;
    type List = [T; L];

    #[inline(always)]
    fn parameters(&self) -> usize {
        N
    }
    #[inline(always)]
    fn rows(&self) -> usize {
        P
    }
    #[inline(always)]
    fn targets(&self) -> usize {
        M
    }
    fn vector(&self) -> [T; N] {
        [T::ZERO; N]
    }
    fn packed(&self) -> Self::Packed {
        Size::<N>::triangle()
    }
    fn square(&self) -> Self::Square {
        Grid([[T::ZERO; N]; N])
    }
    fn regressors(&self) -> Self::Rows {
        Grid([[T::ZERO; N]; P])
    }
    fn noise(&self) -> Self::Noise {
        Grid([[T::ZERO; P]; P])
    }
    fn errors(&self) -> Self::Errors {
        Grid([[T::ZERO; M]; P])
    }
    fn theta(&self) -> Self::Parameters {
        Grid([[T::ZERO; N]; M])
    }
    fn scratch(&self) -> Self::Scratch {
        <Size<N> as Packed<T>>::scratch()
    }
    fn list(&self, _: usize) -> [T; L] {
        [T::ZERO; L]
    }
    fn longest_list(&self) -> usize {
        L
    }
}

#[cfg(feature = "alloc")]
pub use dynamic::{Aligned, Dynamic};

#[cfg(feature = "alloc")]
mod dynamic {
    use super::{scratch, set_identity, Memory, PhantomData};
    use crate::factor::kernel::capacity;
    use crate::{Error, Real};
    use alloc::{vec, vec::Vec};

    /// Sizes chosen when the estimator is made; its buffers are on the heap.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Dynamic<T> {
        parameters: usize,
        rows: usize,
        targets: usize,
        real: PhantomData<T>,
    }

    impl<T: Real> Dynamic<T> {
        /// The most numbers that a list can hold.
        pub const LONGEST_LIST: usize = 1 << 20;

        /// `parameters` n, `rows` p and `targets` m, each from 1 to 2¹⁵.
        ///
        /// # Errors
        /// [`Error::Value`] names the size that is out of range.
        pub fn new(parameters: usize, rows: usize, targets: usize) -> Result<Self, Error> {
            let sizes = [("parameters", parameters), ("rows", rows), ("targets", targets)];
            for (name, size) in sizes {
                if !(1..=1 << 15).contains(&size) {
                    return Err(Error::value(name, size as f64, "whole numbers from 1 to 32768"));
                }
            }
            Ok(Self { parameters, rows, targets, real: PhantomData })
        }
    }

    /// Numbers on the heap, the first of them at the start of a cache line: a vector that lies
    /// across two lines costs twice.
    #[derive(Debug)]
    pub struct Aligned<T> {
        numbers: Vec<T>,
        first: usize,
        length: usize,
    }

    impl<T: Real> Aligned<T> {
        const LINE: usize = 64;

        fn zeros(length: usize) -> Self {
            let spare = Self::LINE / T::BYTES;
            let numbers = vec![T::ZERO; length + spare];
            let first = numbers.as_ptr().align_offset(Self::LINE).min(spare);
            Self { numbers, first, length }
        }
    }

    impl<T: Real> Clone for Aligned<T> {
        fn clone(&self) -> Self {
            let mut copy = Self::zeros(self.length);
            copy.as_mut().copy_from_slice(self.as_ref());
            copy
        }
    }

    impl<T> AsRef<[T]> for Aligned<T> {
        #[inline(always)]
        fn as_ref(&self) -> &[T] {
            &self.numbers[self.first..self.first + self.length]
        }
    }

    impl<T> core::ops::Deref for Aligned<T> {
        type Target = [T];
        #[inline(always)]
        fn deref(&self) -> &[T] {
            self.as_ref()
        }
    }

    impl<T> AsMut<[T]> for Aligned<T> {
        #[inline(always)]
        fn as_mut(&mut self) -> &mut [T] {
            &mut self.numbers[self.first..self.first + self.length]
        }
    }

    impl<T: Real> Memory for Dynamic<T> {
        type Real = T;
        type Vector = Aligned<T>;
        type Packed = Aligned<T>;
        type Square = Aligned<T>;
        type Rows = Aligned<T>;
        type Noise = Aligned<T>;
        type Errors = Aligned<T>;
        type Parameters = Aligned<T>;
        type Scratch = Aligned<T>;
        type List = Aligned<T>;

        #[inline(always)]
        fn parameters(&self) -> usize {
            self.parameters
        }
        #[inline(always)]
        fn rows(&self) -> usize {
            self.rows
        }
        #[inline(always)]
        fn targets(&self) -> usize {
            self.targets
        }
        fn vector(&self) -> Aligned<T> {
            Aligned::zeros(self.parameters)
        }
        fn packed(&self) -> Aligned<T> {
            let mut columns = Aligned::zeros(capacity::<T>(self.parameters));
            set_identity(columns.as_mut(), self.parameters);
            columns
        }
        fn square(&self) -> Aligned<T> {
            Aligned::zeros(self.parameters * self.parameters)
        }
        fn regressors(&self) -> Aligned<T> {
            Aligned::zeros(self.rows * self.parameters)
        }
        fn noise(&self) -> Aligned<T> {
            Aligned::zeros(self.rows * self.rows)
        }
        fn errors(&self) -> Aligned<T> {
            Aligned::zeros(self.rows * self.targets)
        }
        fn theta(&self) -> Aligned<T> {
            Aligned::zeros(self.targets * self.parameters)
        }
        fn scratch(&self) -> Aligned<T> {
            Aligned::zeros(scratch(self.parameters))
        }
        fn list(&self, length: usize) -> Aligned<T> {
            Aligned::zeros(length.min(Self::LONGEST_LIST))
        }
        fn longest_list(&self) -> usize {
            Self::LONGEST_LIST
        }
    }
}
