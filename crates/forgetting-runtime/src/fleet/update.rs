//! A sample for every stream of a fleet.

use super::many::Many;
use crate::error::{check_shape, Error};
use crate::number::{Array, Elements, Number, View};
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

/// Takes a sample for each stream.
pub(super) fn update<T: Number>(
    streams: &mut impl Many<T>,
    (phi, y, mask): (View<'_>, View<'_>, Option<&[bool]>),
    elapsed: Option<View<'_>>,
    outputs: &[&str],
    threads: Option<usize>,
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
    let mut error = wanted("error").then(|| vec![T::ZERO; count]);
    let mut leverage = wanted("leverage").then(|| vec![T::ZERO; count]);
    let mut skipped = wanted("skipped").then(|| vec![0; count]);
    let results = Outputs {
        error: error.as_deref_mut(),
        leverage: leverage.as_deref_mut(),
        skipped: skipped.as_deref_mut(),
    };
    let samples = Samples { phi: &phi, y: &y, mask };
    let elapsed = elapsed.map(|elapsed| read_elapsed(elapsed, count)).transpose()?;
    let used = streams.update(elapsed.as_deref(), samples, results, threads)?;
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
pub(super) fn predict<T: Number>(streams: &impl Many<T>, phi: View<'_>) -> Result<Array, Error> {
    let count = streams.shape()[0];
    let phi = read::<T>("phi", phi, &streams.shape())?;
    let mut prediction = vec![T::ZERO; count];
    streams.predict(&phi, &mut prediction)?;
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
