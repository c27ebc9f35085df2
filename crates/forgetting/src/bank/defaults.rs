//! Which estimators a bank is made of when none are named.

#[cfg(feature = "alloc")]
use {
    crate::covariance::{Prior, DIFFUSE},
    crate::error::Error,
    crate::estimator::{AnyEstimator, Estimator},
    crate::memory::Dynamic,
    crate::rates::{AnyRate, Constant},
    crate::rules::{RandomWalk, Rule},
    crate::weightings::{AnyWeighting, Equal},
    alloc::vec::Vec,
    forgetting_kernels::Kernels,
};

/// The process noise of each default member: from parameters that practically never change, to
/// such that each sample is nearly all that counts. On open records eight members a hundredfold apart
/// predict as well as sixteen tenfold apart.
pub const DEFAULT_NOISE: [f64; 8] = [1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4];

/// Random walks of all speeds, none of which can wind up: P stays below that of the prior.
///
/// # Errors
/// Those of the parts; none for sizes that are allowed.
#[cfg(feature = "alloc")]
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
