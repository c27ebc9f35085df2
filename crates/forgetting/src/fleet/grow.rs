//! Room for more streams.

use super::{strength, Fleet};
use crate::error::Error;
use alloc::vec::Vec;
use forgetting_kernels::kernel::lanes::storage::Line;
use forgetting_kernels::Kernels;

impl<T: Kernels> Fleet<T> {
    /// Adds `count` streams after the last.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none; nothing has changed.
    pub fn grow(&mut self, count: usize) -> Result<(), Error> {
        let streams = self.count.checked_add(count).ok_or(Error::Memory)?;
        let blocks = streams.div_ceil(Line::<T>::LANES);
        let length = self.layout.length();
        let lines = blocks.checked_mul(length).ok_or(Error::Memory)?;
        reserve(&mut self.lines, lines)?;
        reserve(&mut self.offered, blocks)?;
        reserve(&mut self.unused, streams)?;
        if let Some(units) = &mut self.units {
            units.reserve(blocks, streams)?;
        }
        self.priors.reserve(streams)?;
        if !self.factors.is_empty() {
            reserve(&mut self.factors, streams)?;
            reserve(&mut self.strengths, blocks)?;
            self.factors.resize(streams, self.factor());
            self.strengths.resize(blocks, Line::splat(strength(self.form)));
        }
        self.offered.resize(blocks, 0);
        for stream in self.count..streams {
            // a new lane of the last block is offered what the others are
            self.unused.push(self.offered[stream / Line::<T>::LANES]);
        }
        if let Some(units) = &mut self.units {
            units.grow(&self.offered, streams);
            if self.fresh.prior().is_of_data() {
                units.following += count;
            }
        }
        let old = self.lines.len() / length;
        self.lines.resize(lines, Line::splat(T::ZERO));
        for lines in self.lines[old * length..].chunks_exact_mut(length) {
            for (line, &x) in lines.iter_mut().zip(&self.start) {
                *line = Line::splat(x);
            }
        }
        self.priors.grow(count);
        self.count = streams;
        Ok(())
    }
}

/// Room for `length` numbers in all.
pub(super) fn reserve<X>(numbers: &mut Vec<X>, length: usize) -> Result<(), Error> {
    let more = length.saturating_sub(numbers.len());
    numbers.try_reserve(more).map_err(|_| Error::Memory)
}

/// Makes them at least `length` numbers, each new one `x`.
pub(super) fn extend<X: Clone>(numbers: &mut Vec<X>, length: usize, x: X) -> Result<(), Error> {
    reserve(numbers, length)?;
    if numbers.len() < length {
        numbers.resize(length, x);
    }
    Ok(())
}
