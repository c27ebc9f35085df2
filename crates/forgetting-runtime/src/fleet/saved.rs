//! Streams as bytes and back.

use super::banks::Banks;
use super::make::check_functions;
use super::streams::Streams;
use super::{kept, Fleet, Kept};
use crate::bank::saved_type as bank_type;
use crate::error::Error;
use crate::estimator::record::{GoOn, Pause};
use crate::estimator::saved_type;
use crate::number::{each, make, Number};
use forgetting::bank::Bank;
use forgetting::fleet::check_stream;
use forgetting::saved::{is_bank, least_length};
use forgetting::AnyEstimator;

impl Fleet {
    /// The fleet of which [`Fleet::fresh_state`] and [`Fleet::state`] gave these states.
    ///
    /// # Errors
    /// [`Error`] says what is wrong with a state, [`Error::Stream`] with which; and that of `go_on`.
    pub fn from_states(fresh: &[u8], states: &[&[u8]], go_on: GoOn<'_>) -> Result<Self, Error> {
        let kept = if is_bank(fresh) {
            Kept::Banks(make!(bank_type(fresh)?, T => banks::<T>(fresh, states, go_on)?))
        } else {
            Kept::Estimators(make!(saved_type(fresh)?, T => estimators::<T>(fresh, states, go_on)?))
        };
        Ok(Self { kept, threads: None })
    }

    /// The state of a new stream, as [`Estimator::to_bytes`](crate::Estimator::to_bytes) or
    /// [`Bank::to_bytes`](crate::Bank::to_bytes) says it.
    ///
    /// # Errors
    /// Those of both.
    pub fn fresh_state(&self) -> Result<Vec<u8>, Error> {
        Ok(kept!(&self.kept, streams => streams.fresh().to_bytes())?)
    }

    /// The state of a stream, as [`Fleet::fresh_state`] says it.
    ///
    /// # Errors
    /// [`Error::NoStream`], and those of [`Fleet::fresh_state`].
    pub fn state(&self, stream: i64) -> Result<Vec<u8>, Error> {
        let stream = self.position(stream)?;
        Ok(kept!(&self.kept, streams => streams.get(stream).to_bytes())?)
    }
}

/// Estimators of these states.
fn estimators<T: Number>(
    fresh: &[u8],
    states: &[&[u8]],
    go_on: GoOn<'_>,
) -> Result<Streams<T>, Error> {
    let mut streams = Streams::of(AnyEstimator::<T>::from_bytes(fresh)?);
    check_stream(streams.fresh())?;
    check_functions(streams.fresh())?;
    check_lengths(states, least_length(streams.fresh()))?;
    streams.grow(states.len(), go_on)?;
    let mut pause = Pause::new(go_on, 1, streams.parameters());
    for (stream, state) in states.iter().enumerate() {
        pause.after(1)?;
        let estimator = AnyEstimator::from_bytes(state);
        streams.put(stream, estimator.map_err(|error| Error::Stream { stream, error })?)?;
    }
    Ok(streams)
}

/// Banks of these states.
fn banks<T: Number>(fresh: &[u8], states: &[&[u8]], go_on: GoOn<'_>) -> Result<Banks<T>, Error> {
    let mut streams = Banks::of(Bank::<T>::from_bytes(fresh)?)?;
    check_lengths(states, least_length(&streams.fresh().members()[0]))?;
    streams.grow(states.len(), go_on)?;
    let mut pause = Pause::new(go_on, 1, streams.parameters());
    for (stream, state) in states.iter().enumerate() {
        pause.after(1)?;
        let bank = Bank::from_bytes(state);
        streams.put(stream, bank.map_err(|error| Error::Stream { stream, error })?)?;
    }
    Ok(streams)
}

/// Refuses states of fewer bytes than any can have, before there is room for as many.
fn check_lengths(states: &[&[u8]], least: usize) -> Result<(), Error> {
    match states.iter().position(|state| state.len() < least) {
        None => Ok(()),
        Some(stream) => {
            let error = forgetting::Error::State { reason: "it is truncated" };
            Err(Error::Stream { stream, error })
        }
    }
}
