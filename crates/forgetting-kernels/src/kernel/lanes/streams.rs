//! Neighbouring streams of a fleet, their samples, and where the results go.

use super::storage::Line;
use crate::kernel::form::Form;
use crate::number::Real;

/// The code of a stream that had no sample, or one with a NaN in it.
pub const MISSING: u8 = 2;
/// The code of a stream whose sample was in the dead zone.
pub const DEAD_ZONE: u8 = 1;
/// The code of a stream that refused its sample.
pub const REFUSED: u8 = u8::MAX;

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

/// Where the results of the streams go: a number each, or nothing where it is not asked for.
#[derive(Debug)]
pub struct Outputs<'a, T> {
    /// y − φθ with the θ of before; NaN where there was no sample or it was refused
    pub error: Option<&'a mut [T]>,
    /// φP̄φᵀ; NaN as above
    pub leverage: Option<&'a mut [T]>,
    /// 0 where the sample was used, else why it was not: [`DEAD_ZONE`], [`MISSING`] or [`REFUSED`]
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

impl<'a, T> Outputs<'a, T> {
    /// Those of the first `count` streams, and of the others.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let (error, other_error) = self.error.map(|error| error.split_at_mut(count)).unzip();
        let (leverage, other_leverage) = self.leverage.map(|all| all.split_at_mut(count)).unzip();
        let (skipped, other_skipped) = self.skipped.map(|all| all.split_at_mut(count)).unzip();
        let others = Self { error: other_error, leverage: other_leverage, skipped: other_skipped };
        (Self { error, leverage, skipped }, others)
    }
}

/// Neighbouring streams: whole blocks, but for the last of all.
#[derive(Debug)]
pub struct Streams<'a, T: Real> {
    /// how many there are
    pub count: usize,
    /// parameters of each
    pub n: usize,
    /// how they forget
    pub form: Form<T>,
    /// what P is multiplied with, (1 − λ)/λ or the noise of a walk: one line for all blocks or one each
    pub strengths: &'a [Line<T>],
    /// [`Layout::length`](super::storage::Layout::length) lines a block
    pub lines: &'a mut [Line<T>],
    /// samples that the streams of each block could have used
    pub offered: &'a mut [u64],
    /// how many of them each stream has not used
    pub unused: &'a mut [u64],
    /// those of the streams, if they follow the data: of at most ten parameters
    pub units: Option<Units<'a, T>>,
    /// [`SCRATCH`](super::SCRATCH) lines a parameter, for more than [`FEW`](crate::kernel::layout::FEW)
    pub scratch: &'a mut [Line<T>],
}

/// The units in which neighbouring streams measure their regressors.
#[derive(Debug)]
pub struct Units<'a, T: Real> {
    /// for each block n lines 1/s, n of Σ x² and n of how many x there were other than 0, with x = φ/s
    pub lines: &'a mut [Line<T>],
    /// how many of the samples offered each stream has not measured
    pub unmeasured: &'a mut [u64],
}
