//! Neighbouring streams of a fleet, which are updated by themselves.

use super::numbers::{load_all, store_all};
use super::{estimators, Number};
use forgetting::fleet::{Before, Outputs, Part as Lanes, Samples};
use forgetting::{AnyEstimator, Error};

/// Some streams.
pub trait Part<T: Number>: Send {
    /// what they were before a sample
    type Before: Send;

    /// How many there are.
    fn count(&self) -> usize;

    /// Takes a sample for each stream; returns how many used it. See
    /// [`Part::update`](forgetting::fleet::Part::update).
    fn update(&mut self, samples: Samples<'_, T>, outputs: &mut Outputs<'_, T>) -> usize;

    /// What they are now.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for a copy.
    fn before(&mut self) -> Result<Self::Before, Error>;

    /// Makes them what they were, bit for bit.
    fn put_back(&mut self, before: &Self::Before);
}

impl<T: Number> Part<T> for Lanes<'_, T> {
    type Before = Before<T>;

    fn count(&self) -> usize {
        Lanes::count(self)
    }

    fn update(&mut self, samples: Samples<'_, T>, outputs: &mut Outputs<'_, T>) -> usize {
        Lanes::update(self, samples, outputs)
    }

    fn before(&mut self) -> Result<Before<T>, Error> {
        Lanes::before(self)
    }

    fn put_back(&mut self, before: &Before<T>) {
        Lanes::put_back(self, before);
    }
}

impl<T: Number> Part<T> for &mut [AnyEstimator<T>] {
    type Before = (Vec<T>, Vec<u64>);

    fn count(&self) -> usize {
        self.len()
    }

    fn update(&mut self, samples: Samples<'_, T>, outputs: &mut Outputs<'_, T>) -> usize {
        estimators::update(self, T::ONE, samples, outputs)
    }

    fn before(&mut self) -> Result<Self::Before, Error> {
        store_all(self)
    }

    fn put_back(&mut self, (numbers, counts): &Self::Before) {
        load_all(self, (numbers, counts));
    }
}
