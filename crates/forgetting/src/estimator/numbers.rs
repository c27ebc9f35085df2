//! The state of an estimator as one list of numbers.

use super::AnyEstimator;
use crate::memory::state::Visitor;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// The numbers of an estimator, in the order of [`Estimator::visit`](super::Estimator::visit).
pub(crate) struct Numbers<T> {
    pub numbers: Vec<T>,
    pub counts: Vec<u64>,
    next: (usize, usize),
    give: bool,
}

impl<T: Kernels> Numbers<T> {
    /// These, in the order of an estimator.
    pub fn new(numbers: Vec<T>, counts: Vec<u64>) -> Self {
        Self { numbers, counts, next: (0, 0), give: false }
    }

    /// Those of `estimator`.
    pub fn of(estimator: &mut AnyEstimator<T>) -> Self {
        let mut own = Self::new(Vec::new(), Vec::new());
        estimator.visit(&mut own);
        own
    }

    /// Gives them to an estimator of the same kind, which has as many.
    pub fn give(self, estimator: &mut AnyEstimator<T>) {
        estimator.visit(&mut Self { next: (0, 0), give: true, ..self });
    }
}

impl<T: Kernels> Visitor<T> for Numbers<T> {
    fn reals(&mut self, values: &mut [T]) {
        if self.give {
            let first = self.next.0;
            values.copy_from_slice(&self.numbers[first..first + values.len()]);
            self.next.0 += values.len();
        } else {
            self.numbers.extend_from_slice(values);
        }
    }

    fn whole(&mut self, value: &mut u64) {
        if self.give {
            *value = self.counts[self.next.1];
            self.next.1 += 1;
        } else {
            self.counts.push(*value);
        }
    }
}
