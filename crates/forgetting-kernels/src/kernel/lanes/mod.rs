//! One sample for each of many streams, a stream in each lane of the vectors.
//!
//! The recursions are those of a single stream, from the same source; what a single stream
//! decides by a branch is decided here for each lane by a mask. A stream that does not use its
//! sample is written back as it was.

use super::layout::FEW;
use crate::kernel::dispatch::Dispatch;
use crate::kernel::form::{DeadZone, Form, ALONG, SCALE, WALK};
use crate::number::vector::StreamVector;
use crate::number::Real;
use blocks::Few;
use many::Many;
use storage::Line;
use streams::{Outputs, Samples, Streams, DEAD_ZONE, MISSING, REFUSED};

mod blocks;
mod few;
mod many;
pub mod members;
mod predict;
mod report;
mod rows;
pub mod storage;
pub mod streams;
pub mod together;
mod units;

pub use many::SCRATCH;
pub use predict::Predict;

/// Takes the samples; returns how many were used.
pub struct Advance<'a, 's, 'o, T: Real> {
    /// what takes them
    pub streams: &'a mut Streams<'s, T>,
    /// one for each stream
    pub samples: Samples<'a, T>,
    /// where the results go
    pub outputs: &'a mut Outputs<'o, T>,
}

/// Takes the samples: a kernel for each form, and for each number of few parameters.
#[inline(always)]
pub fn advance<T: Real, D: Dispatch<T>>(task: Advance<'_, '_, '_, T>) -> usize {
    match task.streams.n {
        1..=FEW => with_few!(task.streams.n, few::<T, D>(task)),
        _ => match task.streams.form {
            Form::Scale { .. } => D::run(Many::<T, SCALE>(task)),
            Form::Along { .. } => D::run(Many::<T, ALONG>(task)),
            Form::Walk { .. } => unreachable!("a walk of streams is of few parameters"),
        },
    }
}

#[inline(always)]
fn few<T: Real, D: Dispatch<T>, const N: usize>(task: Advance<'_, '_, '_, T>) -> usize {
    match task.streams.form {
        Form::Scale { .. } => D::run(Few::<T, N, SCALE>(task)),
        Form::Along { .. } => D::run(Few::<T, N, ALONG>(task)),
        Form::Walk { .. } => D::run(Few::<T, N, WALK>(task)),
    }
}

impl<T: Real> Advance<'_, '_, '_, T> {
    /// Side by side, all streams are one large problem.
    #[inline(always)]
    fn size(&self) -> usize {
        Line::<T>::LANES * self.streams.n * self.streams.count
    }
}

/// What the samples of a few streams brought.
struct LaneOutcome<A> {
    error: A,
    leverage: A,
    /// the code of each stream; none if all used their samples
    codes: Option<A>,
}

/// What becomes of the sample of each stream.
struct Fate<T: Real, A: StreamVector<T>> {
    /// neither error nor ‖φ‖² is NaN or out of range
    accepted: A::Mask,
    /// ... and the sample is not in the dead zone
    used: A::Mask,
}

/// Where neither is NaN or out of range.
#[inline(always)]
fn accepts<T: Real, A: StreamVector<T>>(error: A, squares: A) -> A::Mask {
    let ceiling = A::splat(T::CEILING);
    A::both(error.abs().at_most(ceiling), squares.at_most(ceiling))
}

impl<T: Real> DeadZone<T> {
    /// Where a regressor with this ‖φ̄‖² is not in it.
    #[inline(always)]
    fn leaves<A: StreamVector<T>>(self, squares: A) -> A::Mask {
        match self {
            Self::Below(least) => A::splat(least).at_most(squares.sqrt()),
            Self::UpTo(most) => A::splat(most).less_than(squares.sqrt()),
        }
    }
}

/// A few streams, of which some may need a tighter bound of P's trace.
trait Trace<A> {
    /// The trace of P of each.
    fn trace(&self) -> A;
}

/// The bound of P's trace after growing so, and where there is no room for that, if anywhere: P is not
/// to grow there, and the bound stays.
#[inline(always)]
fn make_room<T: Real, A: StreamVector<T>>(
    bound: A,
    (growth, added): (A, A),
    streams: &impl Trace<A>,
) -> (A, Option<A::Mask>) {
    let ceiling = A::splat(T::CEILING);
    let next = bound * growth + added;
    let room = next.less_than(ceiling);
    if A::all(room) {
        return (next, None);
    }
    let next = A::select(room, next, streams.trace() * growth + added);
    let room = next.less_than(ceiling);
    (A::select(room, next, bound), Some(room))
}

/// In which lanes c·fᵀf is to be added: c > 0 and finite.
#[inline(always)]
fn adds<T: Real, A: StreamVector<T>>(c: A) -> A::Mask {
    A::both(A::splat(T::ZERO).less_than(c), c.less_than(A::splat(T::from_f64(f64::INFINITY))))
}
