//! Streams before their first sample.

use super::priors::Priors;
use crate::estimator::{AnyEstimator, Estimator};
use crate::rates::{AnyRate, Constant, Rate};
use forgetting_kernels::Kernels;

/// What the streams start from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Starts<'a, T: Kernels> {
    pub fresh: &'a AnyEstimator<T>,
    /// λ of each stream; empty if all have that of a new one
    pub factors: &'a [T],
    pub priors: &'a Priors<T>,
}

impl<T: Kernels> Starts<'_, T> {
    /// λ of a stream.
    pub fn forgetting_factor(&self, stream: usize) -> T {
        let usual = || self.fresh.rate().constant().unwrap_or(T::ONE);
        self.factors.get(stream).copied().unwrap_or_else(usual)
    }

    /// A stream before its first sample.
    pub fn estimator(&self, stream: usize) -> AnyEstimator<T> {
        let (rule, weighting) = (self.fresh.rule().clone(), self.fresh.weighting().clone());
        let rate = match Constant::new(self.forgetting_factor(stream)) {
            Ok(constant) => AnyRate::Constant(constant),
            Err(_) => self.fresh.rate().clone(),
        };
        Estimator::new(rule, rate, weighting, self.priors.get(stream).clone())
    }
}
