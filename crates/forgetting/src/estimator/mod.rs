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
mod state;
mod statistics;
mod steps;

use crate::gates::{AnyGate, Open};
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten};
use crate::sample::{Answer, Noise, SampleBuffers, Skip, Update, Whitened, Work};
use crate::weighting::Weighting;
use crate::{Error, Memory, Prior, Real};
#[cfg(feature = "alloc")]
pub use any::AnyEstimator;
use design::{Design, Steady};
use diagnostics::Diagnostics;
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::kernel::watch::Observations;
use state::EstimatorState;
use steps::forgotten;

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

    /// Watches from now on: [`Estimator::health`] tells what it sees. O(n) a sample.
    pub fn watch(&mut self) {
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
        self.update_weighted(phi, y, Noise::Unit)
    }

    /// Takes a sample with the noise covariance Γ = `noise`.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; the estimator is as it was, bit for bit.
    #[inline]
    pub fn update_weighted(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<Update<'_, M::Real>, Error> {
        let n = self.design.prior.memory().parameters();
        let mut told = [Outcome::default()];
        if phi.len() == n
            && y.len() == 1
            && matches!(noise, Noise::Unit)
            && self.advance(phi, y, &mut told, &mut []) == 1
        {
            self.buffers.sample.innovations.as_mut()[0] = told[0].error;
            return Ok(self.tell(self.buffers.sample.innovations.as_ref(), &told[0]));
        }
        self.update_in_steps(phi, y, noise)
    }

    /// Takes samples of n numbers `phi` and one number `y` each, one after the other and all in
    /// one go; returns how many it took, as many as `told` has room for at most.
    ///
    /// It takes none where it has more to do than to forget, measure and correct (a variable rate,
    /// a gate, …), and stops before a sample that it cannot use: [`Estimator::update`]
    /// takes the next one or says what is wrong with it. The result is that of as many calls of
    /// that: bit for bit up to ten parameters, to rounding above. `thetas` has room for n numbers a
    /// sample, θ after it, or is empty.
    #[inline]
    pub fn advance(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        told: &mut [Outcome<M::Real>],
        thetas: &mut [M::Real],
    ) -> usize {
        let Self { design, state, buffers } = self;
        let Some(steady) = design.steady.filter(|_| !buffers.diagnostics.keeps_prior()) else {
            return 0;
        };
        // the monitor looks at P now and then
        let room = state.monitor.as_ref().map_or(told.len(), |monitor| monitor.room(told.len()));
        let told = &mut told[..room];
        let (scratch, theta) = (buffers.work.scratch.as_mut(), state.theta.as_mut());
        let taken = state.factor.advance(steady.form, (phi, y), scratch, theta, (told, thetas));
        state.samples += told[..taken].iter().filter(|told| told.used).count() as u64;
        self.show(steady.lambda, phi, &mut told[..taken]);
        taken
    }

    /// Shows samples to the monitor, and notes what it says of each.
    #[inline]
    fn show(&mut self, lambda: M::Real, phi: &[M::Real], told: &mut [Outcome<M::Real>]) {
        let EstimatorState { factor, monitor, .. } = &mut self.state;
        let Some(monitor) = monitor else { return };
        let samples = Observations { forgetting_factor: lambda, phi, outcomes: told };
        let wound_up = monitor.watch(factor, samples);
        told[..wound_up].iter_mut().for_each(|told| told.windup = true);
        if let Some(last) = told.last_mut() {
            last.windup = monitor.windup();
        }
    }

    /// What a sample told that [`Estimator::advance`] took.
    #[inline]
    pub fn update_of<'a>(&self, told: &'a Outcome<M::Real>) -> Update<'a, M::Real> {
        self.tell(core::slice::from_ref(&told.error), told)
    }

    #[inline]
    fn tell<'a>(&self, error: &'a [M::Real], told: &Outcome<M::Real>) -> Update<'a, M::Real> {
        let n = self.design.prior.memory().parameters();
        let (lambda, forgotten) = match self.design.steady {
            Some(Steady { lambda, form }) => (lambda, forgotten(form, told.forgot, n)),
            None => (M::Real::ONE, Forgotten::rank(0)),
        };
        Update {
            error,
            leverage: told.leverage,
            forgetting_factor: forgotten.forgetting_factor.map_or(lambda, M::Real::from_f64),
            rank: forgotten.rank,
            skipped: (!told.used).then_some(Skip::DeadZone),
            gate: Answer::Update,
            windup: match &self.state.monitor {
                Some(_) => told.windup,
                None => told.largest > self.design.windup_limit,
            },
            whitened: Whitened::Row { errors: error, noise: M::Real::ONE },
        }
    }
}
