//! Several estimators that are given the same samples, one in each lane of the vectors: what they are, and where
//! their results go.

use crate::kernel::form::Form;
use crate::kernel::lanes::storage::Line;
use crate::number::vector::StreamVector;
use crate::number::Real;

/// Lets all of them take samples, until one cannot; returns how many samples they took.
pub struct Together<'a, T: Real> {
    /// how many estimators there are
    pub count: usize,
    /// how they forget, but for its strength: [`Form::Scale`] or [`Form::Walk`], of more than ten
    /// parameters the latter
    pub form: Form<T>,
    /// what P is multiplied with, or the noise of a walk: a line a block
    pub strengths: &'a [Line<T>],
    /// [`Layout::length`](super::storage::Layout::length) lines a block; with what is deferred, of more than ten parameters
    pub lines: &'a mut [Line<T>],
    /// n numbers a sample
    pub phi: &'a [T],
    /// one number a sample
    pub y: &'a [T],
    /// y − φθ of each with the θ of before: a number for each lane, sample after sample
    pub errors: &'a mut [T],
    /// φP̄φᵀ
    pub leverages: &'a mut [T],
    /// the largest element of D after it
    pub largest: &'a mut [T],
    /// θ of each after the sample, n lines a block; or empty
    pub thetas: &'a mut [Line<T>],
    /// n
    pub parameters: usize,
    /// [`SCRATCH`](super::SCRATCH)·n lines, for more than ten parameters
    pub scratch: &'a mut [Line<T>],
}

/// The first lane of each vector of a block that holds any of the `count` estimators.
#[inline(always)]
pub fn lanes<T: Real, A: StreamVector<T>>(
    count: usize,
    block: usize,
) -> core::iter::StepBy<core::ops::Range<usize>> {
    (0..(count - block * Line::<T>::LANES).min(Line::<T>::LANES)).step_by(A::COUNT)
}
