//! Where the numbers of the streams are kept.
//!
//! Streams are taken in blocks of as many as a vector has lanes. Each number of the state is one
//! vector for the block, with a stream in each lane, and the vectors of a block follow each other
//! in memory in the order in which an estimator shows them to be saved:
//!
//! ```text
//! U above its diagonal, by columns | D | bound of P's trace | θ
//! n (n − 1)/2                        n   1                    n
//! ```
//!
//! Where something is added to P later, it lies between D and the bound.

use crate::number::Real;

/// The numbers of a vector, at the start of a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Line<T: Real>(pub T::Chunk);

impl<T: Real> Line<T> {
    /// How many streams a block has.
    pub const LANES: usize = 64 / T::BYTES;

    /// `x` in every lane.
    #[inline(always)]
    pub fn splat(x: T) -> Self {
        Self(T::chunks(&[x; 16]).0[0])
    }

    /// The number in a lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> T {
        self.0.as_ref()[lane]
    }

    #[inline(always)]
    /// Puts a number into a lane.
    pub fn set(&mut self, lane: usize, x: T) {
        self.0.as_mut()[lane] = x;
    }
}

/// Where the numbers of a stream of n parameters are.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    n: usize,
    deferred: usize,
}

impl Layout {
    /// Of n parameters.
    #[inline(always)]
    pub const fn new(n: usize) -> Self {
        Self { n, deferred: 0 }
    }

    /// The same beside a symmetric matrix: its upper triangle row by row, and a common factor.
    #[inline(always)]
    pub const fn with_deferred(n: usize) -> Self {
        Self { n, deferred: n * (n + 1) / 2 + 1 }
    }

    /// How many numbers the matrix takes.
    #[inline(always)]
    pub const fn deferred(self) -> usize {
        self.deferred
    }

    /// How many numbers there are.
    #[inline(always)]
    pub const fn length(self) -> usize {
        self.theta() + self.n
    }

    /// Column j of U above its diagonal.
    #[inline(always)]
    pub const fn column(self, j: usize) -> usize {
        j * j.saturating_sub(1) / 2
    }

    /// D
    #[inline(always)]
    pub const fn diagonal(self) -> usize {
        self.column(self.n)
    }

    /// The bound of P's trace.
    #[inline(always)]
    pub const fn bound(self) -> usize {
        self.diagonal() + self.n + self.deferred
    }

    /// θ
    #[inline(always)]
    pub const fn theta(self) -> usize {
        self.bound() + 1
    }
}
