//! One sample for each of many streams, a stream in each lane of the vectors.
//!
//! The recursions are those of a single stream, from the same source; what a single stream
//! decides by a branch is decided here for each lane by a mask. A stream that does not use its
//! sample is written back as it was.

use super::layout::FEW;
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::{DeadZone, Form};
use crate::number::vector::{StreamVector, Vector};
use crate::number::Real;
use storage::{Layout, Line};
use streams::{Outputs, Samples, Streams, DEAD_ZONE, MISSING, REFUSED};

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

impl<T: Real> Kernel<T> for Advance<'_, '_, '_, T> {
    type Output = usize;

    /// Side by side, all streams are one large problem.
    #[inline(always)]
    fn size(&self) -> usize {
        Line::<T>::LANES * self.streams.n * self.streams.count
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> usize {
        let n = self.streams.n;
        if n <= FEW {
            with_few!(n, few::<T, V>(&mut self))
        } else {
            many::advance::<T, V::StreamVector>(&mut self)
        }
    }
}

/// How many blocks ahead memory is asked for one.
const AHEAD: usize = 2;

/// The streams of a part, for few parameters.
#[inline(always)]
fn few<T: Real, V: Vector<T>, const N: usize>(task: &mut Advance<'_, '_, '_, T>) -> usize {
    let Advance { streams: part, samples, outputs } = task;
    let (lanes, with_leverage) = (Line::<T>::LANES, outputs.leverage.is_some());
    let last = part.strengths.len() - 1;
    let length = Layout::new(N).length();
    let regressors = samples.phi.as_chunks::<N>().0.chunks(lanes);
    let (mut used, mut rest) = (0, &mut *part.lines);
    for (block, rows) in regressors.enumerate() {
        let (lines, later) = rest.split_at_mut(length);
        // a block is long: without this, memory waits until it is done
        if let Some(lines) = later.get((AHEAD - 1) * length..AHEAD * length) {
            for line in lines {
                V::StreamVector::prefetch(line);
            }
        }
        rest = later;
        let streams = block * lanes..block * lanes + rows.len();
        let strength = part.strengths[block.min(last)].0.as_ref();
        let y = rows::outputs(samples, streams.clone());
        let mut report = report::Report::new();
        for lane in (0..lanes).step_by(V::StreamVector::COUNT) {
            let mut phi = rows::columns(rows, lane);
            if let Some(units) = &mut part.units {
                let lines = &mut units.lines[block * 3 * N..(block + 1) * 3 * N];
                units::Block { lines, lane }.measure(&mut phi);
            }
            let state = few::State::<T, V::StreamVector, N>::of(lines, lane);
            let strength = V::StreamVector::read(&strength[lane..]);
            let y = V::StreamVector::read(&y.0.as_ref()[lane..]);
            let outcome = few::advance(state, (part.form, strength), (&phi, y), with_leverage);
            report.note(lane, &outcome);
            if let Some(units) = &mut part.units {
                let lines = &mut units.lines[block * 3 * N..(block + 1) * 3 * N];
                let mut units = units::Block { lines, lane };
                // once more, so that it need not be kept until now where there are no units
                let mut phi = rows::columns(rows, lane);
                units.measure(&mut phi);
                units.learn::<V::StreamVector, N>(&phi, outcome.codes);
            }
        }
        part.offered[block] += 1;
        if let Some(units) = &mut part.units {
            report.count_unmeasured(&mut units.unmeasured[streams.clone()]);
        }
        used += report.write(part.unused, outputs, streams);
    }
    used
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
