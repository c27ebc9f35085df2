//! What all streams hold, in their order.

use super::estimators;
use super::health::StreamHealth;
use super::pieces::{each_piece, each_stream, room};
use super::streams::Streams;
use crate::estimator::{extremes, GoOn};
use crate::number::{Array, Elements, Number};
use forgetting::{AnyEstimator, Error};

impl<T: Number> Streams<T> {
    /// θ of each stream, n numbers after n numbers.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn theta(&self, go_on: GoOn<'_>) -> Result<Vec<T>, Error> {
        let (count, n) = (self.count(), self.parameters());
        let mut theta = room(count, n)?;
        each_piece(count, n, go_on, |streams| {
            theta.resize(streams.end * n, T::ZERO);
            let place = &mut theta[streams.start * n..];
            match self {
                Self::Blocks(fleet) => fleet.theta(streams.start, place),
                Self::Estimators { each, .. } => {
                    for (stream, place) in each[streams].iter().zip(place.chunks_exact_mut(n)) {
                        place.copy_from_slice(stream.theta());
                    }
                }
            }
            Ok(())
        })?;
        Ok(theta)
    }

    /// The diagonal of P of each stream, n numbers after n numbers.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn variance(&self, go_on: GoOn<'_>) -> Result<Vec<T>, Error> {
        let (count, n) = (self.count(), self.parameters());
        let mut variances = room(count, n)?;
        each_piece(count, n, go_on, |streams| {
            variances.resize(streams.end * n, T::ZERO);
            let place = &mut variances[streams.start * n..];
            match self {
                Self::Blocks(fleet) => fleet.variances(streams.start, place),
                Self::Estimators { each, .. } => {
                    for (stream, place) in each[streams].iter().zip(place.chunks_exact_mut(n)) {
                        stream.express(stream.factor()).variances(place);
                    }
                }
            }
            Ok(())
        })?;
        Ok(variances)
    }

    /// φθ of each stream, for n numbers `phi` each.
    ///
    /// # Errors
    /// Those of [`Estimator::predict`](forgetting::Estimator::predict), and that of `go_on`.
    pub fn predict(&self, phi: &[T], prediction: &mut [T], go_on: GoOn<'_>) -> Result<(), Error> {
        let n = self.parameters();
        each_piece(self.count(), n, go_on, |streams| {
            let phi = &phi[streams.start * n..streams.end * n];
            let place = &mut prediction[streams.clone()];
            match self {
                Self::Blocks(fleet) => fleet.predict(streams.start, phi, place),
                Self::Estimators { each, .. } => estimators::predict(&each[streams], phi, place),
            }
        })
    }

    /// Samples used by each stream since its start.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn samples(&self, go_on: GoOn<'_>) -> Result<Vec<i64>, Error> {
        let mut samples = room(self.count(), 1)?;
        each_piece(self.count(), self.parameters(), go_on, |streams| {
            for i in streams {
                samples.push(match self {
                    Self::Blocks(fleet) => fleet.samples(i) as i64,
                    Self::Estimators { each, .. } => each[i].samples() as i64,
                });
            }
            Ok(())
        })?;
        Ok(samples)
    }

    /// What the health of each stream is made of.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn health(&self, go_on: GoOn<'_>) -> Result<StreamHealth, Error> {
        let count = self.count();
        let (mut largest, mut smallest) = (room(count, 1)?, room(count, 1)?);
        let mut windup = room(count, 1)?;
        let follows = self.fresh().prior().is_of_data();
        each_stream(count, self.parameters(), go_on, |i| {
            let (mut most, mut least) = self.extremes(i);
            windup.push(most > T::from_f64(AnyEstimator::<T>::WINDUP) * self.first_largest(i));
            if follows {
                // in the units of the user
                let own = extremes(&self.get(i));
                (most, least) = (T::from_f64(own.0), T::from_f64(own.1));
            }
            largest.push(most);
            smallest.push(least);
            Ok(())
        })?;
        Ok(StreamHealth {
            windup: Array { shape: vec![count], elements: Elements::Bool(windup) },
            samples: Array { shape: vec![count], elements: Elements::I64(self.samples(go_on)?) },
            largest: T::array(largest, &[count]),
            smallest: T::array(smallest, &[count]),
        })
    }

    /// The largest and the smallest element of D of a stream.
    fn extremes(&self, stream: usize) -> (T, T) {
        match self {
            Self::Blocks(fleet) => fleet.extremes(stream),
            Self::Estimators { each, .. } => {
                let factor = each[stream].factor();
                (factor.largest(), factor.smallest())
            }
        }
    }
}
