//! A fleet from its settings.

use super::streams::Streams;
use crate::choice::has_function;
use crate::configure;
use crate::error::Error;
use crate::estimator::record::{GoOn, Pause};
use crate::number::{Number, View};
use crate::settings::Settings;
use crate::shape::either;
use forgetting::rates::{AnyRate, Constant, Rate};
use forgetting::{AnyEstimator, Dynamic, Estimator, Memory, Prior};
use std::borrow::Cow;

/// A number of streams.
///
/// # Errors
/// [`Error::Core`] names `count` unless it is from 0.
pub(super) fn read_count(count: i64) -> Result<usize, Error> {
    usize::try_from(count)
        .map_err(|_| forgetting::Error::value("count", count as f64, "whole numbers from 0").into())
}

/// Makes `count` streams.
pub(super) fn streams<T: Number>(
    count: usize,
    settings: &Settings<'_>,
    forgetting_factor: Option<View<'_>>,
    go_on: GoOn<'_>,
) -> Result<Streams<T>, Error> {
    check_single(settings)?;
    let with_factor = settings.with_factor();
    let settings = if forgetting_factor.is_some() { &with_factor } else { settings };
    let n = settings.parameters;
    let (covariance, covariances) = split::<T>(
        "initial_covariance",
        settings.initial_covariance,
        &[&[], &[n], &[n, n]],
        &[&[count, n], &[count, n, n]],
    )?;
    let (theta, thetas) =
        split::<T>("initial_theta", settings.initial_theta, &[&[n]], &[&[count, n]])?;
    let (factor, factors) =
        split::<T>("forgetting_factor", forgetting_factor, &[&[]], &[&[count]])?;
    let mut fresh = configure::estimator::<T>(settings, covariance, theta)?;
    check_functions(&fresh)?;
    if forgetting_factor.is_some() {
        check_factor(settings, &fresh)?;
    }
    if let Some(factor) = factor {
        let factor = T::read(factor.numbers())[0];
        fresh = like(&fresh, Some(factor), fresh.prior().clone())?;
    }
    let mut streams = Streams::of(fresh);
    streams.grow(count, go_on)?;
    if covariances.is_none() && thetas.is_none() && factors.is_none() {
        return Ok(streams);
    }
    let mut pause = Pause::new(go_on, 1, n);
    for stream in 0..count {
        pause.after(1)?;
        let own = |numbers| own(numbers, stream);
        let factor = own(&factors).map(|factor| factor[0]);
        let fresh = streams.fresh();
        let prior = prior(fresh.prior(), own(&covariances), own(&thetas));
        let estimator = prior.and_then(|prior| like(fresh, factor, prior));
        streams.put(stream, estimator.map_err(|error| Error::Stream { stream, error })?)?;
    }
    Ok(streams)
}

/// Refuses settings that a stream cannot have.
fn check_single(settings: &Settings<'_>) -> Result<(), Error> {
    if (settings.rows, settings.targets) != (1, 1) {
        return Err(Error::unsupported("a stream has one row and one target"));
    }
    if settings.monitor {
        return Err(Error::unsupported("a stream of a fleet is not monitored"));
    }
    Ok(())
}

/// Numbers of each stream, and how many each has.
type Each<'a, T> = Option<(Cow<'a, [T]>, usize)>;

/// Tells a value for all streams from one a stream, by its shape.
///
/// # Errors
/// [`Error::Shape`] for a shape that is none of them.
fn split<'a, T: Number>(
    name: &str,
    value: Option<View<'a>>,
    all: &[&[usize]],
    each: &[&[usize]],
) -> Result<(Option<View<'a>>, Each<'a, T>), Error> {
    let Some(value) = value else { return Ok((None, None)) };
    let shape = value.shape();
    if all.contains(&shape) {
        Ok((Some(value), None))
    } else if each.contains(&shape) {
        let width = shape[1..].iter().product();
        Ok((None, Some((T::read(value.numbers()), width))))
    } else {
        let shapes: Vec<_> = all.iter().chain(each).collect();
        Err(Error::shape(name, shape, either(&shapes)))
    }
}

fn own<'a, T: Clone>(numbers: &'a Each<'_, T>, stream: usize) -> Option<&'a [T]> {
    numbers.as_ref().map(|(numbers, width)| &numbers[stream * width..(stream + 1) * width])
}

/// `common` with what a stream has of its own.
fn prior<T: Number>(
    common: &Prior<Dynamic<T>>,
    covariance: Option<&[T]>,
    theta: Option<&[T]>,
) -> Result<Prior<Dynamic<T>>, forgetting::Error> {
    let memory = common.memory();
    let prior = match covariance {
        None => common.clone(),
        Some(p) if p.len() == memory.parameters() => {
            Prior::diagonal(memory, p)?.with_theta(common.theta())?
        }
        Some(p) => Prior::dense(memory, p)?.with_theta(common.theta())?,
    };
    match theta {
        None => Ok(prior),
        Some(theta) => prior.with_theta(theta),
    }
}

/// Refuses functions of the user's: they would be called once for each stream and sample.
pub(super) fn check_functions<T: Number>(fresh: &AnyEstimator<T>) -> Result<(), Error> {
    if has_function(fresh) {
        return Err(Error::unsupported(
            "a fleet takes no function of yours as a rule, a rate or a gate: it would be called for \
             each stream and sample; use one RLS a stream",
        ));
    }
    Ok(())
}

/// Refuses a forgetting factor beside a rule that uses none, or that has a rate.
fn check_factor<T: Number>(settings: &Settings<'_>, fresh: &AnyEstimator<T>) -> Result<(), Error> {
    let name = fresh.rule().about().name;
    if !settings.forgetting_factor.is_used(name) {
        let reason = format!("forgetting_factor is given, but the rule {name} uses none");
        return Err(Error::unsupported(reason));
    }
    if fresh.rate().constant().is_none() {
        let rate = fresh.rate().about().name;
        let reason = format!("forgetting_factor is given twice: the rule has the rate {rate}");
        return Err(Error::unsupported(reason));
    }
    Ok(())
}

/// An estimator like `fresh` with another prior or another forgetting factor.
///
/// # Errors
/// [`forgetting::Error::Value`] names a forgetting factor that is out of range.
fn like<T: Number>(
    fresh: &AnyEstimator<T>,
    forgetting_factor: Option<T>,
    prior: Prior<Dynamic<T>>,
) -> Result<AnyEstimator<T>, forgetting::Error> {
    let rate = match forgetting_factor {
        Some(factor) => AnyRate::Constant(Constant::new(factor)?),
        None => fresh.rate().clone(),
    };
    let (rule, weighting) = (fresh.rule().clone(), fresh.weighting().clone());
    Ok(Estimator::new(rule, rate, weighting, prior).with_gate(fresh.gate().clone()))
}
