//! What is known of a sample before it is used: all that a rate, a weighting or a gate may judge by.

use crate::gates::{Answer, AnyGate, Gate};
use crate::innovation::whiten_errors;
use crate::intake::{not_finite, out_of_range};
use crate::measure::leverage;
use crate::weighting::Weighting;
use crate::{Error, Factor, Memory, Real, Sample, Work};

/// What a rate, a weighting or a gate knows of a sample.
///
/// Errors are whitened by Γ. A weighting and a gate see them as they are. A rate sees them clipped, that
/// is multiplied by the weight w: an outlier that moves θ little is no reason to forget. No
/// statistic exceeds [`Real::CEILING`].
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a, 'b, M: Memory> {
    /// the whitened sample, weighted by √w; after the rule, as the rule left it
    pub sample: &'a Sample<'b, M>,
    /// P, before forgetting in `forgetting_factor`, after the measurement in `learn`
    pub factor: &'a Factor<M>,
    /// e, p x m numbers, row by row
    pub errors: &'a [M::Real],
    /// ‖e‖² over the rows, averaged over the targets
    pub squared_error: M::Real,
    /// tr S with S = φ̄Pφ̄ᵀ without the weight and the P before forgetting, if asked for, else 0
    pub leverage: M::Real,
    /// tr eᵀ(I + S)⁻¹e averaged over the targets, if asked for, else 0
    pub normalized_error: M::Real,
    /// p
    pub rows: usize,
    /// m
    pub targets: usize,
    /// samples used so far, without this one
    pub samples: u64,
}

impl<M: Memory> Evidence<'_, '_, M> {
    /// ‖e‖² over the rows, of the target where it is largest.
    #[inline]
    pub fn largest_squared_error(&self) -> M::Real {
        if self.targets == 1 {
            return self.squared_error;
        }
        let squared = |target: usize| {
            let errors = self.errors.iter().skip(target).step_by(self.targets);
            errors.fold(M::Real::ZERO, |sum, &e| sum + e * e)
        };
        (0..self.targets).fold(M::Real::ZERO, |largest, target| largest.max(squared(target)))
    }
}

/// What a design uses beside the errors; each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Needs {
    /// nothing
    Errors,
    /// [`Evidence::leverage`]: p n²/2 operations
    Leverage,
    /// [`Evidence::normalized_error`]: p n²/2 + p² n operations
    NormalizedError,
}

/// The numbers of [`Evidence`] that outlive a look at the sample.
#[derive(Clone, Copy)]
pub(crate) struct Known<T> {
    /// ‖φ̄‖², to see that a weight does not make it too large
    squared_regressors: T,
    squared_error: T,
    leverage: T,
    normalized_error: T,
    weight: T,
    rows: usize,
    targets: usize,
}

impl<T: Real> Known<T> {
    /// Refuses a whitened sample that is too large to compute with; its φ̄ has this ‖φ̄‖².
    #[inline]
    pub fn of<M: Memory<Real = T>>(
        memory: M,
        sample: &Sample<'_, M>,
        squared_regressors: T,
    ) -> Result<Self, Error> {
        let sum = sample.squared_error();
        if !(squared_regressors <= T::CEILING) {
            return Err(blame_squares(sample.regressors(), squared_regressors));
        }
        if !sum.is_finite() {
            return Err(out_of_range("error (squared and whitened)", sum));
        }
        Ok(Self {
            squared_regressors,
            squared_error: mean(sum, memory.targets()),
            leverage: T::ZERO,
            normalized_error: T::ZERO,
            weight: T::ONE,
            rows: memory.rows(),
            targets: memory.targets(),
        })
    }

