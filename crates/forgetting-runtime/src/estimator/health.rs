//! What the monitor over an estimator has found.

use crate::number::{Array, Elements, Number};
use forgetting::AnyEstimator;

/// What the monitor has found; see [`forgetting::Health`].
#[derive(Clone, Debug, PartialEq)]
pub struct Health {
    /// whether the weakest direction has wound up
    pub windup: bool,
    /// whether the weakest direction is informed now
    pub informed: bool,
    /// the weakest direction, (n,), a unit vector
    pub direction: Array,
    /// the smallest variance of each parameter so far, (n,)
    pub least_variances: Array,
    /// the variance in P along the direction
    pub variance: f64,
    /// that variance over what it was when the direction was last informed
    pub growth: f64,
    /// samples since it was last informed
    pub since_informed: u64,
    /// samples since each parameter was excited, (n,) counts
    pub since_excited: Array,
    /// samples watched
    pub samples: u64,
    /// samples in a block
    pub block: f64,
    /// estimate of the variance of the whitened noise; NaN before the first sample
    pub noise_variance: f64,
    /// lag-one correlation of the normalized innovations, in [−1, 1]
    pub correlation: f64,
    /// number of samples that the two estimates before stand on
    pub weight: f64,
}

impl Health {
    /// Nothing without a monitor.
    pub(crate) fn of<T: Number>(estimator: &AnyEstimator<T>) -> Option<Self> {
        let health = estimator.health()?;
        let shape = [health.direction.len()];
        let silence = health.since_excited.iter().map(|age| age.to_f64() as i64).collect();
        Some(Self {
            windup: health.windup,
            informed: health.informed,
            direction: T::array(health.direction.to_vec(), &shape),
            least_variances: T::array(health.least_variances.to_vec(), &shape),
            variance: health.variance.to_f64(),
            growth: health.growth.to_f64(),
            since_informed: health.since_informed,
            since_excited: Array { shape: shape.into(), elements: Elements::I64(silence) },
            samples: health.samples,
            block: health.block.to_f64(),
            noise_variance: health.noise_variance.to_f64(),
            correlation: health.correlation.to_f64(),
            weight: health.weight.to_f64(),
        })
    }
}
