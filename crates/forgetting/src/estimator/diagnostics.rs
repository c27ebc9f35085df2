//! What an estimator records of each sample on request: P after forgetting, and the whitened
//! innovation.

use crate::covariance::Factor;
use crate::memory::Memory;
use crate::sample::{whiten_errors, Sample, Whitened, Work};

/// What is recorded of the last sample: nothing unless it was asked for. Not part of the state.
#[derive(Clone, Debug)]
pub(super) struct Diagnostics<M: Memory> {
    prior: Option<Factor<M>>,
    innovations: Option<Innovations<M>>,
}

/// L⁻¹e of a sample of several rows.
#[derive(Clone, Debug)]
struct Innovations<M: Memory> {
    /// p x n: φ̄ as it was before the rule rotated it or dropped rows
    regressors: M::Rows,
    /// p x m: ē, then L⁻¹e
    errors: M::Errors,
    /// p x p: a buffer
    identity: M::Noise,
}

impl<M: Memory> Diagnostics<M> {
    /// Records nothing.
    pub fn new() -> Self {
        Self { prior: None, innovations: None }
    }

    /// Records P̄ from now on, or no longer; `factor` is P.
    pub fn keep_prior(&mut self, keep: bool, factor: &Factor<M>) {
        if keep != self.prior.is_some() {
            self.prior = keep.then(|| factor.clone());
        }
    }

    /// Records whitened innovations from now on, or no longer. One row needs no recording.
    pub fn keep_innovations(&mut self, keep: bool, memory: M) {
        let keep = keep && memory.rows() > 1;
        if keep != self.innovations.is_some() {
            self.innovations = keep.then(|| Innovations {
                regressors: memory.regressors(),
                errors: memory.errors(),
                identity: memory.noise(),
            });
        }
    }

    /// Whether P̄ is recorded, so that forgetting and measuring must be two steps.
    #[inline]
    pub fn keeps_prior(&self) -> bool {
        self.prior.is_some()
    }

    /// P̄ of the last sample in other units: S P̄ S with S = diag(`ratios`).
    pub fn change_units(&mut self, ratios: &[M::Real]) {
        if let Some(prior) = &mut self.prior {
            prior.scale_each(ratios);
        }
    }

    /// P̄ of the last sample.
    pub fn prior(&self) -> Option<&Factor<M>> {
        self.prior.as_ref()
    }

    /// Records the sample before the rule changes it.
    #[inline]
    pub fn record_sample(&mut self, sample: &Sample<'_, M>) {
        if let Some(kept) = &mut self.innovations {
            kept.regressors.as_mut().copy_from_slice(sample.regressors());
            kept.errors.as_mut().copy_from_slice(sample.errors());
        }
    }

    /// A copy of P, for the rule to make P̄ of it, if P̄ is asked for.
    #[inline]
    pub fn copy_prior(&mut self, factor: &Factor<M>) -> Option<&mut Factor<M>> {
        let prior = self.prior.as_mut()?;
        prior.copy_from(factor);
        Some(prior)
    }

    /// Records P̄ = `factor`, and the innovation whitened with it.
    #[inline]
    pub fn record_prior(&mut self, factor: &Factor<M>, work: &mut Work<M>) {
        self.copy_prior(factor);
        if let Some(kept) = &mut self.innovations {
            whiten_errors(
                factor,
                kept.regressors.as_ref(),
                work.first.as_mut(),
                kept.errors.as_mut(),
                kept.identity.as_mut(),
            );
        }
    }

    /// L⁻¹e of a sample of several rows, if it was recorded.
    #[inline]
    pub fn whitened(&self) -> Whitened<'_, M::Real> {
        match &self.innovations {
            Some(kept) => Whitened::Rows(kept.errors.as_ref()),
            None => Whitened::Unknown,
        }
    }
}
