//! An estimator from the arguments of `RLS`.

use crate::arrays::{with_slice, Array, Number};
use crate::callable;
use crate::choice::{shape_of, Choice};
use crate::errors::{invalid, raise};
use forgetting::choice::Parameter;
use forgetting::gates::{AnyGate, GATES};
use forgetting::rates::{AnyRate, RATES};
use forgetting::rules::{Rule, RULES};
use forgetting::saved::AnyEstimator;
use forgetting::weightings::{AnyWeighting, WEIGHTINGS};
use forgetting::{Dynamic, Error, Estimator, Memory, Prior};
use pyo3::prelude::*;

/// Sizes as Python gives them: whole numbers of either sign, the range of which the core checks.
///
/// # Errors
/// `InvalidInput` names a negative one.
pub fn read_sizes(sizes: [(&'static str, i64); 3]) -> PyResult<[usize; 3]> {
    let mut read = [0; 3];
    for (read, (name, size)) in read.iter_mut().zip(sizes) {
        *read = usize::try_from(size)
            .map_err(|_| raise(Error::value(name, size as f64, "whole numbers from 1 to 32768")))?;
    }
    Ok(read)
}

/// Makes an estimator from Python's arguments: sizes; rule, weighting and gate; initial values.
pub fn make<T: Number>(
    [parameters, rows, targets]: [usize; 3],
    [rule, weighting, gate]: [Option<Array<'_, '_>>; 3],
    (covariance, theta): (Option<Array<'_, '_>>, Option<Array<'_, '_>>),
) -> PyResult<AnyEstimator<T>> {
    let memory = Dynamic::<T>::new(parameters, rows, targets).map_err(raise)?;
    let (rule, rate) = read_rule(rule, memory)?;
    let (weighting, gate) = (read_weighting(weighting, memory)?, read_gate(gate, memory)?);
    let prior = read_prior(memory, covariance)?;
    let prior = match theta {
        None => prior,
        Some(theta) => prior.with_theta(&read_theta(memory, theta)?).map_err(raise)?,
    };
    Ok(Estimator::new(rule, rate, weighting, prior).with_gate(gate))
}

fn read_weighting<T: Number>(
    object: Option<Array<'_, '_>>,
    memory: Dynamic<T>,
) -> PyResult<AnyWeighting<Dynamic<T>>> {
    let choice = match object {
        None => Choice::named("equal"),
        Some(object) => Choice::read("weighting", object)?,
    };
    let known = WEIGHTINGS.iter().find(|about| about.name == choice.name);
    choice.make("weighting", known.map(|about| about.parameters), |name, values| {
        AnyWeighting::named(name, values, memory)
    })
}

/// The gate; a callable is one, too.
fn read_gate<T: Number>(
    object: Option<Array<'_, '_>>,
    memory: Dynamic<T>,
) -> PyResult<AnyGate<Dynamic<T>>> {
    let choice = match object {
        None => Choice::named("open"),
        Some(object) if callable::is_plain(object)? => {
            return Ok(AnyGate::GateFunction(callable::gate(object)));
        }
        Some(object) => Choice::read("gate", object)?,
    };
    if let Some(asked) = object.and_then(|object| choice.callable(object.py(), "function")) {
        return Ok(AnyGate::GateFunction(callable::gate(&asked)));
    }
    let known = GATES.iter().find(|about| about.name == choice.name);
    choice.make("gate", known.map(|about| about.parameters), |name, values| {
        AnyGate::named(name, values, memory)
    })
}

type RuleAndRate<T> = (Rule<Dynamic<T>>, AnyRate<Dynamic<T>>);

/// The rule, and the rate that its `forgetting_factor` names.
pub fn read_rule<T: Number>(
    object: Option<Array<'_, '_>>,
    memory: Dynamic<T>,
) -> PyResult<RuleAndRate<T>> {
    let choice = match object {
        None => Choice::with_number("subspace", "threshold", 1e-6),
        Some(object) => Choice::read("rule", object)?,
    };
    let about = RULES.iter().find(|about| about.name == choice.name);
    let rule = choice.make("rule", about.map(|about| about.parameters), |name, values| {
        Rule::named(name, values, memory)
    })?;
    let factor = object.and_then(|object| object.getattr_opt("forgetting_factor").ok().flatten());
    let rate = match factor {
        // a rule without a forgetting factor reports that it forgets nothing by it
        None if about.is_some_and(|about| !about.forgetting_factor) => constant(1.0),
        Some(factor) if factor.is_none() => constant(1.0),
        None => constant(0.99),
        Some(factor) => match factor.extract::<f64>() {
            Ok(number) => constant(number),
            Err(_) => Choice::read("forgetting_factor", &factor)?,
        },
    };
    Ok((rule, make_rate(&rate, object, memory)?))
}

fn make_rate<T: Number>(
    rate: &Choice,
    rule: Option<Array<'_, '_>>,
    memory: Dynamic<T>,
) -> PyResult<AnyRate<Dynamic<T>>> {
    let known: Option<&[Parameter]> =
        RATES.iter().find(|about| about.name == rate.name).map(|about| about.parameters);
    if let Some(asked) = rule.and_then(|rule| rate.callable(rule.py(), "function")) {
        return Ok(AnyRate::Function(callable::rate(&asked)));
    }
    rate.make("rate", known, |name, values| AnyRate::named(name, values, memory))
}

fn constant(forgetting_factor: f64) -> Choice {
    Choice::with_number("constant", "forgetting_factor", forgetting_factor)
}

fn read_prior<T: Number>(
    memory: Dynamic<T>,
    covariance: Option<Array<'_, '_>>,
) -> PyResult<Prior<Dynamic<T>>> {
    let Some(given) = covariance else {
        return Prior::scalar(memory, T::from_f64(100.0)).map_err(raise);
    };
    let dimensions = shape_of("initial_covariance", given)?.len();
    with_slice("initial_covariance", given, |values| {
        match (dimensions, values) {
            (0, [variance]) => Prior::scalar(memory, *variance),
            (1, values) => Prior::diagonal(memory, values),
            (_, values) => Prior::dense(memory, values),
        }
        .map_err(raise)
    })
}

/// (n,) or (n, targets) as targets x n.
fn read_theta<T: Number>(memory: Dynamic<T>, theta: Array<'_, '_>) -> PyResult<Vec<T>> {
    let (n, m) = (memory.parameters(), memory.targets());
    let shape = shape_of("initial_theta", theta)?;
    if shape != [n, m] && !(m == 1 && shape == [n]) {
        let wanted = if m == 1 { format!("({n},)") } else { format!("({n}, {m})") };
        return Err(invalid(format!("initial_theta has shape {shape:?}, expected {wanted}")));
    }
    with_slice("initial_theta", theta, |values: &[T]| {
        Ok((0..m).flat_map(|t| (0..n).map(move |i| values[i * m + t])).collect())
    })
}
