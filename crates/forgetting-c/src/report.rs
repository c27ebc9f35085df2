//! What an update reports, and what a monitor has found.

use forgetting::Update;
use forgetting_kernels::Real;

/// What became of a sample; `T` is the number type of the estimator.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Report<T> {
    /// y − φθ with the θ of before
    pub error: T,
    /// φP̄φᵀ
    pub leverage: T,
    /// λ of this sample
    pub forgetting_factor: T,
    /// the weight that the weighting gave it
    pub weight: T,
    /// 1 if it was learned from, 0 if it was left out
    pub used: u8,
    /// 1 if P has wound up
    pub windup: u8,
    /// what the gate decided: 0 update, 1 freeze, 2 hold
    pub gate: u8,
    /// 0
    pub reserved: u8,
}

/// What a monitor has found.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Health {
    /// samples monitored
    pub samples: u64,
    /// samples since the weakest direction was last informed
    pub since_informed: u64,
    /// the variance in P along the weakest direction
    pub variance: f64,
    /// that over what it was when the direction was last informed
    pub growth: f64,
    /// the variance of the noise; NaN before the first sample
    pub noise_variance: f64,
    /// lag-one correlation of the errors, in [−1, 1]
    pub correlation: f64,
    /// how many samples are behind the last two
    pub weight: f64,
    /// 1 if the weakest direction has wound up
    pub windup: u8,
    /// 1 if it is informed now
    pub informed: u8,
    /// 0
    pub reserved: [u8; 6],
}

impl<T: Real> From<Update<'_, T>> for Report<T> {
    fn from(update: Update<'_, T>) -> Self {
        Self {
            error: update.error.first().copied().unwrap_or(T::ZERO),
            leverage: update.leverage,
            forgetting_factor: update.forgetting_factor,
            weight: update.weight,
            used: u8::from(update.skipped.is_none()),
            windup: u8::from(update.windup),
            gate: update.gate.code(),
            reserved: 0,
        }
    }
}

impl<T: Real> From<forgetting::Health<'_, T>> for Health {
    fn from(health: forgetting::Health<'_, T>) -> Self {
        Self {
            samples: health.samples,
            since_informed: health.since_informed,
            variance: health.variance.to_f64(),
            growth: health.growth.to_f64(),
            noise_variance: health.noise_variance.to_f64(),
            correlation: health.correlation.to_f64(),
            weight: health.weight.to_f64(),
            windup: u8::from(health.windup),
            informed: u8::from(health.informed),
            reserved: [0; 6],
        }
    }
}
