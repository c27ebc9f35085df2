//! Many streams, of any type.

mod banks;
mod estimators;
mod exchange;
mod health;
mod make;
mod many;
mod numbers;
mod one_by_one;
mod part;
mod pieces;
mod read;
mod reset;
mod saved;
mod size;
mod stream;
mod streams;
mod threads;
mod update;

pub use health::StreamHealth;
pub use stream::Stream;
pub use update::FleetUpdate;

use crate::bank::{self, Bank, BankSettings};
use crate::choice::Description;
use crate::error::Error;
#[cfg(doc)]
use crate::estimator::Estimator;
use crate::estimator::{covariance, GoOn};
use crate::number::{each, make, map, ByType, Family, Number};
use crate::number::{Array, Elements, NumberType, View};
use crate::settings::Settings;
use banks::Banks;
use many::Many;
use streams::Streams;

/// Streams that are estimators, with the number type left open.
struct OfEstimators;

impl Family for OfEstimators {
    type Of<T: Number> = Streams<T>;
}

/// Streams that are banks.
struct OfBanks;

impl Family for OfBanks {
    type Of<T: Number> = Banks<T>;
}

/// Streams of either kind.
#[derive(Clone)]
enum Kept {
    Estimators(ByType<OfEstimators>),
    Banks(ByType<OfBanks>),
}

/// Evaluates an expression for the streams, whatever they are.
macro_rules! kept {
    ($kept:expr, $streams:ident => $expression:expr) => {
        match $kept {
            Kept::Estimators(typed) => each!(typed, $streams => $expression),
            Kept::Banks(typed) => each!(typed, $streams => $expression),
        }
    };
}

use kept;

