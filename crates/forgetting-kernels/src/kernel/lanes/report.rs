//! What became of the samples of a few streams, written where it was asked for.

use super::{Fate, LaneOutcome, Line, Outputs, Real, StreamVector, DEAD_ZONE, MISSING, REFUSED};
use crate::number::copy_first;
use core::ops::Range;

/// The outcome where not every stream used its sample; `silent` is the leverage of those in the
/// dead zone.
#[inline(always)]
pub fn mixed<T: Real, A: StreamVector<T>>(
    fate: &Fate<T, A>,
    (y, squares): (A, A),
    all: LaneOutcome<A>,
    silent: A,
) -> LaneOutcome<A> {
    let nan = A::splat(T::from_f64(f64::NAN));
    let there = A::both(y.at_most(y), squares.at_most(squares));
    let refused = A::select(there, code(REFUSED), code(MISSING));
    LaneOutcome {
        error: fate.choose(all.error, all.error, nan),
        leverage: fate.choose(all.leverage, silent, nan),
        codes: Some(fate.choose(code(0), code(DEAD_ZONE), refused)),
    }
}

/// A code in every lane.
#[inline(always)]
fn code<T: Real, A: StreamVector<T>>(code: u8) -> A {
    A::splat(T::from_f64(f64::from(code)))
}

impl<T: Real, A: StreamVector<T>> Fate<T, A> {
    /// One of three for each stream: for those that used their samples, for those in the dead zone,
    /// and for all that are without one.
    #[inline(always)]
    fn choose(&self, used: A, dead: A, without: A) -> A {
        A::select(self.used, used, A::select(self.accepted, dead, without))
    }
}

/// The most streams of a block.
const MOST: usize = 16;

/// What a block of streams outputs.
pub struct Report<T: Real> {
    error: Line<T>,
    leverage: Line<T>,
    codes: Line<T>,
    /// whether all used their samples
    all: bool,
}

impl<T: Real> Report<T> {
    #[inline(always)]
    pub fn new() -> Self {
        let zeros = Line::splat(T::ZERO);
        Self { error: zeros, leverage: zeros, codes: zeros, all: true }
    }

    /// Takes note of what the streams from `lane` on outputs.
    #[inline(always)]
    pub fn note<A: StreamVector<T>>(&mut self, lane: usize, outcome: &LaneOutcome<A>) {
        outcome.error.write(&mut self.error.0.as_mut()[lane..]);
        outcome.leverage.write(&mut self.leverage.0.as_mut()[lane..]);
        if let Some(codes) = outcome.codes {
            codes.write(&mut self.codes.0.as_mut()[lane..]);
            self.all = false;
        }
    }

    /// Counts the samples that streams did not use.
    #[inline(always)]
    pub fn count_unmeasured(&self, unmeasured: &mut [u64]) {
        if self.all {
            return;
        }
        for (lane, unmeasured) in unmeasured.iter_mut().enumerate() {
            *unmeasured += u64::from(self.codes.get(lane) > T::ZERO);
        }
    }

    /// Writes it for these streams, of as many as there are lanes or the last of all; returns how
    /// many used their samples.
    #[inline(always)]
    pub fn write(
        &self,
        unused: &mut [u64],
        outputs: &mut Outputs<'_, T>,
        streams: Range<usize>,
    ) -> usize {
        if let Some(error) = &mut outputs.error {
            put(&mut error[streams.clone()], &self.error);
        }
        if let Some(leverage) = &mut outputs.leverage {
            put(&mut leverage[streams.clone()], &self.leverage);
        }
        let mut used = streams.len();
        if !self.all {
            for (lane, unused) in unused[streams.clone()].iter_mut().enumerate() {
                let not = u64::from(self.codes.get(lane) > T::ZERO);
                *unused += not;
                used -= not as usize;
            }
        }
        if let Some(skipped) = &mut outputs.skipped {
            let skipped = &mut skipped[streams];
            if self.all {
                copy_first(skipped, &[0; MOST]);
            } else {
                for (lane, code) in skipped.iter_mut().enumerate() {
                    *code = self.codes.get(lane).to_f64() as u8;
                }
            }
        }
        used
    }
}

/// Writes the first numbers of `line`.
#[inline(always)]
fn put<T: Real>(place: &mut [T], line: &Line<T>) {
    match T::chunks_mut(place).0 {
        // no loop and no call
        [chunk, ..] => *chunk = line.0,
        [] => copy_first(place, line.0.as_ref()),
    }
}
