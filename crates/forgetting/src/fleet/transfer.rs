//! Streams as estimators and back.

use super::{check_kind, extend, form_of, strength, Fleet, Line};
use crate::error::Error;
use crate::estimator::AnyEstimator;
use crate::memory::state::Visitor;
use crate::rates::Rate;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// The numbers of a stream, in the order of [`Estimator::visit`](crate::Estimator::visit).
pub struct Numbers<T> {
    pub numbers: Vec<T>,
    pub samples: u64,
    next: usize,
    give: bool,
}

impl<T: Kernels> Numbers<T> {
    /// Those of `estimator`.
    ///
    /// # Errors
    /// [`Error::Unsupported`] unless there are `length` of them.
    pub fn of(estimator: &mut AnyEstimator<T>, length: usize) -> Result<Self, Error> {
        let mut numbers = Self { numbers: Vec::new(), samples: 0, next: 0, give: false };
        estimator.visit(&mut numbers);
        if numbers.numbers.len() == length {
            return Ok(numbers);
        }
        Err(Error::Unsupported { reason: "a stream of this fleet has P and theta alone" })
    }

    /// These, to be given to an estimator that visits them.
    pub fn given(numbers: Vec<T>, samples: u64) -> Self {
        Self { numbers, samples, next: 0, give: true }
    }
}

impl<T: Kernels> Visitor<T> for Numbers<T> {
    fn reals(&mut self, values: &mut [T]) {
        if self.give {
            values.copy_from_slice(&self.numbers[self.next..self.next + values.len()]);
            self.next += values.len();
        } else {
            self.numbers.extend_from_slice(values);
        }
    }

    fn whole(&mut self, value: &mut u64) {
        if self.give {
            *value = self.samples;
        } else {
            self.samples = *value;
        }
    }
}

impl<T: Kernels> Fleet<T> {
    /// Puts `estimator` in the place of a stream.
    ///
    /// # Errors
    /// Those of [`check_kind`], [`Error::Memory`]; nothing has changed.
    ///
    /// # Panics
    /// If there is no such stream.
    pub fn put(&mut self, stream: usize, mut estimator: AnyEstimator<T>) -> Result<(), Error> {
        check_kind(&self.fresh, &estimator)?;
        let given = Numbers::of(&mut estimator, self.layout.length())?;
        self.set_factor(stream, &estimator)?;
        self.priors.put(stream, estimator.prior(), self.count)?;
        self.set(stream, given.numbers.into_iter(), given.samples);
        Ok(())
    }

    /// The λ of a stream.
    fn set_factor(&mut self, stream: usize, estimator: &AnyEstimator<T>) -> Result<(), Error> {
        let lambda = estimator.rate().constant().unwrap_or(T::ONE);
        if lambda == self.forgetting_factor(stream) {
            return Ok(());
        }
        let (factor, own) = (self.factor(), strength(self.form));
        extend(&mut self.factors, self.count, factor)?;
        extend(&mut self.strengths, self.offered.len(), Line::splat(own))?;
        self.factors[stream] = lambda;
        let form = form_of(estimator).unwrap_or(self.form);
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        self.strengths[block].set(lane, strength(form));
        Ok(())
    }

    /// Writes the state of a stream.
    fn set(&mut self, stream: usize, numbers: impl Iterator<Item = T>, samples: u64) {
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        let length = self.layout.length();
        let lines = &mut self.lines[block * length..(block + 1) * length];
        for (line, x) in lines.iter_mut().zip(numbers) {
            line.set(lane, x);
        }
        self.unused[stream] = self.offered[block].wrapping_sub(samples);
    }

    /// Starts the streams that `mask` names again from their priors, or all.
    pub fn reset(&mut self, mask: Option<&[bool]>) {
        let start = self.start.clone();
        for stream in 0..self.count {
            if mask.is_some_and(|mask| !mask[stream]) {
                continue;
            }
            if self.priors.is_common(stream) {
                self.set(stream, start.iter().copied(), 0);
            } else {
                let prior = self.priors.get(stream).clone();
                let mut estimator = self.like(self.forgetting_factor(stream), prior);
                let mut numbers = Numbers { numbers: Vec::new(), samples: 0, next: 0, give: false };
                estimator.visit(&mut numbers);
                self.set(stream, numbers.numbers.into_iter(), 0);
            }
        }
    }
}
