//! Many streams, of any type.

mod estimators;
mod health;
mod make;
mod streams;
mod threads;
mod update;

pub use health::StreamHealth;
pub use update::FleetUpdate;

use crate::choice::Description;
use crate::error::Error;
use crate::estimator::{covariance, saved_type, Estimator};
use crate::number::{both, each, make, map, ByType, Family, Number};
use crate::number::{Array, Elements, NumberType, View};
use crate::settings::Settings;
use forgetting::fleet::{check_kind, check_stream};
use forgetting::saved::least_length;
use forgetting::AnyEstimator;
use make::check_functions;
use streams::Streams;

/// Streams, with the number type left open.
struct Fleets;

impl Family for Fleets {
    type Of<T: Number> = Streams<T>;
}

/// Many independent streams of the same number of parameters and the same rule, updated together.
///
/// Each stream is an [`Estimator`] of one row and one target of its own; a fleet takes a sample of
/// each in one call. What a stream cannot use is reported and leaves that stream alone,
/// bit for bit: one bad sample does not stop the others.
#[derive(Clone)]
pub struct Fleet {
    typed: ByType<Fleets>,
    /// none for what suits the machine
    threads: Option<usize>,
}

impl Fleet {
    /// `count` streams, from 0, as `settings` say; [`Settings::initial_covariance`] may also have
    /// one value a stream, (count, n) or (count, n, n), and [`Settings::initial_theta`], (count,
    /// n). `forgetting_factor` is in the place of that of the rule: for all streams, or one a
    /// stream, (count,).
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and what is allowed, [`Error::Stream`] the stream.
    /// No function of the user's is taken.
    pub fn new(
        count: i64,
        settings: &Settings<'_>,
        forgetting_factor: Option<View<'_>>,
    ) -> Result<Self, Error> {
        let count = make::read_count(count)?;
        let typed = make!(settings.number_type, T => {
            make::streams::<T>(count, settings, forgetting_factor)?
        });
        Ok(Self { typed, threads: None })
    }

    /// The fleet of which [`Fleet::fresh_state`] and [`Fleet::state`] gave these states.
    ///
    /// # Errors
    /// [`Error`] says what is wrong with a state, [`Error::Stream`] with which.
    pub fn from_states(fresh: &[u8], states: &[&[u8]]) -> Result<Self, Error> {
        let typed = make!(saved_type(fresh)?, T => restore::<T>(fresh, states)?);
        Ok(Self { typed, threads: None })
    }

    /// How many streams there are.
    #[must_use]
    pub fn count(&self) -> usize {
        each!(&self.typed, streams => streams.count())
    }

    /// n
    #[must_use]
    pub fn parameters(&self) -> usize {
        each!(&self.typed, streams => streams.parameters())
    }

    /// The type of its numbers.
    #[must_use]
    pub fn number_type(&self) -> NumberType {
        self.typed.number_type()
    }

    /// The threads that an update runs on; none for all cores where that is faster than one. The
    /// result does not depend on it.
    #[must_use]
    pub fn threads(&self) -> Option<usize> {
        self.threads
    }

    /// Sets [`Fleet::threads`]; see [`threads`](crate::threads()).
    pub fn set_threads(&mut self, threads: Option<usize>) {
        self.threads = threads;
    }

    /// The rule, rate, weighting and gate of a new stream by name, each with its parameters.
    #[must_use]
    pub fn describe(&self) -> Description {
        each!(&self.typed, streams => Description::of(streams.fresh()))
    }

    /// λ of each stream, (count,); none where it is not constant.
    #[must_use]
    pub fn forgetting_factor(&self) -> Option<Array> {
        each!(&self.typed, streams => {
            streams.forgetting_factor().map(|factors| Number::array(factors, &[streams.count()]))
        })
    }

    /// θ of each stream, (count, n).
    #[must_use]
    pub fn theta(&self) -> Array {
        each!(&self.typed, streams => Number::array(streams.theta(), &streams.shape()))
    }

    /// The diagonal of P of each stream, (count, n), in units of 1/φ².
    #[must_use]
    pub fn variance(&self) -> Array {
        each!(&self.typed, streams => Number::array(streams.variance(), &streams.shape()))
    }

    /// Samples used by each stream since its start, (count,).
    #[must_use]
    pub fn samples(&self) -> Array {
        let samples = each!(&self.typed, streams => streams.samples());
        Array { shape: vec![samples.len()], elements: Elements::I64(samples) }
    }

    /// How far each estimate can be trusted now, in O(n) a stream.
    #[must_use]
    pub fn health(&self) -> StreamHealth {
        each!(&self.typed, streams => streams.health())
    }

    /// P of a stream, (n, n), in units of 1/φ².
    ///
    /// # Errors
    /// [`Error::NoStream`].
    pub fn covariance(&self, stream: i64) -> Result<Array, Error> {
        let stream = self.position(stream)?;
        each!(&self.typed, streams => covariance(&streams.get(stream)))
    }

    /// φθ of each stream, (count,), for `phi` (count, n).
    ///
    /// # Errors
    /// [`Error::Shape`] names `phi`.
    pub fn predict(&self, phi: View<'_>) -> Result<Array, Error> {
        each!(&self.typed, streams => update::predict(streams, phi))
    }

    /// Takes a sample of each stream: `phi` (count, n), `y` (count,). A stream has none where
    /// `mask` says no, or with a NaN. `outputs` names what is kept, of `error`, `leverage` and
    /// `skipped`; [`FleetUpdate::DEFAULT_OUTPUTS`] if not given.
    ///
    /// # Errors
    /// [`Error`] names the argument that does not fit; nothing has changed.
    pub fn update(
        &mut self,
        samples: (View<'_>, View<'_>, Option<&[bool]>),
        outputs: Option<&[&str]>,
    ) -> Result<FleetUpdate, Error> {
        self.update_after(None, samples, outputs)
    }

