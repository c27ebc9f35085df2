//! What is between forgetting and measuring, for those who ask: P̄ and the whitened innovation.

use crate::innovation::whiten_errors;
use crate::update::Whitened;
use crate::{Factor, Memory, Sample, Work};

/// What is kept of each sample, none of it unless asked for. Not state.
#[derive(Clone, Debug)]
pub(crate) struct Between<M: Memory> {
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

impl<M: Memory> Between<M> {
    /// Keeps nothing.
    pub fn new() -> Self {
        Self { prior: None, innovations: None }
    }

    /// Keeps P̄ from now on, or no longer; `factor` is P.
    pub fn keep_prior(&mut self, keep: bool, factor: &Factor<M>) {
        if keep != self.prior.is_some() {
            self.prior = keep.then(|| factor.clone());
        }
    }

    /// Keeps whitened innovations from now on, or no longer. Those of one row need no keeping.
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

    /// Whether P̄ is kept, so that it must not be passed over.
    #[inline]
    pub fn keeps_prior(&self) -> bool {
        self.prior.is_some()
    }

    /// P̄ of the last sample.
    pub fn prior(&self) -> Option<&Factor<M>> {
        self.prior.as_ref()
    }

    /// Takes note of the sample before the rule sees it.
    #[inline]
    pub fn take(&mut self, sample: &Sample<'_, M>) {
        if let Some(kept) = &mut self.innovations {
            kept.regressors.as_mut().copy_from_slice(sample.regressors());
            kept.errors.as_mut().copy_from_slice(sample.errors());
        }
    }

    /// A copy of P that is to become P̄, if that is asked for.
    #[inline]
    pub fn copy(&mut self, factor: &Factor<M>) -> Option<&mut Factor<M>> {
        let prior = self.prior.as_mut()?;
        prior.copy_from(factor);
        Some(prior)
    }

    /// Takes note of P̄.
    #[inline]
    pub fn look(&mut self, factor: &Factor<M>, work: &mut Work<M>) {
        self.copy(factor);
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

    /// L⁻¹e of a sample of several rows, if it was kept.
    #[inline]
    pub fn whitened(&self) -> Whitened<'_, M::Real> {
        match &self.innovations {
            Some(kept) => Whitened::Rows(kept.errors.as_ref()),
            None => Whitened::Unknown,
        }
    }
}
