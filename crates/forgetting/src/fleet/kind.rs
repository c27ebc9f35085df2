//! Which estimators can be streams of one fleet.

use crate::choice::bytes;
use crate::error::Error;
use crate::estimator::AnyEstimator;
use crate::gates::Gate;
use crate::memory::Memory;
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::weightings::Weighting;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// Refuses an `estimator` that differs from `fresh` in more than a constant forgetting factor,
/// the prior and the state.
///
/// # Errors
/// [`Error::Unsupported`] says what differs.
pub fn check_kind<T: Kernels>(
    fresh: &AnyEstimator<T>,
    estimator: &AnyEstimator<T>,
) -> Result<(), Error> {
    let (of_fleet, own) = (fresh.prior().memory(), estimator.prior().memory());
    let constant = |estimator: &AnyEstimator<T>| estimator.rate().constant().is_some();
    let same_rate = || match (constant(fresh), constant(estimator)) {
        (true, true) => Ok(true),
        _ => Ok(rate(fresh)? == rate(estimator)?),
    };
    check_stream(estimator)?;
    let reason = if own.parameters() != of_fleet.parameters() {
        "a stream has as many parameters as its fleet"
    } else if rule(fresh)? != rule(estimator)? {
        "a stream has the rule of its fleet, with the same parameters"
    } else if !same_rate()? {
        "a stream has the rate of its fleet; only a constant forgetting factor may differ"
    } else if weighting(fresh)? != weighting(estimator)? {
        "a stream has the weighting of its fleet"
    } else if gate(fresh)? != gate(estimator)? {
        "a stream has the gate of its fleet"
    } else {
        return Ok(());
    };
    Err(Error::Unsupported { reason })
}

/// Refuses an `estimator` that can be a stream of no fleet.
///
/// # Errors
/// [`Error::Unsupported`] says what it has that a stream has not.
pub fn check_stream<T: Kernels>(estimator: &AnyEstimator<T>) -> Result<(), Error> {
    let memory = estimator.prior().memory();
    let reason = if (memory.rows(), memory.targets()) != (1, 1) {
        "a stream has one row and one target"
    } else if estimator.health().is_some() {
        "a stream of a fleet is not monitored"
    } else {
        return Ok(());
    };
    Err(Error::Unsupported { reason })
}

/// A choice as it is saved: two are the same if their bytes are.
fn written(name: &str, each: &bytes::Each<'_>) -> Result<Vec<u8>, Error> {
    let mut written = Vec::new();
    bytes::write(&mut |bytes| written.extend_from_slice(bytes), name, each)?;
    Ok(written)
}

fn rule<T: Kernels>(estimator: &AnyEstimator<T>) -> Result<Vec<u8>, Error> {
    let rule = estimator.rule();
    written(rule.about().name, &|each| rule.describe(&mut |name, value| each(name, value)))
}

fn rate<T: Kernels>(estimator: &AnyEstimator<T>) -> Result<Vec<u8>, Error> {
    let rate = estimator.rate();
    written(rate.about().name, &|each| rate.describe(&mut |name, value| each(name, value)))
}

fn weighting<T: Kernels>(estimator: &AnyEstimator<T>) -> Result<Vec<u8>, Error> {
    let weighting = estimator.weighting();
    let each: &bytes::Each<'_> = &|each| weighting.describe(&mut |name, value| each(name, value));
    written(weighting.about().name, each)
}

fn gate<T: Kernels>(estimator: &AnyEstimator<T>) -> Result<Vec<u8>, Error> {
    let gate = estimator.gate();
    written(gate.about().name, &|each| gate.describe(&mut |name, value| each(name, value)))
}
