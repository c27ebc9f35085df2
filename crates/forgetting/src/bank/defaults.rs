//! Which estimators a bank is made of when none are named.

#[cfg(feature = "alloc")]
use {
    crate::covariance::{Prior, DIFFUSE},
    crate::error::Error,
    crate::estimator::{AnyEstimator, Estimator},
    crate::memory::Dynamic,
    crate::mixers::{mlpol::Mlpol, AnyMixer},
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

/// The weight beforehand of each default member over that of the next slower one. Where nothing changes the
/// slow members are so alike that it takes long to give up the faster ones of them; with this they start
/// behind. A smaller one costs more where parameters jump than it gains where they rest.
pub const DEFAULT_PRIOR_RATIO: f64 = 0.93;

/// What mixes the default members: [`mlpol`](crate::mixers::mlpol) with [`DEFAULT_PRIOR_RATIO`].
///
/// # Errors
/// Those of the sizes; none for as many members as there are by default.
#[cfg(feature = "alloc")]
pub fn default_mixer<T: Kernels>() -> Result<AnyMixer<Dynamic<T>>, Error> {
    let memory = Dynamic::new(DEFAULT_NOISE.len(), 1, 1)?;
    Ok(AnyMixer::Mlpol(Mlpol::new(T::from_f64(DEFAULT_PRIOR_RATIO), memory)?))
}

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
