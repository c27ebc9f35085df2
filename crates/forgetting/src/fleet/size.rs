//! How many streams there are: new ones, copies of others, and fewer again.

use super::{check_kind, strength, Fleet, Line};
use crate::error::Error;
use alloc::vec::Vec;
use core::ops::Range;
use forgetting_kernels::Kernels;

impl<T: Kernels> Fleet<T> {
    /// Whether `count` more streams need no other place in memory, which would take as long as a copy of all.
    pub fn has_room(&self, count: usize) -> bool {
        let blocks = self.count.saturating_add(count).div_ceil(Line::<T>::LANES);
        let length = self.layout.length();
        blocks <= self.lines.capacity() / length
            && self.units.as_ref().is_none_or(|units| units.has_room(blocks))
    }

    /// Makes room for `count` more streams.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none; nothing has changed.
    pub fn reserve(&mut self, count: usize) -> Result<(), Error> {
        let streams = self.count.checked_add(count).ok_or(Error::Memory)?;
        let blocks = streams.div_ceil(Line::<T>::LANES);
        let lines = blocks.checked_mul(self.layout.length()).ok_or(Error::Memory)?;
        reserve(&mut self.lines, lines)?;
        reserve(&mut self.offered, blocks)?;
        reserve(&mut self.unused, streams)?;
        if let Some(units) = &mut self.units {
            units.reserve(blocks, streams)?;
        }
        if !self.factors.is_empty() {
            reserve(&mut self.factors, streams)?;
            reserve(&mut self.strengths, blocks)?;
        }
        self.priors.reserve(streams)
    }

    /// Adds `count` new streams after the last.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none; nothing has changed.
    pub fn grow(&mut self, count: usize) -> Result<(), Error> {
        self.reserve(count)?;
        let (streams, length) = (self.count + count, self.layout.length());
        let blocks = streams.div_ceil(Line::<T>::LANES);
        if !self.factors.is_empty() {
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
        self.lines.resize(blocks * length, Line::splat(T::ZERO));
        for lines in self.lines[old * length..].chunks_exact_mut(length) {
            for (line, &x) in lines.iter_mut().zip(&self.start) {
                *line = Line::splat(x);
            }
        }
        self.priors.grow(count);
        self.count = streams;
        Ok(())
    }

    /// Adds copies of those `streams` of `others`.
    ///
    /// # Errors
    /// Those of [`check_kind`], [`Error::Memory`]; nothing has changed.
    ///
    /// # Panics
    /// If there are no such streams.
    pub fn append(&mut self, others: &Self, streams: Range<usize>) -> Result<(), Error> {
        check_kind(&self.fresh, &others.fresh)?;
        let before = self.count;
        self.grow(streams.len())?;
        let alike = self.priors.are_common(&others.priors);
        let added = (before..).zip(streams).try_for_each(|(own, stream)| {
            let prior = others.priors.get(stream);
            let prior = if alike && others.priors.is_common(stream) { None } else { Some(prior) };
            let factor = (others.forgetting_factor(stream), others.strength(stream));
            self.place(own, &others.state(stream), factor, prior)
        });
        if added.is_err() {
            self.truncate(before);
        }
        added
    }

    /// Takes the last streams away, so that `count` are left.
    pub fn truncate(&mut self, count: usize) {
        if count >= self.count {
            return;
        }
        let blocks = count.div_ceil(Line::<T>::LANES);
        if let Some(units) = &mut self.units {
            let priors = (count..self.count).map(|stream| self.priors.get(stream));
            units.following -= priors.filter(|prior| prior.is_of_data()).count();
            units.truncate(blocks, count);
        }
        self.lines.truncate(blocks * self.layout.length());
        self.offered.truncate(blocks);
        self.unused.truncate(count);
        self.factors.truncate(count);
        let own = Line::splat(strength(self.form));
        match self.factors.is_empty() {
            true => self.strengths = Vec::from([own]),
            false => self.strengths.truncate(blocks),
        }
        self.priors.truncate(count);
        self.count = count;
        self.clear_lanes();
    }

    /// Makes the lanes of the last block that have no stream those of new ones.
    fn clear_lanes(&mut self) {
        let lanes = match self.count % Line::<T>::LANES {
            0 => return,
            first => first..Line::<T>::LANES,
        };
        let last = self.lines.len() - self.layout.length();
        let (lines, own) = (&mut self.lines[last..], strength(self.form));
        for lane in lanes {
            lines.iter_mut().zip(&self.start).for_each(|(line, &x)| line.set(lane, x));
            if let ([_, ..], Some(strengths)) = (&self.factors[..], self.strengths.last_mut()) {
                strengths.set(lane, own);
            }
            if let Some(units) = &mut self.units {
                units.clear(lane);
            }
        }
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
