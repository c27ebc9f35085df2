//! The streams of a fleet, each an estimator of its own.

use crate::arrays::Number;
use crate::errors::raise;
use forgetting::fleet::check_kind;
use forgetting::rates::{AnyRate, Constant, Rate};
use forgetting::saved::AnyEstimator;
use forgetting::{Dynamic, Error, Estimator, Memory, Prior, Skip};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// The code of a stream that refused its sample, beside those of [`Skip`].
pub const REFUSED: u8 = u8::MAX;

/// What the streams told of their samples: a number each, or nothing if it is not asked for.
pub struct Told<'a, T> {
    pub error: Option<&'a mut [T]>,
    pub leverage: Option<&'a mut [T]>,
    /// 0 where the sample was used
    pub skipped: Option<&'a mut [u8]>,
}

/// Numbers that bound each stream's P, and what else its health is made of.
pub struct Spread<T> {
    pub largest: Vec<T>,
    pub smallest: Vec<T>,
    pub windup: Vec<bool>,
    pub samples: Vec<i64>,
}

/// Estimators of the same sizes, rule, rate and weighting.
#[derive(Clone)]
pub struct Streams<T: Number> {
    /// what a new stream starts as
    pub fresh: AnyEstimator<T>,
    each: Vec<AnyEstimator<T>>,
}

impl<T: Number> Streams<T> {
    /// No streams yet, of estimators like `fresh`.
    pub fn of(fresh: AnyEstimator<T>) -> Self {
        Self { fresh, each: Vec::new() }
    }

    /// Makes room for `count` more streams.
    ///
    /// # Errors
    /// `MemoryError` when there is none.
    pub fn reserve(&mut self, count: usize) -> PyResult<()> {
        self.each
            .try_reserve(count)
            .map_err(|_| PyMemoryError::new_err(format!("no memory for {count} streams")))
    }

    pub fn len(&self) -> usize {
        self.each.len()
    }

    /// n
    pub fn parameters(&self) -> usize {
        self.fresh.prior().memory().parameters()
    }

    /// The stream at `index`.
    pub fn get(&self, index: usize) -> AnyEstimator<T> {
        self.each[index].clone()
    }

    /// Puts `estimator` in the place of the stream at `index`, or after the last.
    ///
    /// # Errors
    /// `InvalidInput` unless it is one of this fleet's kind; see [`check_kind`].
    pub fn put(&mut self, index: usize, estimator: AnyEstimator<T>) -> PyResult<()> {
        check_kind(&self.fresh, &estimator).map_err(raise)?;
        match self.each.get_mut(index) {
            Some(place) => *place = estimator,
            None => self.each.push(estimator),
        }
        Ok(())
    }

    /// Takes a sample for each stream: n numbers `phi` and one number `y`; returns how many used
    /// it. Where `mask` says no, or a number is NaN, the stream stays as it is.
    pub fn update(
        &mut self,
        phi: &[T],
        y: &[T],
        mask: Option<&[bool]>,
        told: &mut Told<'_, T>,
    ) -> usize {
        let n = self.parameters();
        let mut used = 0;
        for (i, estimator) in self.each.iter_mut().enumerate() {
            let (phi, y) = (&phi[i * n..(i + 1) * n], &y[i..=i]);
            let (error, leverage, code) = match mask.is_none_or(|mask| mask[i]) {
                true => take(estimator, phi, y),
                false => nothing(Skip::Missing.code()),
            };
            used += usize::from(code == 0);
            put(&mut told.error, i, error);
            put(&mut told.leverage, i, leverage);
            put(&mut told.skipped, i, code);
        }
        used
    }

    /// φθ of each stream.
    ///
    /// # Errors
    /// Those of [`Estimator::predict`].
    pub fn predict(&self, phi: &[T], prediction: &mut [T]) -> Result<(), Error> {
        let n = self.parameters();
        let each = phi.chunks_exact(n).zip(prediction.chunks_exact_mut(1));
        self.each.iter().zip(each).try_for_each(|(stream, (phi, y))| stream.predict(phi, y))
    }

    /// θ of each stream, n numbers after n numbers.
    pub fn theta(&self) -> Vec<T> {
        self.each.iter().flat_map(|stream| stream.theta().iter().copied()).collect()
    }

    /// The diagonal of P of each stream, n numbers after n numbers.
    pub fn variance(&self) -> Vec<T> {
        let n = self.parameters();
        let mut variances = vec![T::ZERO; n * self.len()];
        for (stream, variances) in self.each.iter().zip(variances.chunks_exact_mut(n)) {
            stream.factor().variances(variances);
        }
        variances
    }

    /// What the health of each stream is made of.
    pub fn spread(&self) -> Spread<T> {
        let factors = || self.each.iter().map(AnyEstimator::factor);
        Spread {
            largest: factors().map(|factor| factor.largest()).collect(),
            smallest: factors().map(|factor| factor.smallest()).collect(),
            windup: self.each.iter().map(has_wound_up).collect(),
            samples: self.each.iter().map(|stream| stream.samples() as i64).collect(),
        }
    }

    /// λ of each stream, if it is constant.
    pub fn forgetting_factor(&self) -> Option<Vec<T>> {
        self.each.iter().map(|stream| stream.rate().constant()).collect()
    }

    /// Starts again the streams that `mask` names, or all.
    pub fn reset(&mut self, mask: Option<&[bool]>) {
        for (i, stream) in self.each.iter_mut().enumerate() {
            if mask.is_none_or(|mask| mask[i]) {
                stream.reset();
            }
        }
    }
}

/// One stream's sample.
fn take<T: Number>(estimator: &mut AnyEstimator<T>, phi: &[T], y: &[T]) -> (T, T, u8) {
    if phi.iter().chain(y).any(|x| x.to_f64().is_nan()) {
        return nothing(Skip::Missing.code());
    }
    match estimator.update(phi, y) {
        Ok(update) => (update.error[0], update.leverage, update.skipped.map_or(0, Skip::code)),
        Err(_) => nothing(REFUSED),
    }
}

fn nothing<T: Number>(code: u8) -> (T, T, u8) {
    let nan = T::from_f64(f64::NAN);
    (nan, nan, code)
}

fn put<T>(numbers: &mut Option<&mut [T]>, index: usize, number: T) {
    if let Some(numbers) = numbers {
        numbers[index] = number;
    }
}

/// Whether P has grown to more than ten times its first value, as an update says it.
fn has_wound_up<T: Number>(stream: &AnyEstimator<T>) -> bool {
    let first = stream.prior().factor().largest();
    stream.factor().largest() > T::from_f64(AnyEstimator::<T>::WINDUP) * first
}

/// An estimator like `fresh` with another prior or another forgetting factor.
///
/// # Errors
/// `InvalidInput` names a forgetting factor that is out of range.
pub fn like<T: Number>(
    fresh: &AnyEstimator<T>,
    forgetting_factor: Option<T>,
    prior: Prior<Dynamic<T>>,
) -> Result<AnyEstimator<T>, Error> {
    let rate = match forgetting_factor {
        Some(factor) => AnyRate::Constant(Constant::new(factor)?),
        None => fresh.rate().clone(),
    };
    Ok(Estimator::new(fresh.rule().clone(), rate, fresh.weighting().clone(), prior))
}
