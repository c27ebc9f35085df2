//! The first samples, when θ is far from where it will end and ψ says little: filters are contracted
//! towards 1, and samples count less. Both fade out over some forty samples a parameter.

use forgetting_kernels::Real;

/// Samples a parameter over which the start fades out.
const SAMPLES: f64 = 40.0;
/// The first sample counts exp(−5) of a later one.
const FIRST_WEIGHT: f64 = 5.0;
/// Times [`SAMPLES`] after which nothing of it is left.
const OVER: f64 = 40.0;

/// What is left of the start: 1 at the first sample, 0 when it is over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start(f64);

impl Start {
    /// After so many samples of a model of so many parameters.
    pub fn after(samples: u64, parameters: usize) -> Self {
        let age = samples as f64 / (SAMPLES * parameters as f64);
        Self(if age < OVER { Real::exp(-age) } else { 0.0 })
    }

    /// κ: the j-th coefficient of a filter is multiplied by κʲ.
    pub fn contraction(self) -> f64 {
        1.0 - self.0
    }

    /// By what the regressor and the error of the next sample are multiplied.
    pub fn scale(self) -> f64 {
        if self.0 == 0.0 {
            return 1.0;
        }
        Real::exp(-0.5 * FIRST_WEIGHT * self.0)
    }
}
