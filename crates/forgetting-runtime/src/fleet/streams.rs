//! The streams of a fleet: in blocks of lanes where the rule has a form for it, else an estimator
//! each.

use super::estimators;
use super::health::StreamHealth;
use crate::configure::check_copies;
use crate::estimator::extremes;
use crate::estimator::record::{GoOn, Pause};
use crate::number::{Array, Elements, Number};
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

    /// Adds `count` new streams.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none; nothing has changed.
    pub fn grow(&mut self, count: usize) -> Result<(), Error> {
        match self {
            Self::Blocks(fleet) => fleet.grow(count),
            Self::Estimators { fresh, each } => {
                each.try_reserve(count).map_err(|_| Error::Memory)?;
                check_copies(fresh, count)?;
                each.extend(std::iter::repeat_n(fresh.as_ref(), count).cloned());
                Ok(())
            }
        }
    }

    /// Adds copies of the streams of `others`.
    ///
    /// # Errors
    /// Those of [`check_kind`], and [`Error::Memory`]; nothing has changed.
    pub fn append(&mut self, others: &Self) -> Result<(), Error> {
        check_kind(self.fresh(), others.fresh())?;
        let first = self.count();
        self.grow(others.count())?;
        (0..others.count()).try_for_each(|i| self.put(first + i, others.get(i)))
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

    /// θ of each stream, n numbers after n numbers.
    pub fn theta(&self) -> Vec<T> {
        let mut theta = vec![T::ZERO; self.parameters() * self.count()];
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
        let mut variances = vec![T::ZERO; self.parameters() * self.count()];
        match self {
            Self::Blocks(fleet) => fleet.variances(&mut variances),
            Self::Estimators { each, .. } => {
                let places = variances.chunks_exact_mut(self.parameters());
                each.iter().zip(places).for_each(|(stream, place)| {
                    stream.express(stream.factor()).variances(place);
                });
            }
        }
        variances
    }

    /// Samples used by each stream since its start.
    pub fn samples(&self) -> Vec<i64> {
        match self {
            Self::Blocks(fleet) => (0..fleet.count()).map(|i| fleet.samples(i) as i64).collect(),
            Self::Estimators { each, .. } => each.iter().map(|e| e.samples() as i64).collect(),
        }
    }

    /// What the health of each stream is made of.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn health(&self, go_on: GoOn<'_>) -> Result<StreamHealth, Error> {
        let count = self.count();
        let (mut largest, mut smallest) = (vec![T::ZERO; count], vec![T::ZERO; count]);
        match self {
            Self::Blocks(fleet) => fleet.extremes(&mut largest, &mut smallest),
            Self::Estimators { each, .. } => {
                estimators::extremes(each, &mut largest, &mut smallest);
            }
        }
        let limit = |i| T::from_f64(AnyEstimator::<T>::WINDUP) * self.first_largest(i);
        let windup = largest.iter().enumerate().map(|(i, &d)| d > limit(i)).collect();
        if self.fresh().prior().is_of_data() {
            // in the units of the user
            let mut pause = Pause::new(go_on, 1, self.parameters());
            let ends = largest.iter_mut().zip(&mut smallest).enumerate();
            for (i, (largest, smallest)) in ends {
                let (most, least) = extremes(&self.get(i));
                (*largest, *smallest) = (T::from_f64(most), T::from_f64(least));
                pause.after(1)?;
            }
        }
        Ok(StreamHealth {
            windup: Array { shape: vec![count], elements: Elements::Bool(windup) },
            samples: Array { shape: vec![count], elements: Elements::I64(self.samples()) },
            largest: T::array(largest, &[count]),
            smallest: T::array(smallest, &[count]),
        })
    }

    /// The largest element of D of the stream at `index` before its first sample.
    fn first_largest(&self, index: usize) -> T {
        match self {
            Self::Blocks(fleet) => fleet.first_largest(index),
            Self::Estimators { each, .. } => each[index].prior().factor().largest(),
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
