//! The one recursion (GF-RLS, Theorem 1), sample by sample.
//!
//! ```text
//! forget    R̄ = R − F                          R = P⁻¹; only P changes
//! measure   R₊ = R̄ + φᵀ Γ⁻¹ φ                  P and the gain
//! correct   θ₊ = θ + R₊⁻¹ φᵀ Γ⁻¹ (y − φ θ)     θ changes here and nowhere else
//! ```

mod accessors;
#[cfg(feature = "alloc")]
mod any;
mod design;
mod diagnostics;
mod many;
mod state;
mod statistics;
mod steps;

use crate::covariance::Prior;
use crate::error::Error;
use crate::gates::{AnyGate, Open};
use crate::memory::Memory;
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::sample::{Noise, SampleBuffers, Update, Work};
use crate::weightings::Weighting;
#[cfg(feature = "alloc")]
pub use any::AnyEstimator;
use design::Design;
use diagnostics::Diagnostics;
use forgetting_kernels::kernel::outcome::Outcome;
use state::EstimatorState;

/// Recursive least squares with the forgetting rule `F`, the rate `R` and the weighting `W`.
///
/// ```
/// use forgetting::{Constant, Equal, Estimator, Fixed, Prior, Subspace};
///
/// let memory = Fixed::<f64, 2>::new();
/// let mut estimator = Estimator::new(
///     Subspace::new(1e-3)?,
///     Constant::new(0.98)?,
///     Equal::new(),
///     Prior::scalar(memory, 100.0)?,
/// );
/// for k in 0..100 {
///     let phi = [1.0, f64::from(k % 7)];
///     let update = estimator.update(&phi, &[3.0 + 0.5 * phi[1]])?;
///     assert!(update.skipped.is_none());
/// }
/// assert!((estimator.theta()[0] - 3.0).abs() < 1e-3);
/// # Ok::<(), forgetting::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Estimator<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    design: Design<F, R, W, M>,
    state: EstimatorState<F, R, M>,
    buffers: Buffers<M>,
}

/// What an update writes to, and the next one need not read.
#[derive(Clone, Debug)]
struct Buffers<M: Memory> {
    sample: SampleBuffers<M>,
    work: Work<M>,
    diagnostics: Diagnostics<M>,
}

impl<F, R, W, M> Estimator<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    /// Growth of the largest element of D over its first value that counts as windup.
    pub const WINDUP: f64 = 10.0;

    /// An estimator that starts from `prior`.
    pub fn new(rule: F, rate: R, weighting: W, prior: Prior<M>) -> Self {
        let memory = prior.memory();
        let design = Design::new(rule, rate, weighting, AnyGate::Open(Open::new()), prior);
        let buffers = Buffers {
            sample: SampleBuffers::new(memory),
            work: Work::new(memory),
            diagnostics: Diagnostics::new(),
        };
        Self { state: design.start(false), design, buffers }
    }

    /// The same estimator behind this gate.
    #[must_use]
    pub fn with_gate(self, gate: AnyGate<M>) -> Self {
        Self { design: self.design.with_gate(gate), ..self }
    }

    /// Back to the prior, as if no sample had been seen.
    pub fn reset(&mut self) {
        self.state = self.design.start(self.state.monitor.is_some());
    }

    /// Monitors windup, excitation and noise from now on; see [`Estimator::health`]. O(n) a sample.
    pub fn enable_monitor(&mut self) {
        self.state.monitor = Some(self.design.monitor(&self.state.factor));
    }

    /// Does `work`. If that fails, the estimator is as it was before, bit for bit.
    ///
    /// # Errors
    /// Those of `work`.
    pub fn all_or_nothing<X, E>(
        &mut self,
        work: impl FnOnce(&mut Self) -> Result<X, E>,
    ) -> Result<X, E> {
        let before = self.state.clone();
        work(self).inspect_err(|_| self.state = before)
    }

    /// Takes the sample of p x n numbers `phi` and p x m numbers `y`, with Γ = I.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; the estimator is as it was, bit for bit.
    #[inline]
    pub fn update(&mut self, phi: &[M::Real], y: &[M::Real]) -> Result<Update<'_, M::Real>, Error> {
        self.update_with_noise(phi, y, Noise::Unit)
    }

    /// Takes a sample with the noise covariance Γ = `noise`.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; the estimator is as it was, bit for bit.
    #[inline]
    pub fn update_with_noise(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<Update<'_, M::Real>, Error> {
        let n = self.design.prior.memory().parameters();
        let mut outcome = [Outcome::default()];
        if phi.len() == n
            && y.len() == 1
            && matches!(noise, Noise::Unit)
            && self.update_many(phi, y, &mut outcome, &mut []) == 1
        {
            self.buffers.sample.innovations.as_mut()[0] = outcome[0].error;
            return Ok(self.report_of(self.buffers.sample.innovations.as_ref(), &outcome[0]));
        }
        self.update_in_steps(phi, y, noise)
    }
}