    /// Finds what `needs` names, with the P before forgetting.
    #[inline]
    pub fn find<M: Memory<Real = T>>(
        &mut self,
        needs: Needs,
        factor: &Factor<M>,
        sample: &Sample<'_, M>,
        work: &mut Work<M>,
        (errors, matrix): (&mut [T], &mut [T]),
    ) {
        if needs == Needs::Errors {
            return;
        }
        self.leverage = leverage(factor, sample);
        if needs == Needs::NormalizedError {
            self.normalized_error = if sample.rows() == 1 {
                self.squared_error / (T::ONE + self.leverage)
            } else {
                errors.copy_from_slice(sample.errors());
                let rows = sample.regressors();
                let sum = whiten_errors(factor, rows, work.first.as_mut(), errors, matrix);
                mean(sum, self.targets)
            };
        }
    }

    /// What `gate` says of the sample.
    #[inline]
    pub fn ask<M: Memory<Real = T>>(
        &self,
        gate: &AnyGate<M>,
        sample: &Sample<'_, M>,
        factor: &Factor<M>,
        samples: u64,
    ) -> Result<Answer, Error> {
        if gate.is_open() {
            return Ok(Answer::Update);
        }
        let mut capped = *self;
        capped.cap();
        gate.answer(&capped.evidence(sample, factor, sample.errors(), samples))
    }

    /// Γ ← Γ/w with the weight of the sample; leaves in `seen` the errors that a rate sees, w
    /// times the whitened ones.
    #[inline]
    pub fn weigh<M: Memory<Real = T>, W: Weighting<M>>(
        &mut self,
        weighting: &W,
        sample: &mut Sample<'_, M>,
        seen: &mut [T],
        factor: &Factor<M>,
        samples: u64,
    ) -> Result<(), Error> {
        seen.copy_from_slice(sample.errors());
        let weight = weighting.weight(&self.evidence(sample, factor, seen, samples));
        if weight != T::ONE {
            self.scale(weight)?;
            sample.scale(weight.sqrt());
            seen.iter_mut().for_each(|e| *e *= weight);
        }
        self.cap();
        Ok(())
    }

    fn scale(&mut self, weight: T) -> Result<(), Error> {
        if !(weight > T::ZERO && weight.is_finite()) {
            return Err(Error::value("weight", weight.to_f64(), "positive and finite"));
        }
        let squared_regressors = weight * self.squared_regressors;
        if !(squared_regressors <= T::CEILING) {
            return Err(out_of_range("phi (its squared length)", squared_regressors));
        }
        self.weight = weight;
        self.squared_error = weight * (weight * self.squared_error);
        self.normalized_error = weight * (weight * self.normalized_error);
        Ok(())
    }

    /// ‖ē‖² over rows and targets of the sample as it is used, weighted by √w.
    #[inline]
    pub fn used_error(&self) -> T {
        self.squared_error / self.weight * T::from_f64(self.targets as f64)
    }

    /// Makes every statistic small enough to be squared.
    #[inline]
    fn cap(&mut self) {
        let Self { squared_error, leverage, normalized_error, .. } = self;
        for statistic in [squared_error, leverage, normalized_error] {
            // written so that what is not a number is capped, too
            if !(*statistic < T::CEILING) {
                *statistic = T::CEILING;
            }
        }
    }

    /// The same with a look at the sample and at P.
    #[inline]
    pub fn evidence<'a, 'b, M: Memory<Real = T>>(
        &self,
        sample: &'a Sample<'b, M>,
        factor: &'a Factor<M>,
        errors: &'a [T],
        samples: u64,
    ) -> Evidence<'a, 'b, M> {
        let Self { squared_error, leverage, normalized_error, rows, targets, .. } = *self;
        Evidence {
            sample,
            factor,
            errors,
            squared_error,
            leverage,
            normalized_error,
            rows,
            targets,
            samples,
        }
    }
}

/// Why φ̄ cannot be used: a number that is none, or its length.
#[cold]
pub(crate) fn blame_squares<T: Real>(regressors: &[T], squares: T) -> Error {
    match regressors.iter().position(|x| !x.is_finite()) {
        Some(index) => not_finite("phi", index, regressors[index]),
        None => out_of_range("phi (its squared length)", squares),
    }
}

#[inline]
fn mean<T: Real>(sum: T, count: usize) -> T {
    if count == 1 {
        sum
    } else {
        sum / T::from_f64(count as f64)
    }
}
