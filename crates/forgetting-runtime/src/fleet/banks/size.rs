//! More streams that are banks, and such as start again.

use super::Banks;
use crate::estimator::GoOn;
use crate::fleet::pieces::each_stream;
use crate::fleet::threads::is_long;
use crate::number::Number;
use forgetting::Error;

/// How much more a number of the state costs here than in a sample.
const EFFORT: usize = 4;

impl<T: Number> Banks<T> {
    /// Adds `count` new streams.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none, and that of `go_on`; nothing has changed.
    pub fn grow(&mut self, count: usize, go_on: GoOn<'_>) -> Result<(), Error> {
        self.reserve(count)?;
        self.all_or_none(count, go_on, |banks, _| {
            banks.numbers.extend_from_slice(&banks.start.0);
            banks.counts.extend_from_slice(&banks.start.1);
        })
    }

    /// Adds copies of the streams of `others`.
    ///
    /// # Errors
    /// Those of [`Banks::check_kind`], [`Error::Memory`], and that of `go_on`; nothing has changed.
    pub fn append(&mut self, others: &Self, go_on: GoOn<'_>) -> Result<(), Error> {
        self.check_kind(&others.fresh)?;
        self.reserve(others.count)?;
        self.all_or_none(others.count, go_on, |banks, i| {
            let (numbers, counts) = others.state(i);
            banks.numbers.extend_from_slice(numbers);
            banks.counts.extend_from_slice(counts);
        })
    }

    /// A copy of all.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for it, and that of `go_on`.
    pub fn copy(&self, go_on: GoOn<'_>) -> Result<Self, Error> {
        let mut copy = Self::of(self.fresh.clone())?;
        copy.append(self, go_on)?;
        Ok(copy)
    }

    /// Starts again the streams that `mask` names, or all. Where that may take long, and there is memory
    /// for it, it is done with a copy.
    ///
    /// # Errors
    /// That of `go_on`; nothing has changed.
    pub fn reset(&mut self, mask: Option<&[bool]>, go_on: GoOn<'_>) -> Result<(), Error> {
        if !is_long(self.numbers.len() * EFFORT) {
            return self.start_again(mask, &mut || Ok(()));
        }
        match self.copy(go_on) {
            Ok(mut copy) => {
                copy.start_again(mask, go_on)?;
                *self = copy;
                Ok(())
            }
            Err(Error::Memory) => self.start_again(mask, &mut || Ok(())),
            Err(error) => Err(error),
        }
    }

    fn start_again(&mut self, mask: Option<&[bool]>, go_on: GoOn<'_>) -> Result<(), Error> {
        each_stream(self.count, self.parameters(), go_on, |i| {
            if mask.is_none_or(|mask| mask[i]) {
                let (numbers, counts) = self.widths();
                let own = |width: usize| i * width..(i + 1) * width;
                self.numbers[own(numbers)].copy_from_slice(&self.start.0);
                self.counts[own(counts)].copy_from_slice(&self.start.1);
            }
            Ok(())
        })
    }

    /// Makes room for `count` more.
    fn reserve(&mut self, count: usize) -> Result<(), Error> {
        let (numbers, counts) = self.widths();
        let room = |width: usize| count.checked_mul(width).ok_or(Error::Memory);
        self.numbers.try_reserve(room(numbers)?).map_err(|_| Error::Memory)?;
        self.counts.try_reserve(room(counts)?).map_err(|_| Error::Memory)
    }

    /// Lets `add` add `count` streams, one after the other.
    fn all_or_none(
        &mut self,
        count: usize,
        go_on: GoOn<'_>,
        mut add: impl FnMut(&mut Self, usize),
    ) -> Result<(), Error> {
        let before = (self.numbers.len(), self.counts.len());
        // a stream has the numbers of several estimators
        let added = each_stream(count, 16 * self.parameters(), go_on, |i| {
            add(self, i);
            Ok(())
        });
        match added {
            Ok(()) => self.count += count,
            Err(_) => {
                self.numbers.truncate(before.0);
                self.counts.truncate(before.1);
            }
        }
        added
    }
}
