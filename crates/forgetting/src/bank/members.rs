//! Which estimators a bank is made of when none are named, and what they may be.

use crate::covariance::{Prior, DIFFUSE};
use crate::error::Error;
use crate::estimator::{AnyEstimator, Estimator};
use crate::memory::Dynamic;
use crate::rates::{AnyRate, Constant};
use crate::rules::{RandomWalk, Rule};
use crate::weightings::{AnyWeighting, Equal};
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// The process noise of each default member: from parameters that practically never change, to
/// such that each sample is nearly all that counts. On open records eight members a hundredfold apart
/// predict as well as sixteen tenfold apart.
pub const DEFAULT_NOISE: [f64; 8] = [1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4];

/// Random walks of all speeds, none of which can wind up: P stays below that of the prior.
///
/// # Errors
/// Those of the parts; none for sizes that are allowed.
pub fn default_members<T: Kernels>(memory: Dynamic<T>) -> Result<Vec<AnyEstimator<T>>, Error> {
    let diffuse = T::from_f64(DIFFUSE);
    let member = |noise: &f64| {
        let rule = RandomWalk::bounded(T::from_f64(*noise), diffuse, memory)?;
        let (rate, weighting) = (Constant::new(T::ONE)?, Equal::new());
        Ok(Estimator::new(
            Rule::RandomWalk(rule),
            AnyRate::Constant(rate),
            AnyWeighting::Equal(weighting),
            Prior::scalar(memory, diffuse)?,
        ))
    };
    DEFAULT_NOISE.iter().map(member).collect()
}

/// The sizes of members that can be one bank.
pub(super) fn common_memory<T: Kernels>(members: &[AnyEstimator<T>]) -> Result<Dynamic<T>, Error> {
    let Some(first) = members.first() else {
        return Err(Error::Unsupported { reason: "a bank has at least one member" });
    };
    let memory = first.prior().memory();
    let reason = if members.iter().any(|member| member.prior().memory() != memory) {
        "all members of a bank have the same parameters, rows and targets"
    } else if members.iter().any(|member| member.prior().is_of_data()) {
        "the prior of a member is given: it is the bank that follows the data"
    } else {
        return Ok(memory);
    };
    Err(Error::Unsupported { reason })
}
