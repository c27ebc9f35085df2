//! The one recursion (GF-RLS, Theorem 1), sample by sample.
//!
//! ```text
//! forget    R̄ = R − F                          R = P⁻¹; only P changes
//! measure   R₊ = R̄ + φᵀ Γ⁻¹ φ                  P and the gain
//! correct   θ₊ = θ + R₊⁻¹ φᵀ Γ⁻¹ (y − φ θ)     θ changes here and nowhere else
//! ```

mod accessors;
mod any;
mod design;
mod diagnostics;
mod many;
mod measured;
#[cfg(feature = "alloc")]
mod numbers;
mod recursion;
mod state;
mod statistics;
mod steps;

use crate::covariance::Prior;
use crate::error::Error;
use crate::gates::{AnyGate, Open};
use crate::memory::Memory;
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::sample::{check_theta, Noise, Update, Whitened};
use crate::weightings::Weighting;
#[cfg(feature = "alloc")]
pub use any::AnyEstimator;
pub use any::Named;
use design::{Design, WINDUP};
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::Real;
use measured::Measured;
#[cfg(feature = "alloc")]
pub(crate) use numbers::Numbers;
use recursion::Recursion;

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
    recursion: Recursion<F, R, W, M>,
    /// where P₀ follows the data
    measured: Option<Measured<M>>,
}

impl<F, R, W, M> Estimator<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    /// Growth of the largest element of D over its first value that counts as windup.
    pub const WINDUP: f64 = WINDUP;

    /// An estimator that starts from `prior`.
    pub fn new(rule: F, rate: R, weighting: W, prior: Prior<M>) -> Self {
        Self::of(Design::new(rule, rate, weighting, AnyGate::Open(Open::new()), prior))
    }

    fn of(design: Design<F, R, W, M>) -> Self {
        let prior = &design.prior;
        let measured = prior.is_of_data().then(|| Measured::new(prior.memory(), prior.theta()));
        Self { measured, recursion: Recursion::new(design) }
    }

    /// The same estimator behind this gate, at its start.
    #[must_use]
    pub fn with_gate(self, gate: AnyGate<M>) -> Self {
        Self::of(self.recursion.design.with_gate(gate))
    }

    /// Back to the prior, as if no sample had been seen.
    pub fn reset(&mut self) {
        let Recursion { design, state, .. } = &mut self.recursion;
        *state = design.start(state.monitor.is_some());
        if let Some(measured) = &mut self.measured {
            *measured = Measured::new(design.prior.memory(), design.prior.theta());
        }
    }

    /// Monitors windup, excitation and noise from now on; see [`Estimator::health`]. O(n) a sample.
    pub fn enable_monitor(&mut self) {
        let Recursion { design, state, .. } = &mut self.recursion;
        state.monitor = Some(design.monitor(&state.factor));
    }

    /// Does `work`. If that fails, the estimator is as it was before, bit for bit.
    ///
    /// # Errors
    /// Those of `work`.
    pub fn all_or_nothing<X, E>(
        &mut self,
        work: impl FnOnce(&mut Self) -> Result<X, E>,
    ) -> Result<X, E> {
        let before = (self.recursion.state.clone(), self.measured.clone());
        work(self).inspect_err(|_| (self.recursion.state, self.measured) = before)
    }

    /// Goes on from θ = `theta`, m x n numbers, one target after the other. P stays as it is.
    ///
    /// # Errors
    /// [`Error`] names `theta` unless it has as many numbers and they are within the range; nothing has
    /// changed.
    pub fn set_theta(&mut self, theta: &[M::Real]) -> Result<(), Error> {
        let own = self.recursion.state.theta.as_mut();
        Error::check_length("theta", theta.len(), own.len())?;
        check_theta(theta)?;
        own.copy_from_slice(theta);
        if let Some(measured) = &mut self.measured {
            measured.set_theta(own);
        }
        Ok(())
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
        self.update_after(M::Real::ONE, phi, y, noise)
    }

    /// Takes a sample `elapsed` after the last one: a forgetting factor λ of one unit of time is
    /// λ^elapsed, at least 1/1024, and process noise Q is elapsed Q. [`Estimator::update_with_noise`]
    /// counts samples: each takes one unit of time.
    ///
    /// Without a sample in between, gaps add up exactly for rules that forget everywhere. Rules that
    /// forget where the sample informs (`subspace`, `directional`, …) forget for the whole time there,
    /// and nothing elsewhere. `multiple`, `data_dependent` and functions of the user's count samples.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; the estimator is as it was, bit for bit.
    #[inline]
    pub fn update_after(
        &mut self,
        elapsed: M::Real,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<Update<'_, M::Real>, Error> {
        let (recursion, sample) = (&mut self.recursion, (phi, y));
        let report = match &mut self.measured {
            None => recursion.update(phi, y, noise, elapsed)?,
            Some(measured) => measured.update(recursion, sample, noise, elapsed)?,
        };
        Ok(self.recursion.complete(report))
    }

    /// Whether [`Estimator::update_many`] takes samples at all: a sample is forgotten, measured and
    /// corrected, and nothing else is to be done with it.
    #[inline]
    pub fn takes_many(&self) -> bool {
        self.recursion.takes_many()
    }

    /// Takes samples of n numbers `phi` and one number `y` each, in one call; writes what became of
    /// each to `outcomes` and returns how many it took, at most as many as there are outcomes.
    ///
    /// It takes none where there is more to do than to forget, measure and correct (a variable
    /// rate, a gate, several rows, …), and stops before a sample that it cannot use:
    /// [`Estimator::update`] takes that one, or says what is wrong with it. The result is that of
    /// one update a sample: bit for bit up to ten parameters, to rounding above. `thetas` is empty,
    /// or has room for n numbers a sample: θ after it.
    #[inline]
    pub fn update_many(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        outcomes: &mut [Outcome<M::Real>],
        thetas: &mut [M::Real],
    ) -> usize {
        match &mut self.measured {
            None => self.recursion.update_many(phi, y, outcomes, thetas),
            Some(measured) => measured.update_many(&mut self.recursion, (phi, y), outcomes, thetas),
        }
    }

    /// What an update would have reported of a sample that [`Estimator::update_many`] took.
    #[inline]
    pub fn report<'a>(&self, outcome: &'a Outcome<M::Real>) -> Update<'a, M::Real> {
        let errors = core::slice::from_ref(&outcome.error);
        let whitened = Whitened::Row { errors, noise: M::Real::ONE };
        self.recursion.report_of(outcome).with(errors, whitened)
    }
}