    /// The same, `elapsed` () or (count,) after the last sample of each stream, in the unit of time in
    /// which forgetting is stated; see [`UpdateOptions::elapsed`](crate::UpdateOptions). Streams are
    /// then taken one by one, which is slower.
    ///
    /// # Errors
    /// Those of [`Fleet::update`], and [`Error`] names `elapsed` unless it is finite and not negative.
    pub fn update_after(
        &mut self,
        elapsed: Option<View<'_>>,
        samples: (View<'_>, View<'_>, Option<&[bool]>),
        outputs: Option<&[&str]>,
    ) -> Result<FleetUpdate, Error> {
        let outputs = outputs.unwrap_or(&FleetUpdate::DEFAULT_OUTPUTS);
        let threads = self.threads;
        each!(&mut self.typed, streams => {
            update::update(streams, samples, elapsed, outputs, threads)
        })
    }

    /// Back to the initial estimate and covariance, for the streams that `mask` names, or all.
    ///
    /// # Errors
    /// [`Error::Shape`] names `mask`.
    pub fn reset(&mut self, mask: Option<&[bool]>) -> Result<(), Error> {
        update::check_mask(mask, self.count())?;
        each!(&mut self.typed, streams => streams.reset(mask));
        Ok(())
    }

    /// Adds `count` new streams after the last. They start from what was given for all streams, and
    /// from the default where one was given for each.
    ///
    /// # Errors
    /// [`Error::Core`] names `count`, or that there is not enough memory; nothing has changed.
    pub fn grow(&mut self, count: i64) -> Result<(), Error> {
        if count < 1 {
            let allowed = "whole numbers from 1";
            return Err(forgetting::Error::value("count", count as f64, allowed).into());
        }
        let count = make::read_count(count)?;
        Ok(each!(&mut self.typed, streams => streams.grow(count))?)
    }

    /// Adds copies of the streams of another fleet of the same parameters, rule, weighting, gate
    /// and number type.
    ///
    /// # Errors
    /// [`Error`] says what differs; nothing has changed.
    pub fn append(&mut self, other: &Self) -> Result<(), Error> {
        let appended = both!(&mut self.typed, &other.typed; streams, others => {
            check_kind(streams.fresh(), others.fresh())?;
            let first = streams.count();
            streams.grow(others.count())?;
            (0..others.count()).try_for_each(|i| streams.put(first + i, others.get(i)))
        });
        Ok(appended.ok_or_else(other_type)??)
    }

    /// A copy of a stream, as an estimator that goes on from there.
    ///
    /// # Errors
    /// [`Error::NoStream`].
    pub fn get(&self, stream: i64) -> Result<Estimator, Error> {
        let stream = self.position(stream)?;
        Ok(Estimator::of(map!(&self.typed, streams => streams.get(stream))))
    }

    /// Puts a copy of `estimator` in the place of a stream.
    ///
    /// # Errors
    /// [`Error::NoStream`], or [`Error`] says what differs; nothing has changed.
    pub fn put(&mut self, stream: i64, estimator: &Estimator) -> Result<(), Error> {
        let stream = self.position(stream)?;
        let put = both!(&mut self.typed, &estimator.typed; streams, estimator => {
            streams.put(stream, estimator.as_ref().clone())
        });
        Ok(put.ok_or_else(other_type)??)
    }

    /// The state of a new stream, as [`Estimator::to_bytes`] says it.
    ///
    /// # Errors
    /// Those of [`Estimator::to_bytes`].
    pub fn fresh_state(&self) -> Result<Vec<u8>, Error> {
        Ok(each!(&self.typed, streams => streams.fresh().to_bytes())?)
    }

    /// The state of a stream, as [`Estimator::to_bytes`] says it.
    ///
    /// # Errors
    /// [`Error::NoStream`], and those of [`Estimator::to_bytes`].
    pub fn state(&self, stream: i64) -> Result<Vec<u8>, Error> {
        let stream = self.position(stream)?;
        Ok(each!(&self.typed, streams => streams.get(stream).to_bytes())?)
    }

    /// Where `stream` is, counted from the end if negative.
    fn position(&self, stream: i64) -> Result<usize, Error> {
        let count = self.count() as i64;
        let position = if stream < 0 { stream.saturating_add(count) } else { stream };
        if (0..count).contains(&position) {
            return Ok(position as usize);
        }
        Err(Error::NoStream { stream, count: self.count() })
    }
}

fn other_type() -> Error {
    Error::unsupported("a stream has the dtype of its fleet")
}

/// Streams of these states.
fn restore<T: Number>(fresh: &[u8], states: &[&[u8]]) -> Result<Streams<T>, Error> {
    let mut streams = Streams::of(AnyEstimator::<T>::from_bytes(fresh)?);
    check_stream(streams.fresh())?;
    check_functions(streams.fresh())?;
    // before there is room for as many: all are of the same sizes
    let least = least_length(streams.fresh());
    if let Some(stream) = states.iter().position(|state| state.len() < least) {
        let error = forgetting::Error::State { reason: "it is truncated" };
        return Err(Error::Stream { stream, error });
    }
    streams.grow(states.len())?;
    for (stream, state) in states.iter().enumerate() {
        let estimator = AnyEstimator::from_bytes(state);
        streams.put(stream, estimator.map_err(|error| Error::Stream { stream, error })?)?;
    }
    Ok(streams)
}
