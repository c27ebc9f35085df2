//! A sample for every stream of a fleet.

use super::many::Many;
use super::pieces::zeros;
use super::threads::Wishes;
use super::{kept, Fleet, Kept};
use crate::error::{check_shape, Error};
use crate::estimator::GoOn;
use crate::number::{each, Array, Elements, Number, View};
use forgetting::fleet::{Outputs, Samples};
use forgetting::Skip;
use std::borrow::Cow;

/// What a sample of each stream did. An output that was not asked for is none.
#[derive(Clone, Debug, PartialEq)]
pub struct FleetUpdate {
    /// y − φθ with the θ of before, (count,), in units of y; NaN where there was no sample or it
    /// was refused
    pub error: Option<Array>,
    /// variance of the prediction in units of the noise variance, (count,); NaN as above
    pub leverage: Option<Array>,
    /// (count,) codes: 0 where the sample was used, else [`Skip::code`](crate::Skip::code) or
    /// [`FleetUpdate::REFUSED`]
    pub skipped: Option<Array>,
    /// number of streams that used their sample
    pub used: usize,
}

impl FleetUpdate {
    /// Names of the outputs that are kept when none are named.
    pub const DEFAULT_OUTPUTS: [&'static str; 2] = ["error", "skipped"];
    /// Names of all outputs.
    pub const OUTPUTS: [&'static str; 3] = ["error", "leverage", "skipped"];
    /// The code of a stream that refused its sample.
    pub const REFUSED: u8 = forgetting::fleet::REFUSED;

    /// All codes with their words, none where the sample was used.
    pub fn codes() -> impl Iterator<Item = (u8, Option<&'static str>)> {
        let reasons = Skip::ALL.iter().map(|reason| (reason.code(), Some(reason.word())));
        [(0, None)].into_iter().chain(reasons).chain([(Self::REFUSED, Some("refused"))])
    }
}

impl Fleet {
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
        self.take(elapsed, samples, outputs, None)
    }

    /// The same, as long as `go_on` says so, which is asked a few times a second where an update of so many
    /// streams takes long.
    ///
    /// # Errors
    /// Those of [`Fleet::update_after`], and that of `go_on`; nothing has changed.
    pub fn update_while(
        &mut self,
        elapsed: Option<View<'_>>,
        samples: (View<'_>, View<'_>, Option<&[bool]>),
        outputs: Option<&[&str]>,
        go_on: GoOn<'_>,
    ) -> Result<FleetUpdate, Error> {
        self.take(elapsed, samples, outputs, Some(go_on))
    }

    fn take(
        &mut self,
        elapsed: Option<View<'_>>,
        samples: (View<'_>, View<'_>, Option<&[bool]>),
        outputs: Option<&[&str]>,
        go_on: Option<GoOn<'_>>,
    ) -> Result<FleetUpdate, Error> {
        let outputs = outputs.unwrap_or(&FleetUpdate::DEFAULT_OUTPUTS);
        let wishes = Wishes { threads: self.threads, go_on };
        kept!(&mut self.kept, streams => {
            update(&mut **streams, samples, elapsed, outputs, wishes)
        })
    }
}

/// Takes a sample for each stream.
fn update<T: Number>(
    streams: &mut impl Many<T>,
    (phi, y, mask): (View<'_>, View<'_>, Option<&[bool]>),
    elapsed: Option<View<'_>>,
    outputs: &[&str],
    wishes: Wishes<'_>,
) -> Result<FleetUpdate, Error> {
    let count = streams.shape()[0];
    if let Some(name) = outputs.iter().find(|name| !FleetUpdate::OUTPUTS.contains(name)) {
        let allowed = FleetUpdate::OUTPUTS.join(", ");
        return Err(Error::Output { name: (*name).into(), allowed });
    }
    let phi = read::<T>("phi", phi, &streams.shape())?;
    let y = read::<T>("y", y, &[count])?;
    check_mask(mask, count)?;
    let wanted = |name| outputs.contains(&name);
    let mut error = wanted("error").then(|| zeros::<T>(count)).transpose()?;
    let mut leverage = wanted("leverage").then(|| zeros::<T>(count)).transpose()?;
    let mut skipped = wanted("skipped").then(|| zeros::<u8>(count)).transpose()?;
    let results = Outputs {
        error: error.as_deref_mut(),
        leverage: leverage.as_deref_mut(),
        skipped: skipped.as_deref_mut(),
    };
    let samples = Samples { phi: &phi, y: &y, mask };
    let elapsed = elapsed.map(|elapsed| read_elapsed(elapsed, count)).transpose()?;
    let used = streams.update(elapsed.as_deref(), samples, results, wishes)?;
    Ok(FleetUpdate {
        error: error.map(|numbers| T::array(numbers, &[count])),
        leverage: leverage.map(|numbers| T::array(numbers, &[count])),
        skipped: skipped.map(|codes| Array { shape: vec![count], elements: Elements::U8(codes) }),
        used,
    })
}

/// The time since the last sample of each stream: one for all, or (count,).
fn read_elapsed<T: Number>(elapsed: View<'_>, count: usize) -> Result<Vec<T>, Error> {
    let shape = elapsed.shape();
    if !shape.is_empty() {
        check_shape("elapsed", shape, &[count])?;
    }
    let single = shape.is_empty();
    let elapsed = T::read(elapsed.numbers());
    let refused = |x: &&T| !(x.to_f64() >= 0.0 && x.to_f64().is_finite());
    if let Some(x) = elapsed.iter().find(refused) {
        let allowed = "finite and not negative";
        return Err(forgetting::Error::value("elapsed", x.to_f64(), allowed).into());
    }
    Ok(if single { vec![elapsed[0]; count] } else { elapsed.into_owned() })
}

/// φθ of each stream.
pub(super) fn predict<T: Number>(
    streams: &impl Many<T>,
    phi: View<'_>,
    go_on: GoOn<'_>,
) -> Result<Array, Error> {
    let count = streams.shape()[0];
    let phi = read::<T>("phi", phi, &streams.shape())?;
    let mut prediction = zeros::<T>(count)?;
    streams.predict(&phi, &mut prediction, go_on)?;
    Ok(T::array(prediction, &[count]))
}

/// Refuses a mask that does not have one answer for each of `count` streams.
pub(super) fn check_mask(mask: Option<&[bool]>, count: usize) -> Result<(), Error> {
    mask.map_or(Ok(()), |mask| check_shape("mask", &[mask.len()], &[count]))
}

/// The numbers of an array of this shape.
fn read<'a, T: Number>(
    name: &str,
    values: View<'a>,
    shape: &[usize],
) -> Result<Cow<'a, [T]>, Error> {
    check_shape(name, values.shape(), shape)?;
    Ok(T::read(values.numbers()))
}
