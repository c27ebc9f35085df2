//! The state of a bank as numbers and counts.

use forgetting::bank::Bank;
use forgetting::memory::state::Visitor;
use forgetting::{Kernels, Real};
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
