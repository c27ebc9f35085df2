//! The streams of a fleet: in blocks of lanes where the rule has a form for it, else an estimator
//! each.

use super::{estimators, parallel};
use crate::arrays::Number;
use crate::errors::raise;
use forgetting::fleet::{check_kind, Fleet, Outputs, Part, Samples};
use forgetting::rates::{AnyRate, Constant, Rate};
use forgetting::saved::AnyEstimator;
use forgetting::{Dynamic, Error, Estimator, Memory, Prior};
use pyo3::prelude::*;

/// Numbers that bound each stream's P, and what else its health is made of.
pub struct Spread<T> {
    pub largest: Vec<T>,
    pub smallest: Vec<T>,
    pub windup: Vec<bool>,
    pub samples: Vec<i64>,
}

/// Streams of the same sizes, rule, rate and weighting.
#[derive(Clone)]
pub enum Streams<T: Number> {
    Blocks(Box<Fleet<T>>),
    Estimators {
        /// what a new stream starts as
        fresh: Box<AnyEstimator<T>>,
        each: Vec<AnyEstimator<T>>,
    },
}

impl<T: Number> Streams<T> {
    /// No streams yet, of estimators like `fresh`.
    pub fn of(fresh: AnyEstimator<T>) -> Self {
        match Fleet::of(fresh.clone()) {
            Ok(fleet) => Self::Blocks(Box::new(fleet)),
            Err(_) => Self::Estimators { fresh: Box::new(fresh), each: Vec::new() },
        }
    }

    /// What a new stream starts as.
    pub fn fresh(&self) -> &AnyEstimator<T> {
        match self {
            Self::Blocks(fleet) => fleet.fresh(),
            Self::Estimators { fresh, .. } => fresh,
        }
    }

    pub fn len(&self) -> usize {
        match self {
            Self::Blocks(fleet) => fleet.count(),
            Self::Estimators { each, .. } => each.len(),
        }
    }

    /// n
    pub fn parameters(&self) -> usize {
        self.fresh().prior().memory().parameters()
    }

    /// Adds `count` new streams.
    ///
    /// # Errors
    /// `MemoryError` when there is no memory; nothing has changed.
    pub fn grow(&mut self, count: usize) -> PyResult<()> {
        match self {
            Self::Blocks(fleet) => fleet.grow(count).map_err(raise),
            Self::Estimators { fresh, each } => {
                each.try_reserve(count).map_err(|_| raise(Error::Memory))?;
                each.extend(std::iter::repeat_n(fresh.as_ref(), count).cloned());
                Ok(())
            }
        }
    }

    /// A copy of the stream at `index`.
    pub fn get(&self, index: usize) -> AnyEstimator<T> {
        match self {
            Self::Blocks(fleet) => fleet.get(index),
            Self::Estimators { each, .. } => each[index].clone(),
        }
    }

    /// Puts `estimator` in the place of the stream at `index`.
    ///
    /// # Errors
    /// `InvalidInput` unless it is one of this fleet's kind; see [`check_kind`].
    pub fn put(&mut self, index: usize, estimator: AnyEstimator<T>) -> PyResult<()> {
        match self {
            Self::Blocks(fleet) => fleet.put(index, estimator).map_err(raise),
            Self::Estimators { fresh, each } => {
                check_kind(fresh, &estimator).map_err(raise)?;
                each[index] = estimator;
                Ok(())
            }
        }
    }

