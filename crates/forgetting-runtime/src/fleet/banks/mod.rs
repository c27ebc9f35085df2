//! Streams that are a bank each.
//!
//! A bank is some ten kilobytes with its members, what they are made of and its buffers. Of a stream
//! the numbers of the state alone are kept; to take a sample they are loaded into a bank that works for
//! many streams, and stored again.

mod health;
mod kind;
mod update;

use super::numbers::{load, sizes, store};
use crate::number::Number;
use forgetting::bank::Bank;
use forgetting::{Error, Memory};
use kind::check_stream;
use std::convert::Infallible;

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

    /// Adds `count` new streams.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none; nothing has changed.
    pub fn grow(&mut self, count: usize) -> Result<(), Error> {
        self.reserve(count)?;
        for _ in 0..count {
            self.numbers.extend_from_slice(&self.start.0);
            self.counts.extend_from_slice(&self.start.1);
        }
        self.count += count;
        Ok(())
    }

    /// Adds copies of the streams of `others`.
    ///
    /// # Errors
    /// Those of [`Banks::check_kind`], and [`Error::Memory`]; nothing has changed.
    pub fn append(&mut self, others: &Self) -> Result<(), Error> {
        self.check_kind(&others.fresh)?;
        self.reserve(others.count)?;
        self.numbers.extend_from_slice(&others.numbers);
        self.counts.extend_from_slice(&others.counts);
        self.count += others.count;
        Ok(())
    }

    /// Makes room for `count` more.
    fn reserve(&mut self, count: usize) -> Result<(), Error> {
        let (numbers, counts) = self.widths();
        let room = |width: usize| count.checked_mul(width).ok_or(Error::Memory);
        self.numbers.try_reserve(room(numbers)?).map_err(|_| Error::Memory)?;
        self.counts.try_reserve(room(counts)?).map_err(|_| Error::Memory)
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

    /// Starts again the streams that `mask` names, or all.
    pub fn reset(&mut self, mask: Option<&[bool]>) {
        for i in (0..self.count).filter(|&i| mask.is_none_or(|mask| mask[i])) {
            let (numbers, counts) = self.widths();
            let own = |width: usize| i * width..(i + 1) * width;
            self.numbers[own(numbers)].copy_from_slice(&self.start.0);
            self.counts[own(counts)].copy_from_slice(&self.start.1);
        }
    }

    /// Shows every stream, one after the other.
    fn each(&self, mut show: impl FnMut(usize, &Bank<T>)) {
        let Ok(()) = self.try_each(|i, bank| {
            show(i, bank);
            Ok::<(), Infallible>(())
        });
    }

    /// The same, until that fails.
    fn try_each<E>(&self, mut show: impl FnMut(usize, &Bank<T>) -> Result<(), E>) -> Result<(), E> {
        let mut bank = self.fresh.clone();
        (0..self.count).try_for_each(|i| {
            load(&mut bank, self.state(i));
            show(i, &bank)
        })
    }

    /// θ of each stream, n numbers after n numbers.
    pub fn theta(&self) -> Vec<T> {
        let mut theta = Vec::with_capacity(self.count * self.parameters());
        self.each(|_, bank| theta.extend_from_slice(bank.theta()));
        theta
    }

    /// The diagonal of P of each stream, n numbers after n numbers.
    pub fn variance(&self) -> Vec<T> {
        let n = self.parameters();
        let mut variances = vec![T::ZERO; n * self.count];
        self.each(|i, bank| bank.variances(&mut variances[i * n..(i + 1) * n]));
        variances
    }

    /// Samples used by each stream since its start.
    pub fn samples(&self) -> Vec<i64> {
        let mut samples = Vec::with_capacity(self.count);
        self.each(|_, bank| samples.push(bank.samples() as i64));
        samples
    }

    /// None: members of a bank forget each in its way.
    pub fn forgetting_factor(&self) -> Option<Vec<T>> {
        None
    }
}
