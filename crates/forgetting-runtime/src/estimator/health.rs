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
        let units = estimator.reciprocal_units();
        let (direction, variance) = express(&health, units);
        let silence = health.since_excited.iter().map(|age| age.to_f64() as i64).collect();
        Some(Self {
            windup: health.windup,
            informed: health.informed,
            direction: T::array(direction, &shape),
            least_variances: T::array(squared(health.least_variances, units), &shape),
            variance: variance.to_f64(),
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

/// The weakest direction and its variance in the units of the user: 1/s is `reciprocals`.
fn express<T: Number>(
    health: &forgetting::Health<'_, T>,
    reciprocals: Option<&[T]>,
) -> (Vec<T>, T) {
    let Some(reciprocals) = reciprocals else {
        return (health.direction.to_vec(), health.variance);
    };
    // first so that no square overflows
    let parts = health.direction.iter().zip(reciprocals).map(|(&x, &r)| x * r);
    let longest = parts.clone().fold(T::ZERO, |longest, x| longest.max(x.abs()));
    let direction: Vec<T> = parts.map(|x| x / longest).collect();
    let length = direction.iter().fold(T::ZERO, |sum, &x| sum + x * x).sqrt();
    let stretch = longest * length;
    (direction.iter().map(|&x| x / length).collect(), health.variance * stretch * stretch)
}

/// Variances in the units of the user.
fn squared<T: Number>(variances: &[T], reciprocals: Option<&[T]>) -> Vec<T> {
    match reciprocals {
        None => variances.to_vec(),
        Some(reciprocals) => variances.iter().zip(reciprocals).map(|(&v, &r)| v * r * r).collect(),
    }
}
