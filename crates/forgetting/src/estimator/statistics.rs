//! What is computed once of a sample, before it is used, and lent to gate, weighting and rate.

use crate::covariance::Factor;
use crate::error::Error;
use crate::gates::{AnyGate, Gate};
use crate::memory::Memory;
use crate::sample::{leverage, not_finite, out_of_range, whiten_errors};
use crate::sample::{Answer, Evidence, Needs, NoiseVariance, Sample, Work};
use crate::weightings::Weighting;
use forgetting_kernels::Real;

/// What is computed once of a sample and lent to gate, weighting and rate as [`Evidence`].
#[derive(Clone, Copy)]
pub(super) struct Statistics<T> {
    /// ‖φ̄‖², after [`Statistics::weigh`] with the weight
    pub squared_regressors: T,
    squared_error: T,
    leverage: T,
    normalized_error: T,
    weight: T,
    rows: usize,
    targets: usize,
    samples: u64,
    /// what errors are judged by: 1 where Γ is given, else their variance, once it is known
    noise_variance: Option<T>,
}

impl<T: Real> Statistics<T> {
    /// Of a whitened sample with this ‖φ̄‖², after so many `samples`.
    ///
    /// # Errors
    /// [`Error`] names φ or the error when it is too large to compute with.
    #[inline]
    pub fn of<M: Memory<Real = T>>(
        memory: M,
        sample: &Sample<'_, M>,
        squared_regressors: T,
        samples: u64,
    ) -> Result<Self, Error> {
        let sum = sample.squared_error();
        if !(squared_regressors <= T::CEILING) {
            return Err(blame_regressors(sample.regressors(), squared_regressors));
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
            samples,
            noise_variance: Some(T::ONE),
        })
    }

    /// Computes what `needs` names, with the P before forgetting.
    #[inline]
    pub fn compute<M: Memory<Real = T>>(
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

    /// Has errors judged by this estimate of their variance; returns it with what the sample adds, for so
    /// many `parameters`.
    #[inline]
    pub fn judge_by(
        &mut self,
        mut estimate: NoiseVariance<T>,
        parameters: usize,
    ) -> NoiseVariance<T> {
        self.noise_variance = estimate.known();
        let rows = T::from_f64(self.rows as f64);
        let (squared, leverage) = (self.squared_error / rows, self.leverage / rows);
        if NoiseVariance::<T>::is_settled(self.samples, parameters) {
            estimate.learn(squared, self.rows * self.targets, leverage);
        }
        estimate
    }

    /// What `gate` decides about the sample.
    ///
    /// # Errors
    /// [`Error::Function`] when a function of the user's fails.
    #[inline]
    pub fn ask<M: Memory<Real = T>>(
        &self,
        gate: &AnyGate<M>,
        sample: &Sample<'_, M>,
        factor: &Factor<M>,
    ) -> Result<Answer, Error> {
        if gate.is_open() {
            return Ok(Answer::Update);
        }
        let mut capped = *self;
        capped.cap();
        gate.answer(&capped.evidence(sample, factor, sample.errors()))
    }

    /// Γ ← Γ/w with the weight w of the sample; writes w times its errors to `clipped`.
    ///
    /// # Errors
    /// [`Error`] names a weight that is not positive, or that makes φ too large.
    #[inline]
    pub fn weigh<M: Memory<Real = T>, W: Weighting<M>>(
        &mut self,
        weighting: &W,
        sample: &mut Sample<'_, M>,
        clipped: &mut [T],
        factor: &Factor<M>,
    ) -> Result<(), Error> {
        clipped.copy_from_slice(sample.errors());
        let weight = weighting.weight(&self.evidence(sample, factor, clipped));
        if weight != T::ONE {
            self.scale(weight)?;
            sample.scale(weight.sqrt());
            clipped.iter_mut().for_each(|e| *e *= weight);
        }
        if !weighting.is_equal() {
            self.squared_regressors = sample.squared_regressors();
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

    /// The weight of the sample.
    #[inline]
    pub fn weight(&self) -> T {
        self.weight
    }

    /// ‖ē‖² over rows and targets of the sample as it is used, weighted by √w.
    #[inline]
    pub fn weighted_squared_error(&self) -> T {
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

    /// The statistics together with the sample, its `errors` and P.
    #[inline]
    pub fn evidence<'a, 'b, M: Memory<Real = T>>(
        &self,
        sample: &'a Sample<'b, M>,
        factor: &'a Factor<M>,
        errors: &'a [T],
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
            samples: self.samples,
            noise_variance: self.noise_variance,
        }
    }
}

/// Why φ̄ cannot be used: a number that is not finite, or its length.
#[cold]
fn blame_regressors<T: Real>(regressors: &[T], squares: T) -> Error {
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