/// Many independent streams of the same number of parameters and the same rule, updated together.
///
/// Each stream is an [`Estimator`] or a [`Bank`] of one row and one target of its own; a fleet takes a sample of
/// each in one call. What a stream cannot use is reported and leaves that stream alone,
/// bit for bit: one bad sample does not stop the others.
#[derive(Clone)]
pub struct Fleet {
    kept: Kept,
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
        Self::new_while(count, settings, forgetting_factor, &mut || Ok(()))
    }

    /// The same, as long as `go_on` says so, which is asked a few times a second.
    ///
    /// # Errors
    /// Those of [`Fleet::new`], and that of `go_on`.
    pub fn new_while(
        count: i64,
        settings: &Settings<'_>,
        forgetting_factor: Option<View<'_>>,
        go_on: GoOn<'_>,
    ) -> Result<Self, Error> {
        let count = make::read_count(count)?;
        let typed = make!(settings.number_type, T => {
            make::streams::<T>(count, settings, forgetting_factor, go_on)?
        });
        Ok(Self { kept: Kept::Estimators(typed), threads: None })
    }

    /// `count` streams, from 0, each a bank as `settings` say; their initial covariance and estimate are the
    /// same for all.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and what is allowed.
    pub fn of_banks(count: i64, settings: &BankSettings<'_>) -> Result<Self, Error> {
        Self::of_banks_while(count, settings, &mut || Ok(()))
    }

    /// The same, as long as `go_on` says so, which is asked a few times a second.
    ///
    /// # Errors
    /// Those of [`Fleet::of_banks`], and that of `go_on`.
    pub fn of_banks_while(
        count: i64,
        settings: &BankSettings<'_>,
        go_on: GoOn<'_>,
    ) -> Result<Self, Error> {
        let count = make::read_count(count)?;
        let typed = make!(settings.common.number_type, T => {
            let mut banks = Banks::of(bank::make::bank::<T>(settings)?)?;
            banks.grow(count, go_on)?;
            banks
        });
        Ok(Self { kept: Kept::Banks(typed), threads: None })
    }

    /// How many streams there are.
    #[must_use]
    pub fn count(&self) -> usize {
        kept!(&self.kept, streams => streams.count())
    }

    /// n
    #[must_use]
    pub fn parameters(&self) -> usize {
        kept!(&self.kept, streams => streams.parameters())
    }

    /// The type of its numbers.
    #[must_use]
    pub fn number_type(&self) -> NumberType {
        match &self.kept {
            Kept::Estimators(typed) => typed.number_type(),
            Kept::Banks(typed) => typed.number_type(),
        }
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

    /// The rule, rate, weighting and gate of a new stream by name, each with its parameters; none where
    /// streams are banks.
    #[must_use]
    pub fn describe(&self) -> Option<Description> {
        match &self.kept {
            Kept::Estimators(typed) => {
                Some(each!(typed, streams => Description::of(streams.fresh())))
            }
            Kept::Banks(_) => None,
        }
    }

    /// λ of each stream, (count,); none where it is not constant.
    ///
    /// # Errors
    /// [`Error`] says that there is no memory for so many.
    pub fn forgetting_factor(&self) -> Result<Option<Array>, Error> {
        Ok(kept!(&self.kept, streams => {
            let factors = streams.forgetting_factor()?;
            factors.map(|factors| Number::array(factors, &[streams.count()]))
        }))
    }

    /// θ of each stream, (count, n).
    ///
    /// # Errors
    /// That of `go_on`, which is asked a few times a second.
    pub fn theta(&self, go_on: GoOn<'_>) -> Result<Array, Error> {
        Ok(kept!(&self.kept, streams => Number::array(streams.theta(go_on)?, &streams.shape())))
    }

    /// The diagonal of P of each stream, (count, n), in units of 1/φ².
    ///
    /// # Errors
    /// That of `go_on`, which is asked a few times a second.
    pub fn variance(&self, go_on: GoOn<'_>) -> Result<Array, Error> {
        Ok(kept!(&self.kept, streams => Number::array(streams.variance(go_on)?, &streams.shape())))
    }

    /// Samples used by each stream since its start, (count,).
    ///
    /// # Errors
    /// That of `go_on`, which is asked a few times a second.
    pub fn samples(&self, go_on: GoOn<'_>) -> Result<Array, Error> {
        let samples = kept!(&self.kept, streams => streams.samples(go_on)?);
        Ok(Array { shape: vec![samples.len()], elements: Elements::I64(samples) })
    }

    /// How far each estimate can be trusted now, in O(n) a stream.
    ///
    /// # Errors
    /// That of `go_on`, which is asked a few times a second.
    pub fn health(&self, go_on: GoOn<'_>) -> Result<StreamHealth, Error> {
        Ok(kept!(&self.kept, streams => streams.health(go_on))?)
    }

    /// P of a stream, (n, n), in units of 1/φ².
    ///
    /// # Errors
    /// [`Error::NoStream`].
    pub fn covariance(&self, stream: i64) -> Result<Array, Error> {
        let stream = self.position(stream)?;
        match &self.kept {
            Kept::Estimators(typed) => each!(typed, streams => covariance(&streams.get(stream))),
            Kept::Banks(typed) => {
                Ok(Bank { typed: map!(typed, banks => banks.get(stream)) }.covariance())
            }
        }
    }

    /// φθ of each stream, (count,), for `phi` (count, n).
    ///
    /// # Errors
    /// [`Error::Shape`] names `phi`; that of `go_on`, which is asked a few times a second.
    pub fn predict(&self, phi: View<'_>, go_on: GoOn<'_>) -> Result<Array, Error> {
        kept!(&self.kept, streams => update::predict(&**streams, phi, go_on))
    }

    /// Back to the initial estimate and covariance, for the streams that `mask` names, or all.
    ///
    /// # Errors
    /// [`Error::Shape`] names `mask`; that of `go_on`, which is asked a few times a second where the
    /// streams are many and there is memory for a copy of them. Nothing has changed.
    pub fn reset(&mut self, mask: Option<&[bool]>, go_on: GoOn<'_>) -> Result<(), Error> {
        update::check_mask(mask, self.count())?;
        Ok(kept!(&mut self.kept, streams => streams.reset(mask, go_on))?)
    }

    /// A copy of all streams.
    ///
    /// # Errors
    /// [`Error`] says that there is no memory for it; that of `go_on`, which is asked a few times a second.
    pub fn copy(&self, go_on: GoOn<'_>) -> Result<Self, Error> {
        let kept = match &self.kept {
            Kept::Estimators(typed) => {
                Kept::Estimators(map!(typed, streams => streams.copy(go_on)?))
            }
            Kept::Banks(typed) => Kept::Banks(map!(typed, streams => streams.copy(go_on)?)),
        };
        Ok(Self { kept, threads: self.threads })
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
