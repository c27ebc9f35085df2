//! The streams of a fleet: in blocks of lanes where the rule has a form for it, else an estimator
//! each.

use super::pieces::room;
use crate::number::Number;
use forgetting::fleet::{check_kind, Fleet};
use forgetting::rates::Rate;
use forgetting::{AnyEstimator, Error, Memory};

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

    /// How many there are.
    pub fn count(&self) -> usize {
        match self {
            Self::Blocks(fleet) => fleet.count(),
            Self::Estimators { each, .. } => each.len(),
        }
    }

    /// n
    pub fn parameters(&self) -> usize {
        self.fresh().prior().memory().parameters()
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
    /// [`Error::Unsupported`] unless it is one of this fleet's kind; see [`check_kind`].
    pub fn put(&mut self, index: usize, estimator: AnyEstimator<T>) -> Result<(), Error> {
        match self {
            Self::Blocks(fleet) => fleet.put(index, estimator),
            Self::Estimators { fresh, each } => {
                check_kind(fresh, &estimator)?;
                each[index] = estimator;
                Ok(())
            }
        }
    }

    /// The largest element of D of the stream at `index` before its first sample.
    pub fn first_largest(&self, index: usize) -> T {
        match self {
            Self::Blocks(fleet) => fleet.first_largest(index),
            Self::Estimators { each, .. } => each[index].prior().factor().largest(),
        }
    }

    /// λ of each stream, if it is constant.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for so many.
    pub fn forgetting_factor(&self) -> Result<Option<Vec<T>>, Error> {
        let mut factors = room(self.count(), 1)?;
        match self {
            Self::Blocks(fleet) => {
                factors.extend((0..fleet.count()).map(|i| fleet.forgetting_factor(i)));
            }
            Self::Estimators { each, .. } => {
                for stream in each {
                    let Some(factor) = stream.rate().constant() else { return Ok(None) };
                    factors.push(factor);
                }
            }
        }
        Ok(Some(factors))
    }
}
