//! Streams that are a bank each.
//!
//! A bank is some ten kilobytes with its members, what they are made of and its buffers. Of a stream
//! the numbers of the state alone are kept; to take a sample they are loaded into a bank that works for
//! many streams, and stored again.

mod health;
mod kind;
mod size;
mod update;

use super::numbers::{load, sizes, store};
use super::pieces::{each_stream, room};
use crate::estimator::GoOn;
use crate::number::Number;
use forgetting::bank::Bank;
use forgetting::{Error, Memory};
use kind::check_stream;

/// Streams that are banks of the same members, mixer and prior.
#[derive(Clone)]
pub struct Banks<T: Number> {
    /// what a new stream starts as
    fresh: Bank<T>,
    /// what all are made of
    configuration: Vec<u8>,
    /// the numbers and counts of the state of a new stream
    start: (Vec<T>, Vec<u64>),
    count: usize,
    /// the numbers of all streams, one after the other
    numbers: Vec<T>,
    counts: Vec<u64>,
    /// they take the samples: one for each part of the streams that is updated by itself
    workers: Vec<Bank<T>>,
}

impl<T: Number> Banks<T> {
    /// No streams yet, of banks like `fresh`.
    ///
    /// # Errors
    /// Those of [`check_stream`].
    pub fn of(mut fresh: Bank<T>) -> Result<Self, Error> {
        check_stream(&fresh)?;
        let configuration = fresh.configuration()?;
        fresh.reset();
        let (numbers, counts) = sizes(&mut fresh);
        let mut start = (vec![T::ZERO; numbers], vec![0; counts]);
        store(&mut fresh, (&mut start.0, &mut start.1));
        let (numbers, counts, workers) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { fresh, configuration, start, count: 0, numbers, counts, workers })
    }

    /// What a new stream starts as.
    pub fn fresh(&self) -> &Bank<T> {
        &self.fresh
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// n
    pub fn parameters(&self) -> usize {
        self.fresh.memory().parameters()
    }

    /// How many numbers and counts a stream has.
    fn widths(&self) -> (usize, usize) {
        (self.start.0.len(), self.start.1.len())
    }

    /// The numbers and counts of a stream.
    fn state(&self, index: usize) -> (&[T], &[u64]) {
        let (numbers, counts) = self.widths();
        let own = |width: usize| index * width..(index + 1) * width;
        (&self.numbers[own(numbers)], &self.counts[own(counts)])
    }

    fn state_mut(&mut self, index: usize) -> (&mut [T], &mut [u64]) {
        let (numbers, counts) = self.widths();
        let own = |width: usize| index * width..(index + 1) * width;
        (&mut self.numbers[own(numbers)], &mut self.counts[own(counts)])
    }

    /// A copy of the stream at `index`.
    pub fn get(&self, index: usize) -> Bank<T> {
        let mut bank = self.fresh.clone();
        load(&mut bank, self.state(index));
        bank
    }

    /// Puts `bank` in the place of the stream at `index`.
    ///
    /// # Errors
    /// Those of [`Banks::check_kind`]; nothing has changed.
    pub fn put(&mut self, index: usize, mut bank: Bank<T>) -> Result<(), Error> {
        self.check_kind(&bank)?;
        store(&mut bank, self.state_mut(index));
        Ok(())
    }

    /// Shows every stream, one after the other, until that fails or `go_on` says no.
    fn try_each(
        &self,
        go_on: GoOn<'_>,
        mut show: impl FnMut(usize, &Bank<T>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut bank = self.fresh.clone();
        each_stream(self.count, self.parameters(), go_on, |i| {
            load(&mut bank, self.state(i));
            show(i, &bank)
        })
    }

    /// θ of each stream, n numbers after n numbers.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn theta(&self, go_on: GoOn<'_>) -> Result<Vec<T>, Error> {
        let mut theta = room(self.count, self.parameters())?;
        self.try_each(go_on, |_, bank| {
            theta.extend_from_slice(bank.theta());
            Ok(())
        })?;
        Ok(theta)
    }

    /// The diagonal of P of each stream, n numbers after n numbers.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn variance(&self, go_on: GoOn<'_>) -> Result<Vec<T>, Error> {
        let n = self.parameters();
        let mut variances = room(self.count, n)?;
        self.try_each(go_on, |i, bank| {
            variances.resize((i + 1) * n, T::ZERO);
            bank.variances(&mut variances[i * n..]);
            Ok(())
        })?;
        Ok(variances)
    }

    /// Samples used by each stream since its start.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn samples(&self, go_on: GoOn<'_>) -> Result<Vec<i64>, Error> {
        let mut samples = room(self.count, 1)?;
        self.try_each(go_on, |_, bank| {
            samples.push(bank.samples() as i64);
            Ok(())
        })?;
        Ok(samples)
    }

    /// None: members of a bank forget each in its way.
    pub fn forgetting_factor(&self) -> Result<Option<Vec<T>>, Error> {
        Ok(None)
    }
}