    /// Takes a sample for each stream, on as many cores as `threads` says; returns how many
    /// streams used it.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for so many threads.
    pub fn update(
        &mut self,
        samples: Samples<'_, T>,
        told: Outputs<'_, T>,
        threads: Option<usize>,
    ) -> Result<usize, Error> {
        let (count, n) = (self.len(), self.parameters());
        match self {
            Self::Blocks(fleet) => {
                let parts = fleet.parts(parallel::parts(threads, count * n * (n + 3) / 2))?;
                let parts = parts.map(|part| (part.count(), part));
                let work =
                    |mut part: Part<'_, T>, samples: Samples<'_, T>, mut told: Outputs<'_, T>| {
                        part.update(samples, &mut told)
                    };
                Ok(parallel::sum(parts, n, (samples, told), work))
            }
            Self::Estimators { each, .. } => {
                let parts = parallel::parts(threads, count * n * (n + 3) * estimators::EFFORT);
                let parts = each.chunks_mut(count.div_ceil(parts).max(1));
                let parts = parts.map(|part| (part.len(), part));
                Ok(parallel::sum(parts, n, (samples, told), |part, samples, mut told| {
                    estimators::update(part, samples, &mut told)
                }))
            }
        }
    }

    /// φθ of each stream.
    ///
    /// # Errors
    /// Those of [`Estimator::predict`].
    pub fn predict(&self, phi: &[T], prediction: &mut [T]) -> Result<(), Error> {
        match self {
            Self::Blocks(fleet) => fleet.predict(phi, prediction),
            Self::Estimators { each, .. } => estimators::predict(each, phi, prediction),
        }
    }

    /// θ of each stream, n numbers after n numbers.
    pub fn theta(&self) -> Vec<T> {
        let mut theta = vec![T::ZERO; self.parameters() * self.len()];
        match self {
            Self::Blocks(fleet) => fleet.theta(&mut theta),
            Self::Estimators { each, .. } => {
                let places = theta.chunks_exact_mut(self.parameters());
                each.iter().zip(places).for_each(|(stream, place)| {
                    place.copy_from_slice(stream.theta());
                });
            }
        }
        theta
    }

    /// The diagonal of P of each stream, n numbers after n numbers.
    pub fn variance(&self) -> Vec<T> {
        let mut variances = vec![T::ZERO; self.parameters() * self.len()];
        match self {
            Self::Blocks(fleet) => fleet.variances(&mut variances),
            Self::Estimators { each, .. } => {
                let places = variances.chunks_exact_mut(self.parameters());
                each.iter().zip(places).for_each(|(stream, place)| {
                    stream.factor().variances(place);
                });
            }
        }
        variances
    }

    /// What the health of each stream is made of.
    pub fn spread(&self) -> Spread<T> {
        match self {
            Self::Estimators { each, .. } => estimators::spread(each),
            Self::Blocks(fleet) => {
                let count = fleet.count();
                let (mut largest, mut smallest) = (vec![T::ZERO; count], vec![T::ZERO; count]);
                fleet.extremes(&mut largest, &mut smallest);
                let limit = |i| T::from_f64(AnyEstimator::<T>::WINDUP) * fleet.first_largest(i);
                Spread {
                    windup: largest.iter().enumerate().map(|(i, &d)| d > limit(i)).collect(),
                    samples: (0..count).map(|i| fleet.samples(i) as i64).collect(),
                    largest,
                    smallest,
                }
            }
        }
    }

    /// λ of each stream, if it is constant.
    pub fn forgetting_factor(&self) -> Option<Vec<T>> {
        match self {
            Self::Blocks(fleet) => {
                Some((0..fleet.count()).map(|i| fleet.forgetting_factor(i)).collect())
            }
            Self::Estimators { each, .. } => {
                each.iter().map(|stream| stream.rate().constant()).collect()
            }
        }
    }

    /// Starts again the streams that `mask` names, or all.
    pub fn reset(&mut self, mask: Option<&[bool]>) {
        match self {
            Self::Blocks(fleet) => fleet.reset(mask),
            Self::Estimators { each, .. } => {
                for (i, stream) in each.iter_mut().enumerate() {
                    if mask.is_none_or(|mask| mask[i]) {
                        stream.reset();
                    }
                }
            }
        }
    }
}

/// An estimator like `fresh` with another prior or another forgetting factor.
///
/// # Errors
/// [`Error::Value`] names a forgetting factor that is out of range.
pub fn like<T: Number>(
    fresh: &AnyEstimator<T>,
    forgetting_factor: Option<T>,
    prior: Prior<Dynamic<T>>,
) -> Result<AnyEstimator<T>, Error> {
    let rate = match forgetting_factor {
        Some(factor) => AnyRate::Constant(Constant::new(factor)?),
        None => fresh.rate().clone(),
    };
    let (rule, weighting) = (fresh.rule().clone(), fresh.weighting().clone());
    Ok(Estimator::new(rule, rate, weighting, prior).with_gate(fresh.gate().clone()))
}
