//! What a rate, a weighting or a gate may judge a sample by, before it is used.

use super::Sample;
use crate::covariance::Factor;
use crate::memory::Memory;
use forgetting_kernels::Real;

/// What a rate, a weighting or a gate is shown of a sample.
///
/// Errors are whitened by Γ, or by nothing where it is estimated: what needs a scale divides by
/// [`Evidence::noise_variance`]. A weighting and a gate see them as they are. A rate sees them clipped,
/// that is multiplied by the weight w: an outlier that moves θ little is no reason to forget. No
/// statistic exceeds [`Real::CEILING`].
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a, 'b, M: Memory> {
    /// the whitened sample, weighted by √w; after the rule, as the rule left it
    pub sample: &'a Sample<'b, M>,
    /// P, before forgetting in `forgetting_factor`, after the measurement in `learn`
    pub factor: &'a Factor<M>,
    /// e, p x m numbers, row by row
    pub errors: &'a [M::Real],
    /// ‖e‖² over the rows, averaged over the targets
    pub squared_error: M::Real,
    /// tr S with S = φ̄Pφ̄ᵀ without the weight and the P before forgetting, if asked for, else 0
    pub leverage: M::Real,
    /// tr eᵀ(I + S)⁻¹e averaged over the targets, if asked for, else 0
    pub normalized_error: M::Real,
    /// p
    pub rows: usize,
    /// m
    pub targets: usize,
    /// samples used so far, without this one
    pub samples: u64,
    /// what errors are judged by: 1 where Γ is given, else their variance, once it is known
    pub noise_variance: Option<M::Real>,
}

impl<M: Memory> Evidence<'_, '_, M> {
    /// ‖e‖² over the rows, of the target where it is largest.
    #[inline]
    pub fn largest_squared_error(&self) -> M::Real {
        if self.targets == 1 {
            return self.squared_error;
        }
        let squared = |target: usize| {
            let errors = self.errors.iter().skip(target).step_by(self.targets);
            errors.fold(M::Real::ZERO, |sum, &e| sum + e * e)
        };
        (0..self.targets).fold(M::Real::ZERO, |largest, target| largest.max(squared(target)))
    }

    /// A square of errors over the variance of the noise; 0 while that is not known.
    #[inline]
    pub fn standardized(&self, squared: M::Real) -> M::Real {
        let limit = M::Real::CEILING;
        match self.noise_variance {
            Some(variance) => (squared / variance).max(-limit).min(limit),
            None => M::Real::ZERO,
        }
    }
}

/// What a design uses beside the errors; each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Needs {
    /// nothing
    Errors,
    /// [`Evidence::leverage`]: p n²/2 operations
    Leverage,
    /// [`Evidence::normalized_error`]: p n²/2 + p² n operations
    NormalizedError,
}
