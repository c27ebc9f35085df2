//! Streams that take their samples together; several parts of a fleet can do so at once.

use forgetting_kernels::kernel::lanes::storage::{Layout, Line};
use forgetting_kernels::kernel::lanes::streams::{Outputs, Samples, Streams};
use forgetting_kernels::Kernels;

/// Neighbouring streams of a fleet: whole blocks, but for the last of all.
#[derive(Debug)]
pub struct Part<'a, T: Kernels>(Streams<'a, T>);

impl<T: Kernels> Part<'_, T> {
    /// How many streams there are.
    pub fn count(&self) -> usize {
        self.0.count
    }

    /// Takes a sample for each stream; returns how many used it.
    ///
    /// A stream without a sample (by the mask, or with a NaN in it), or with one that it cannot
    /// use, stays as it was, bit for bit.
    ///
    /// # Panics
    /// Unless everything given has as many numbers as there are streams.
    pub fn update(&mut self, samples: Samples<'_, T>, outputs: &mut Outputs<'_, T>) -> usize {
        let fits = |length: Option<usize>| length.is_none_or(|length| length == self.0.count);
        assert!(
            samples.phi.len() == self.0.count * self.0.n
                && samples.y.len() == self.0.count
                && fits(samples.mask.map(<[bool]>::len))
                && fits(outputs.error.as_ref().map(|all| all.len()))
                && fits(outputs.leverage.as_ref().map(|all| all.len()))
                && fits(outputs.skipped.as_ref().map(|all| all.len())),
            "samples and results are one for each stream"
        );
        T::advance_streams(&mut self.0, samples, outputs)
    }
}

/// The parts of a fleet, one after the other.
#[derive(Debug)]
pub struct Parts<'a, T: Kernels> {
    pub(super) rest: Streams<'a, T>,
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
        Some(Part(Streams {
            count,
            n: rest.n,
            form: rest.form,
            strengths,
            lines: split_off_mut(&mut rest.lines, lines),
            offered: split_off_mut(&mut rest.offered, blocks),
            unused: split_off_mut(&mut rest.unused, count),
            scratch: split_off_mut(&mut rest.scratch, self.scratch),
        }))
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
