//! Where an estimator keeps its numbers: on the stack, of a size known to the compiler
//! ([`Fixed`]) or up to one ([`UpTo`]), or on the heap, of a size known when it is made
//! ([`Dynamic`]).
//!
//! The algorithms see slices only, so that both give the same bits.

use crate::error::Error;
use core::fmt::Debug;
use forgetting_kernels::Kernels;

#[cfg(feature = "alloc")]
mod dynamic;
mod fixed;
pub mod state;
mod up_to;

#[cfg(feature = "alloc")]
pub use dynamic::{zeros, Aligned, Dynamic};
pub use fixed::{Fixed, Grid, Packed, Size};
pub use up_to::{Part, UpTo};

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
    type Real: Kernels;
    /// n numbers
    type Vector: Buffer<Self::Real>;
    /// the columns of U: at least [`capacity`](forgetting_kernels::kernel::layout::capacity) of n numbers
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
    /// numbers that not every estimator has; none on the stack
    type Optional: Buffer<Self::Real>;

    /// n
    fn parameters(&self) -> usize;
    /// p
    fn rows(&self) -> usize;
    /// m
    fn targets(&self) -> usize;

    /// Memory for these sizes.
    ///
    /// # Errors
    /// [`Error`] names a size that is not one of this memory.
    fn of_sizes(parameters: usize, rows: usize, targets: usize) -> Result<Self, Error>;
    /// Refuses sizes for which there is no memory, before any is taken: for `count` estimators that
    /// keep `squares` times n x n numbers beside P.
    ///
    /// # Errors
    /// [`Error::Memory`].
    fn check_room(&self, squares: usize, count: usize) -> Result<(), Error> {
        let _ = (squares, count);
        Ok(())
    }

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
    /// `length` zeros, or none where there is no room for such numbers
    fn optional(&self, length: usize) -> Self::Optional;
    /// the most numbers that a list can hold
    fn longest_list(&self) -> usize;
}
