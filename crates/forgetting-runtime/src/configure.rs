//! An estimator from its settings.

use crate::choice::{Choice, Value};
use crate::error::Error;
use crate::function::{for_gate, for_rate, for_rule};
use crate::number::{Number, View};
use crate::settings::{ForgettingFactor, Settings};
use crate::shape;
use forgetting::choice::About;
use forgetting::gates::{AnyGate, GATES};
use forgetting::rates::{AnyRate, RATES};
use forgetting::rules::{Rule, RULES};
use forgetting::weightings::{AnyWeighting, WEIGHTINGS};
use forgetting::{AnyEstimator, Dynamic, Estimator, Forgetting, Memory, Prior};

/// The estimator that `settings` say, with `initial_covariance` and `initial_theta` in the place
/// of those in the settings.
pub(crate) fn estimator<T: Number>(
    settings: &Settings<'_>,
    initial_covariance: Option<View<'_>>,
    initial_theta: Option<View<'_>>,
) -> Result<AnyEstimator<T>, Error> {
    let Settings { parameters, rows, targets, .. } = *settings;
    let memory = Dynamic::new(parameters, rows, targets)?;
    let choice = settings.rule();
    // P₀ as a matrix is factored on the way
    let dense = initial_covariance.is_some_and(|covariance| covariance.shape().len() > 1);
    let kept = if dense { 2 } else { 0 };
    memory.check_room(squares(&choice, &settings.forgetting_factor) + kept, 1)?;
    let (rule, rate) = (rule(&choice, memory)?, settings.forgetting_factor.rate(&choice.name));
    let rate = make_rate(&rate, memory)?;
    let weighting = weighting(settings.weighting.as_ref(), memory)?;
    let gate = gate(settings.gate.as_ref(), memory)?;
    let prior = prior(memory, initial_covariance)?;
    let prior = match initial_theta {
        None => prior,
        Some(theta) => prior.with_theta(&by_target(memory, theta)?)?,
    };
    let mut estimator = Estimator::new(rule, rate, weighting, prior).with_gate(gate);
    if settings.monitor {
        estimator.enable_monitor();
    }
    Ok(estimator)
}

/// How many times n x n numbers a rule, what is inside it and a rate keep.
fn squares(rule: &Choice, factor: &ForgettingFactor) -> usize {
    let inner = rule.parameters.iter().map(|(_, value)| match value {
        Value::Word(name) | Value::Choice(Choice { name, .. }) => name.as_str(),
        _ => "",
    });
    let rate = factor.rate(&rule.name);
    let of = |registry: &[About], name: &str| {
        registry.iter().find(|about| about.name == name).map_or(0, |about| about.squares)
    };
    let rules = inner.chain([rule.name.as_str()]).map(|name| of(RULES, name));
    rules.sum::<usize>() + of(RATES, &rate.name)
}

/// Refuses a copy of `estimator` for which there is no memory, or `count` of them.
pub(crate) fn check_copies<T: Number>(
    estimator: &AnyEstimator<T>,
    count: usize,
) -> Result<(), forgetting::Error> {
    let mut squares = estimator.rate().about().squares + estimator.rule().about().squares;
    estimator.rule().describe(&mut |_, value| {
        if let forgetting::choice::Value::Choice { name, .. } = value {
            let inner = RULES.iter().find(|about| about.name == name);
            squares += inner.map_or(0, |about| about.squares);
        }
    });
    // P₀ may be a matrix
    estimator.prior().memory().check_room(squares + 1, count)
}

pub(crate) fn rule<T: Number>(
    choice: &Choice,
    memory: Dynamic<T>,
) -> Result<Rule<Dynamic<T>>, Error> {
    choice.make(("rule", RULES), for_rule, |name, values| Rule::named(name, values, memory))
}

fn make_rate<T: Number>(choice: &Choice, memory: Dynamic<T>) -> Result<AnyRate<Dynamic<T>>, Error> {
    choice.make(("rate", RATES), for_rate::<T>, |name, values| AnyRate::named(name, values, memory))
}

fn weighting<T: Number>(
    choice: Option<&Choice>,
    memory: Dynamic<T>,
) -> Result<AnyWeighting<Dynamic<T>>, Error> {
    let equal = Choice::named("equal");
    // no weighting takes a function: it is then refused as the value of its parameter
    choice.unwrap_or(&equal).make(("weighting", WEIGHTINGS), for_rule, |name, values| {
        AnyWeighting::named(name, values, memory)
    })
}

fn gate<T: Number>(
    choice: Option<&Choice>,
    memory: Dynamic<T>,
) -> Result<AnyGate<Dynamic<T>>, Error> {
    let open = Choice::named("open");
    choice
        .unwrap_or(&open)
        .make(("gate", GATES), for_gate::<T>, |name, values| AnyGate::named(name, values, memory))
}

fn prior<T: Number>(
    memory: Dynamic<T>,
    covariance: Option<View<'_>>,
) -> Result<Prior<Dynamic<T>>, Error> {
    let Some(covariance) = covariance else {
        return Ok(Prior::of_data(memory));
    };
    let (n, numbers) = (memory.parameters(), T::read(covariance.numbers()));
    Ok(match (covariance.shape(), &*numbers) {
        ([], [variance]) => Prior::scalar(memory, *variance),
        (shape, variances) if shape == [n] => Prior::diagonal(memory, variances),
        (shape, covariance) if shape == [n, n] => Prior::dense(memory, covariance),
        (shape, _) => {
            let allowed = shape::either(&[vec![], vec![n], vec![n, n]]);
            return Err(Error::shape("initial_covariance", shape, allowed));
        }
    }?)
}

/// θ as (n,) or (n, targets), one target after the other.
fn by_target<T: Number>(memory: Dynamic<T>, theta: View<'_>) -> Result<Vec<T>, Error> {
    let (n, m) = (memory.parameters(), memory.targets());
    if theta.shape() != [n] || m > 1 {
        shape::check("initial_theta", theta.shape(), &[n], &[m])?;
    }
    let theta = T::read(theta.numbers());
    Ok((0..m).flat_map(|t| (0..n).map(move |i| (i, t))).map(|(i, t)| theta[i * m + t]).collect())
}
