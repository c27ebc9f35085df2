//! What a monitor reports.

/// What a monitor has found.
#[derive(Clone, Copy, Debug)]
pub struct Health<'a, T> {
    /// whether the weakest direction has wound up
    pub windup: bool,
    /// whether the weakest direction is informed now
    pub informed: bool,
    /// the weakest direction, a unit vector of n numbers
    pub direction: &'a [T],
    /// the smallest variance of each parameter so far
    pub least_variances: &'a [T],
    /// the variance in P along the direction
    pub variance: T,
    /// σ² over what it was when the direction was last informed; 1 if it is informed now, unless σ²
    /// is still a thousand times that
    pub growth: T,
    /// samples since it was last informed
    pub since_informed: u64,
    /// samples since each parameter was excited
    pub since_excited: &'a [T],
    /// samples monitored
    pub samples: u64,
    /// samples in a block
    pub block: T,
    /// estimate of the variance of the whitened noise; NaN before the first sample
    pub noise_variance: T,
    /// lag-one correlation of the normalized innovations, in [−1, 1]
    pub correlation: T,
    /// number of samples behind `noise_variance` and `correlation`, weighted with the products of λ
    pub weight: T,
}
