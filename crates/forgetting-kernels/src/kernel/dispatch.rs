//! A loop as a value, and with which instructions it runs.

use crate::number::vector::Vector;
use crate::number::Real;

/// A loop over many numbers, as a value.
pub trait Kernel<T: Real> {
    /// what the loop returns
    type Output;
    /// How many parameters it is for.
    fn size(&self) -> usize;
    /// The loop, with vectors `V`, over at most `GROUP` columns of U at a time: as many as the
    /// registers hold. The result depends on neither. 8 columns and more are only for kernels of
    /// more than [`FEW`](crate::kernel::layout::FEW) parameters.
    fn run<V: Vector<T>, const GROUP: usize>(self) -> Self::Output;
}

/// With which instructions a number type runs its loops.
pub trait Dispatch<T: Real> {
    /// Runs `kernel`.
    fn run<K: Kernel<T>>(kernel: K) -> K::Output;
}

/// The instructions of the compiler's target.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl<T: Real> Dispatch<T> for Portable {
    // a function for each kernel: in one function they would compile for minutes
    #[inline(never)]
    fn run<K: Kernel<T>>(kernel: K) -> K::Output {
        kernel.run::<T::Lanes, 2>()
    }
}
