//! The streams of a fleet: in blocks of lanes where the rule has a form for it, else an estimator
//! each.

use super::health::StreamHealth;
use super::{estimators, threads};
use crate::configure::check_copies;
use crate::estimator::extremes;
use crate::number::{Array, Elements, Number};
use forgetting::fleet::{check_kind, Fleet, Outputs, Part, Samples};
use forgetting::rates::{AnyRate, Constant, Rate};
use forgetting::{AnyEstimator, Dynamic, Error, Estimator, Memory, Prior};

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

    /// (count, n)
    pub fn shape(&self) -> [usize; 2] {
        [self.count(), self.parameters()]
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

    /// Takes a sample for each stream, on as many cores as `threads` says; returns how many
    /// streams used it.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for so many threads.
    pub fn update(
        &mut self,
        samples: Samples<'_, T>,
        outputs: Outputs<'_, T>,
        threads: Option<usize>,
    ) -> Result<usize, Error> {
        let (count, n) = (self.count(), self.parameters());
        match self {
            Self::Blocks(fleet) => {
                let parts = fleet.parts(threads::parts(threads, count * n * (n + 3) / 2))?;
                let parts = parts.map(|part| (part.count(), part));
                let work = |mut part: Part<'_, T>,
                            samples: Samples<'_, T>,
                            mut outputs: Outputs<'_, T>| {
                    part.update(samples, &mut outputs)
                };
                Ok(threads::sum(parts, n, (samples, outputs), work))
            }
            Self::Estimators { each, .. } => {
                let parts = threads::parts(threads, count * n * (n + 3) * estimators::EFFORT);
                let parts = each.chunks_mut(count.div_ceil(parts).max(1));
                let parts = parts.map(|part| (part.len(), part));
                Ok(threads::sum(parts, n, (samples, outputs), |part, samples, mut outputs| {
                    estimators::update(part, T::ONE, samples, &mut outputs)
                }))
            }
        }
    }

    /// Takes a sample for each stream, so much time after its last one; returns how many used it.
    ///
    /// # Errors
    /// None that a stream's own sample causes.
    pub fn update_after(
        &mut self,
        elapsed: &[T],
        mut samples: Samples<'_, T>,
        mut outputs: Outputs<'_, T>,
    ) -> Result<usize, Error> {
        let (n, mut used) = (self.parameters(), 0);
        for (i, &elapsed) in elapsed.iter().enumerate() {
            let (sample, mut output);
            (sample, samples) = samples.split_at(1, n);
            (output, outputs) = outputs.split_at(1);
            let mut stream = [self.get(i)];
            used += estimators::update(&mut stream, elapsed, sample, &mut output);
            let [stream] = stream;
            self.put(i, stream)?;
        }
        Ok(used)
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
    pub fn health(&self) -> StreamHealth {
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
            let ends = largest.iter_mut().zip(&mut smallest).enumerate();
            for (i, (largest, smallest)) in ends {
                let (most, least) = extremes(&self.get(i));
                (*largest, *smallest) = (T::from_f64(most), T::from_f64(least));
            }
        }
        StreamHealth {
            windup: Array { shape: vec![count], elements: Elements::Bool(windup) },
            samples: Array { shape: vec![count], elements: Elements::I64(self.samples()) },
            largest: T::array(largest, &[count]),
            smallest: T::array(smallest, &[count]),
        }
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
