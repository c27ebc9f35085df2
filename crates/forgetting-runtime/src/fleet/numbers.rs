//! The states of streams as numbers and counts.

use forgetting::bank::Bank;
use forgetting::memory::state::Visitor;
use forgetting::{AnyEstimator, Error, Kernels, Real};
use std::mem::take;

/// How many numbers and counts the state of `bank` has.
pub fn sizes<T: Kernels>(bank: &mut Bank<T>) -> (usize, usize) {
    let mut sizes = Sizes { numbers: 0, counts: 0 };
    bank.visit(&mut sizes);
    (sizes.numbers, sizes.counts)
}

/// Writes the state of `bank` to as many numbers and counts as it has.
pub fn store<T: Kernels>(bank: &mut Bank<T>, (numbers, counts): (&mut [T], &mut [u64])) {
    bank.visit(&mut Store { numbers, counts });
}

/// Gives `bank` the state that [`store`] wrote.
pub fn load<T: Kernels>(bank: &mut Bank<T>, (numbers, counts): (&[T], &[u64])) {
    bank.visit(&mut Load { numbers, counts });
}

/// The numbers and counts of the states of all `estimators`, one after the other.
///
/// # Errors
/// [`Error::Memory`] when there is none.
pub fn store_all<T: Kernels>(
    estimators: &mut [AnyEstimator<T>],
) -> Result<(Vec<T>, Vec<u64>), Error> {
    let mut sizes = Sizes { numbers: 0, counts: 0 };
    estimators.iter_mut().for_each(|estimator| estimator.visit(&mut sizes));
    let mut numbers = copies(T::ZERO, sizes.numbers)?;
    let mut counts = copies(0, sizes.counts)?;
    let mut store = Store { numbers: &mut numbers, counts: &mut counts };
    estimators.iter_mut().for_each(|estimator| estimator.visit(&mut store));
    Ok((numbers, counts))
}

/// Gives `estimators` the states that [`store_all`] wrote.
pub fn load_all<T: Kernels>(estimators: &mut [AnyEstimator<T>], (numbers, counts): (&[T], &[u64])) {
    let mut load = Load { numbers, counts };
    estimators.iter_mut().for_each(|estimator| estimator.visit(&mut load));
}

/// `count` times `x`.
fn copies<X: Clone>(x: X, count: usize) -> Result<Vec<X>, Error> {
    let mut copies = Vec::new();
    copies.try_reserve_exact(count).map_err(|_| Error::Memory)?;
    copies.resize(count, x);
    Ok(copies)
}

/// A copy of `numbers`.
///
/// # Errors
/// [`Error::Memory`] when there is none.
pub fn copy<X: Copy>(numbers: &[X]) -> Result<Vec<X>, Error> {
    let mut copy = Vec::new();
    copy.try_reserve_exact(numbers.len()).map_err(|_| Error::Memory)?;
    copy.extend_from_slice(numbers);
    Ok(copy)
}

struct Sizes {
    numbers: usize,
    counts: usize,
}

impl<T: Real> Visitor<T> for Sizes {
    fn reals(&mut self, values: &mut [T]) {
        self.numbers += values.len();
    }

    fn whole(&mut self, _: &mut u64) {
        self.counts += 1;
    }
}

struct Store<'a, T> {
    numbers: &'a mut [T],
    counts: &'a mut [u64],
}

impl<T: Real> Visitor<T> for Store<'_, T> {
    #[inline]
    fn reals(&mut self, values: &mut [T]) {
        let (own, rest) = take(&mut self.numbers).split_at_mut(values.len());
        own.copy_from_slice(values);
        self.numbers = rest;
    }

    #[inline]
    fn whole(&mut self, value: &mut u64) {
        let (own, rest) = take(&mut self.counts).split_at_mut(1);
        own[0] = *value;
        self.counts = rest;
    }
}

struct Load<'a, T> {
    numbers: &'a [T],
    counts: &'a [u64],
}

impl<T: Real> Visitor<T> for Load<'_, T> {
    #[inline]
    fn reals(&mut self, values: &mut [T]) {
        let (own, rest) = self.numbers.split_at(values.len());
        values.copy_from_slice(own);
        self.numbers = rest;
    }

    #[inline]
    fn whole(&mut self, value: &mut u64) {
        *value = self.counts[0];
        self.counts = &self.counts[1..];
    }
}
