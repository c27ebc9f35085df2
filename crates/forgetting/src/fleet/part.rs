//! Streams that take their samples together; several parts of a fleet can do so at once.

use super::storage::{Layout, Line};
use crate::factor::kernel::fleet::Advance;
use crate::factor::Form;
use crate::Real;

/// Samples of neighbouring streams: one each.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a, T> {
    /// n numbers a stream
    pub phi: &'a [T],
    /// one number a stream
    pub y: &'a [T],
    /// whether each stream has a sample; all have, without it
    pub mask: Option<&'a [bool]>,
}

/// What the streams told of their samples: a number each, or nothing where it is not asked for.
#[derive(Debug)]
pub struct Told<'a, T> {
    /// y − φθ with the θ of before; NaN where there was no sample or it was refused
    pub error: Option<&'a mut [T]>,
    /// φP̄φᵀ; NaN as above
    pub leverage: Option<&'a mut [T]>,
    /// 0 where the sample was used, else the code of a [`Skip`](crate::Skip) or
    /// [`REFUSED`](super::REFUSED)
    pub skipped: Option<&'a mut [u8]>,
}

impl<'a, T> Samples<'a, T> {
    /// Those of the first `count` streams, of n parameters, and the others.
    pub fn split_at(self, count: usize, n: usize) -> (Self, Self) {
        let (phi, other_phi) = self.phi.split_at(count * n);
        let (y, other_y) = self.y.split_at(count);
        let (mask, other_mask) = self.mask.map(|mask| mask.split_at(count)).unzip();
        (Self { phi, y, mask }, Self { phi: other_phi, y: other_y, mask: other_mask })
    }
}

impl<'a, T> Told<'a, T> {
    /// That of the first `count` streams, and of the others.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let (error, other_error) = self.error.map(|error| error.split_at_mut(count)).unzip();
        let (leverage, other_leverage) = self.leverage.map(|all| all.split_at_mut(count)).unzip();
        let (skipped, other_skipped) = self.skipped.map(|all| all.split_at_mut(count)).unzip();
        let others = Self { error: other_error, leverage: other_leverage, skipped: other_skipped };
        (Self { error, leverage, skipped }, others)
    }
}

/// Neighbouring streams of a fleet: whole blocks, but for the last of all.
#[derive(Debug)]
pub struct Part<'a, T: Real> {
    pub(crate) count: usize,
    pub(crate) n: usize,
    pub(crate) form: Form<T>,
    /// what P is multiplied with, or (1 − λ)/λ: one line for all blocks or one each
    pub(crate) strengths: &'a [Line<T>],
    /// [`Layout::length`] lines a block
    pub(crate) lines: &'a mut [Line<T>],
    /// samples that the streams of each block could have used
    pub(crate) offered: &'a mut [u64],
    /// how many of them each stream has not used
    pub(crate) unused: &'a mut [u64],
    /// for many parameters
    pub(crate) scratch: &'a mut [Line<T>],
}

impl<T: Real> Part<'_, T> {
    /// How many streams there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Takes a sample for each stream; returns how many used it.
    ///
    /// A stream without a sample (by the mask, or with a NaN in it), or with one that it cannot
    /// use, stays as it was, bit for bit.
    ///
    /// # Panics
    /// Unless everything given has as many numbers as there are streams.
    pub fn update(&mut self, samples: Samples<'_, T>, told: &mut Told<'_, T>) -> usize {
        let fits = |length: Option<usize>| length.is_none_or(|length| length == self.count);
        assert!(
            samples.phi.len() == self.count * self.n
                && samples.y.len() == self.count
                && fits(samples.mask.map(<[bool]>::len))
                && fits(told.error.as_ref().map(|all| all.len()))
                && fits(told.leverage.as_ref().map(|all| all.len()))
                && fits(told.skipped.as_ref().map(|all| all.len())),
            "samples and results are one for each stream"
        );
        T::compute(Advance { part: self, samples, told })
    }
}

/// The parts of a fleet, one after the other.
#[derive(Debug)]
pub struct Parts<'a, T: Real> {
    pub(super) rest: Part<'a, T>,
    pub(super) blocks: usize,
    pub(super) scratch: usize,
}

impl<'a, T: Real> Iterator for Parts<'a, T> {
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
        Some(Part {
            count,
            n: rest.n,
            form: rest.form,
            strengths,
            lines: split_off_mut(&mut rest.lines, lines),
            offered: split_off_mut(&mut rest.offered, blocks),
            unused: split_off_mut(&mut rest.unused, count),
            scratch: split_off_mut(&mut rest.scratch, self.scratch),
        })
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
