//! Numbers on the stack, of sizes known to the compiler.

use super::{Buffer, Memory, Part};
use crate::error::Error;
use core::marker::PhantomData;
use forgetting_kernels::kernel::compact::triangle;
use forgetting_kernels::kernel::layout::{most, set_identity, FEW};
use forgetting_kernels::kernel::scratch;
use forgetting_kernels::kernel::symmetric::most as most_symmetric;
use forgetting_kernels::{Kernels, Real};

/// `B` blocks of `A` numbers on the stack.
#[derive(Clone, Copy, Debug)]
pub struct Grid<T, const A: usize, const B: usize>([[T; A]; B]);

impl<T: Real, const A: usize, const B: usize> Grid<T, A, B> {
    /// All 0.
    pub(super) fn zeros() -> Self {
        Self([[T::ZERO; A]; B])
    }
}

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
    /// the numbers of U above its diagonal
    type Compact: Buffer<T>;
    /// [`symmetric::most`](forgetting_kernels::kernel::symmetric::most) of n numbers where n is more than
    /// [`FEW`], else none
    type Symmetric: Buffer<T>;
    /// U = I
    fn triangle() -> Self::Triangle;
    /// Zeros.
    fn scratch() -> Self::Scratch;
    /// Zeros: U = I.
    fn compact() -> Self::Compact;
    /// Zeros.
    fn symmetric() -> Self::Symmetric;
}

/// The size `N` as a type.
#[derive(Clone, Copy, Debug)]
pub struct Size<const N: usize>;

/// How many numbers a symmetric matrix beside P takes.
const fn symmetric(n: usize) -> usize {
    if n > FEW {
        most_symmetric(n)
    } else {
        0
    }
}

macro_rules! packed {
    ($($n:literal)*) => {$(
        impl<T: Real> Packed<T> for Size<$n> {
            type Triangle = [T; most($n)];
            type Scratch = [T; scratch($n)];
            type Compact = [T; triangle($n)];
            type Symmetric = [T; symmetric($n)];
            fn triangle() -> Self::Triangle {
                let mut triangle = [T::ZERO; most($n)];
                set_identity(&mut triangle, $n);
                triangle
            }
            fn scratch() -> Self::Scratch {
                [T::ZERO; scratch($n)]
            }
            fn compact() -> Self::Compact {
                [T::ZERO; triangle($n)]
            }
            fn symmetric() -> Self::Symmetric {
                [T::ZERO; symmetric($n)]
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

impl<T: Kernels, const N: usize, const P: usize, const M: usize, const L: usize> Memory
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
    type Optional = Part<<Size<N> as Packed<T>>::Symmetric>;

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
    fn of_sizes(parameters: usize, rows: usize, targets: usize) -> Result<Self, Error> {
        Error::check_length("parameters", parameters, N)?;
        Error::check_length("rows", rows, P)?;
        Error::check_length("targets", targets, M)?;
        Ok(Self::new())
    }
    fn vector(&self) -> [T; N] {
        [T::ZERO; N]
    }
    fn packed(&self) -> Self::Packed {
        Size::<N>::triangle()
    }
    fn square(&self) -> Self::Square {
        Grid::zeros()
    }
    fn regressors(&self) -> Self::Rows {
        Grid::zeros()
    }
    fn noise(&self) -> Self::Noise {
        Grid::zeros()
    }
    fn errors(&self) -> Self::Errors {
        Grid::zeros()
    }
    fn theta(&self) -> Self::Parameters {
        Grid::zeros()
    }
    fn scratch(&self) -> Self::Scratch {
        <Size<N> as Packed<T>>::scratch()
    }
    fn list(&self, _: usize) -> [T; L] {
        [T::ZERO; L]
    }
    fn optional(&self, length: usize) -> Self::Optional {
        Part::new(Size::<N>::symmetric(), length)
    }
    fn longest_list(&self) -> usize {
        L
    }
}
