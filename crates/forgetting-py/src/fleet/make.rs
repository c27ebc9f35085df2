//! A fleet from the arguments of `Fleet`.

use super::streams::{like, Streams};
use crate::arrays::{owned, Array, Number};
use crate::callable::calls_python;
use crate::choice::shape_of;
use crate::configure::{make, read_sizes};
use crate::errors::{invalid, raise};
use forgetting::rates::Rate;
use forgetting::rules::RULES;
use forgetting::saved::AnyEstimator;
use forgetting::{Dynamic, Error, Memory, Prior};
use pyo3::prelude::*;
use pyo3::types::PyString;

/// What `Fleet` was given, beside its sizes.
pub struct Arguments<'a, 'py> {
    pub rule: Option<Array<'a, 'py>>,
    pub weighting: Option<Array<'a, 'py>>,
    pub gate: Option<Array<'a, 'py>>,
    pub forgetting_factor: Option<Array<'a, 'py>>,
    pub initial_covariance: Option<Array<'a, 'py>>,
    pub initial_theta: Option<Array<'a, 'py>>,
}

/// How many streams `count` says.
///
/// # Errors
/// `InvalidInput` unless it is a whole number from 1.
pub fn read_count(count: i64) -> PyResult<usize> {
    match usize::try_from(count) {
        Ok(streams) if streams >= 1 => Ok(streams),
        _ => Err(raise(Error::value("count", count as f64, "whole numbers from 1"))),
    }
}

/// Makes a fleet from Python's arguments.
pub fn fleet<T: Number>(
    count: usize,
    parameters: i64,
    given: &Arguments<'_, '_>,
) -> PyResult<Streams<T>> {
    let sizes = read_sizes([("parameters", parameters), ("rows", 1), ("targets", 1)])?;
    let n = sizes[0];
    let (covariance, covariances) = split::<T>(
        "initial_covariance",
        given.initial_covariance,
        &[&[], &[n], &[n, n]],
        &[&[count, n], &[count, n, n]],
    )?;
    let (theta, thetas) =
        split::<T>("initial_theta", given.initial_theta, &[&[n]], &[&[count, n]])?;
    let (factor, factors) =
        split::<T>("forgetting_factor", given.forgetting_factor, &[&[]], &[&[count]])?;
    let factor = factor.map(|factor| owned::<T>("forgetting_factor", factor)).transpose()?;
    let mut fresh =
        make::<T>(sizes, [given.rule, given.weighting, given.gate], (covariance, theta))?;
    check_callables(&fresh)?;
    if given.forgetting_factor.is_some() {
        check_factor(given.rule, &fresh)?;
    }
    if let Some(factor) = factor {
        fresh = like(&fresh, Some(factor[0]), fresh.prior().clone()).map_err(raise)?;
    }
    let mut streams = Streams::of(fresh);
    streams.grow(count)?;
    if covariances.is_none() && thetas.is_none() && factors.is_none() {
        return Ok(streams);
    }
    for i in 0..count {
        let fresh = streams.fresh();
        let prior = prior(fresh.prior(), each(&covariances, i), each(&thetas, i));
        let factor = each(&factors, i).map(|factor| factor[0]);
        let stream = prior.and_then(|prior| like(fresh, factor, prior));
        streams.put(i, stream.map_err(|error| at_stream(i, error))?)?;
    }
    Ok(streams)
}

/// The value for all streams, and those for each of them with how many numbers each has.
type Split<'a, 'py, T> = (Option<Array<'a, 'py>>, Option<(Vec<T>, usize)>);

/// Tells a value for all streams from one a stream, by its shape.
///
/// # Errors
/// `InvalidInput` for a shape that is none of them.
fn split<'a, 'py, T: Number>(
    name: &str,
    given: Option<Array<'a, 'py>>,
    all: &[&[usize]],
    each: &[&[usize]],
) -> PyResult<Split<'a, 'py, T>> {
    let Some(given) = given else { return Ok((None, None)) };
    let shape = shape_of(name, given)?;
    if all.contains(&shape.as_slice()) {
        Ok((Some(given), None))
    } else if each.contains(&shape.as_slice()) {
        let width = shape[1..].iter().product();
        Ok((None, Some((owned(name, given)?, width))))
    } else {
        let tuple = |shape: &&[usize]| match *shape {
            [one] => format!("({one},)"),
            more => {
                format!("({})", more.iter().map(usize::to_string).collect::<Vec<_>>().join(", "))
            }
        };
        let shapes: Vec<_> = all.iter().chain(each).map(tuple).collect();
        let shapes = shapes.join(", ");
        Err(invalid(format!("{name} has shape {shape:?}, expected one of {shapes}")))
    }
}

fn each<T>(numbers: &Option<(Vec<T>, usize)>, i: usize) -> Option<&[T]> {
    numbers.as_ref().map(|(numbers, width)| &numbers[i * width..(i + 1) * width])
}

/// `common` with what a stream has of its own.
fn prior<T: Number>(
    common: &Prior<Dynamic<T>>,
    covariance: Option<&[T]>,
    theta: Option<&[T]>,
) -> Result<Prior<Dynamic<T>>, Error> {
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
pub fn check_callables<T: Number>(fresh: &AnyEstimator<T>) -> PyResult<()> {
    if calls_python(fresh) {
        return Err(invalid(
            "a fleet takes no function of yours as a rule, a rate or a gate: it would be called for \
             each stream and sample; use one RLS a stream",
        ));
    }
    Ok(())
}

/// Refuses a forgetting factor beside a rule that uses none, or that has a rate.
fn check_factor<T: Number>(rule: Option<Array<'_, '_>>, fresh: &AnyEstimator<T>) -> PyResult<()> {
    let name = fresh.rule().about().name;
    let uses_one = match rule {
        Some(rule) if !rule.is_instance_of::<PyString>() => {
            rule.getattr_opt("forgetting_factor")?.is_some_and(|factor| !factor.is_none())
        }
        _ => RULES.iter().any(|about| about.name == name && about.forgetting_factor),
    };
    if !uses_one {
        return Err(invalid(format!("forgetting_factor is given, but the rule {name} uses none")));
    }
    if fresh.rate().constant().is_none() {
        let rate = fresh.rate().about().name;
        return Err(invalid(format!(
            "forgetting_factor is given twice: the rule has the rate {rate}"
        )));
    }
    Ok(())
}

fn at_stream(stream: usize, error: Error) -> PyErr {
    invalid(format!("stream {stream}: {error}"))
}
