//! Streams that take their samples together; several parts of a fleet can do so at once.

use super::units::Following;
use crate::estimator::{AnyEstimator, Numbers};
use forgetting_kernels::kernel::lanes::storage::{Layout, Line};
use forgetting_kernels::kernel::lanes::streams::{Outputs, Samples, Streams, Units};
use forgetting_kernels::Kernels;

/// Neighbouring streams of a fleet: whole blocks, but for the last of all.
#[derive(Debug)]
pub struct Part<'a, T: Kernels> {
    pub(super) streams: Streams<'a, T>,
    /// if any stream follows the data
    pub(super) following: Option<Following<'a, T>>,
}

impl<T: Kernels> Part<'_, T> {
    /// How many streams there are.
    pub fn count(&self) -> usize {
        self.streams.count
    }

    /// Takes a sample for each stream; returns how many used it.
    ///
    /// A stream without a sample (by the mask, or with a NaN in it), or with one that it cannot
    /// use, stays as it was, bit for bit.
    ///
    /// # Panics
    /// Unless everything given has as many numbers as there are streams.
    pub fn update(&mut self, samples: Samples<'_, T>, outputs: &mut Outputs<'_, T>) -> usize {
        let fits = |length: Option<usize>| length.is_none_or(|length| length == self.streams.count);
        assert!(
            samples.phi.len() == self.streams.count * self.streams.n
                && samples.y.len() == self.streams.count
                && fits(samples.mask.map(<[bool]>::len))
                && fits(outputs.error.as_ref().map(|all| all.len()))
                && fits(outputs.leverage.as_ref().map(|all| all.len()))
                && fits(outputs.skipped.as_ref().map(|all| all.len())),
            "samples and results are one for each stream"
        );
        match self.following {
            None => T::advance_streams(&mut self.streams, samples, outputs),
            Some(_) => self.update_following(samples, outputs),
        }
    }

    /// A copy of a stream that follows the data, as an estimator.
    pub(super) fn get(&self, stream: usize) -> Option<AnyEstimator<T>> {
        let (following, units) = (self.following.as_ref()?, self.streams.units.as_ref()?);
        let mut estimator = following.starts.estimator(following.first + stream);
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        let (length, n) = (Layout::new(self.streams.n).length(), self.streams.n);
        let state = &self.streams.lines[block * length..(block + 1) * length];
        let units_of_block = &units.lines[3 * block * n..3 * (block + 1) * n];
        let numbers = state.iter().chain(units_of_block).map(|line| line.get(lane)).collect();
        let offered = self.streams.offered[block];
        let without = [self.streams.unused[stream], units.unmeasured[stream]];
        let counts = without.iter().map(|count| offered.wrapping_sub(*count)).collect();
        Numbers::new(numbers, counts).give(&mut estimator);
        Some(estimator)
    }

    /// Writes the state of a stream.
    pub(super) fn set(&mut self, stream: usize, given: &Numbers<T>) {
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        let (length, n) = (Layout::new(self.streams.n).length(), self.streams.n);
        let offered = self.streams.offered[block];
        let (state, own_units) = given.numbers.split_at(length);
        let lines = &mut self.streams.lines[block * length..(block + 1) * length];
        lines.iter_mut().zip(state).for_each(|(line, &x)| line.set(lane, x));
        self.streams.unused[stream] = offered.wrapping_sub(given.counts[0]);
        let (Some(units), Some(following)) = (&mut self.streams.units, &mut self.following) else {
            return;
        };
        let lines = &mut units.lines[3 * block * n..3 * (block + 1) * n];
        for (i, line) in lines.iter_mut().enumerate() {
            let none = if i < n { T::ONE } else { T::ZERO };
            line.set(lane, own_units.get(i).copied().unwrap_or(none));
        }
        let measured = given.counts.get(1).copied().unwrap_or_default();
        units.unmeasured[stream] = offered.wrapping_sub(measured);
        following.renewed[stream] = measured;
        following.due[block] = 0;
        following.settled[block] &= own_units.iter().skip(2 * n).all(|&count| count > T::ZERO);
    }
}

/// The parts of a fleet, one after the other.
#[derive(Debug)]
pub struct Parts<'a, T: Kernels> {
    pub(super) rest: Streams<'a, T>,
    pub(super) following: Option<Following<'a, T>>,
    pub(super) blocks: usize,
    pub(super) scratch: usize,
}

impl<'a, T: Kernels> Iterator for Parts<'a, T> {
    type Item = Part<'a, T>;

    fn next(&mut self) -> Option<Part<'a, T>> {
        let rest = &mut self.rest;
        if rest.count == 0 {
            return None;
        }
        let blocks = self.blocks.min(rest.offered.len());
        let count = rest.count.min(blocks * Line::<T>::LANES);
        let lines = blocks * Layout::new(rest.n).length();
        let each = rest.strengths.len().min(blocks);
        let strengths = match rest.strengths.len() {
            1 => rest.strengths,
            _ => split_off(&mut rest.strengths, each),
        };
        rest.count -= count;
        let units = rest.units.as_mut().map(|units| Units {
            lines: split_off_mut(&mut units.lines, blocks * 3 * rest.n),
            unmeasured: split_off_mut(&mut units.unmeasured, count),
        });
        let following = self.following.as_mut().map(|all| {
            let first = all.first;
            all.first += count;
            Following {
                starts: all.starts,
                first,
                renewed: split_off_mut(&mut all.renewed, count),
                settled: split_off_mut(&mut all.settled, blocks),
                due: split_off_mut(&mut all.due, blocks),
            }
        });
        let streams = Streams {
            count,
            n: rest.n,
            form: rest.form,
            strengths,
            lines: split_off_mut(&mut rest.lines, lines),
            offered: split_off_mut(&mut rest.offered, blocks),
            unused: split_off_mut(&mut rest.unused, count),
            units,
            scratch: split_off_mut(&mut rest.scratch, self.scratch),
        };
        Some(Part { streams, following })
    }
}

fn split_off<'a, X>(slice: &mut &'a [X], at: usize) -> &'a [X] {
    let (first, rest) = slice.split_at(at);
    *slice = rest;
    first
}

fn split_off_mut<'a, X>(slice: &mut &'a mut [X], at: usize) -> &'a mut [X] {
    let (first, rest) = core::mem::take(slice).split_at_mut(at);
    *slice = rest;
    first
}
