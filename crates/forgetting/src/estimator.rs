//! The one recursion (GF-RLS, Theorem 1), sample by sample.
//!
//! ```text
//! forget    R̄ = R − F                          R = P⁻¹; only P changes
//! measure   R₊ = R̄ + φᵀ Γ⁻¹ φ                  P and the gain
//! correct   θ₊ = θ + R₊⁻¹ φᵀ Γ⁻¹ (y − φ θ)     θ changes here and nowhere else
//! ```

use crate::between::Between;
use crate::gates::{Answer, AnyGate, Gate, Open};
use crate::intake::{Intake, Noise};
use crate::monitor::Monitor;
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten, Skip};
use crate::update::{Update, Whitened};
use crate::weighting::Weighting;
use crate::{Error, Factor, Memory, Prior, Real, Work};
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::kernel::watch::Observations;

mod held;
mod steps;

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
    rule: F,
    rate: R,
    weighting: W,
    gate: AnyGate<M>,
    prior: Prior<M>,
    factor: Factor<M>,
    theta: M::Parameters,
    rule_state: F::State,
    rate_state: R::State,
    samples: u64,
    windup_limit: M::Real,
    /// what every sample does to P, if that is all that there is to do
    steady: Option<Steady<M::Real>>,
    monitor: Option<Monitor<M>>,
    between: Between<M>,
    intake: Intake<M>,
    work: Work<M>,
}

/// The same λ and the same form of forgetting for every sample, of one row and one target.
#[derive(Clone, Copy, Debug)]
struct Steady<T> {
    lambda: T,
    form: Form<T>,
}

/// What forgetting in this form did to P, of n parameters.
#[inline]
fn forgotten<T: Real>(form: Form<T>, forgot: bool, n: usize) -> Forgotten {
    match form {
        Form::Scale { growth } if growth == T::ONE => Forgotten::rank(0).with_factor(1.0),
        Form::Scale { .. } => Forgotten::rank(n),
        Form::Along { .. } => Forgotten::rank(usize::from(forgot)),
    }
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
        let factor = prior.factor();
        let single = (memory.rows(), memory.targets()) == (1, 1) && weighting.is_equal();
        let steady = rate
            .constant()
            .filter(|_| single)
            .map(|lambda| lambda.max(M::Real::EPSILON))
            .and_then(|lambda| rule.form(lambda).map(|form| Steady { lambda, form }));
        Self {
            steady,
            theta: prior.theta().clone(),
            rule_state: rule.start(memory),
            rate_state: rate.start(memory),
            windup_limit: M::Real::from_f64(Self::WINDUP) * factor.largest(),
            monitor: None,
            between: Between::new(),
            gate: AnyGate::Open(Open::new()),
            intake: Intake::new(memory),
            work: Work::new(memory),
            samples: 0,
            rule,
            rate,
            weighting,
            prior,
            factor,
        }
    }

    /// The same estimator behind this gate.
    #[must_use]
    pub fn with_gate(mut self, gate: AnyGate<M>) -> Self {
        if !gate.is_open() {
            self.steady = None;
        }
        self.gate = gate;
        self
    }

    /// Back to the prior, as if no sample had been seen.
    pub fn reset(&mut self) {
        let memory = self.prior.memory();
        self.factor = self.prior.factor();
        self.theta = self.prior.theta().clone();
        self.rule_state = self.rule.start(memory);
        self.rate_state = self.rate.start(memory);
        self.samples = 0;
        if self.monitor.is_some() {
            self.monitor = Some(Monitor::new(&self.factor, self.rule.is_bounded()));
        }
    }

    /// Watches from now on: [`Estimator::health`] tells what it sees. O(n) a sample.
    pub fn watch(&mut self) {
        self.monitor = Some(Monitor::new(&self.factor, self.rule.is_bounded()));
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
        let n = self.prior.memory().parameters();
        let mut told = [Outcome::default()];
        if phi.len() == n
            && y.len() == 1
            && matches!(noise, Noise::Unit)
            && self.advance(phi, y, &mut told, &mut []) == 1
        {
            self.intake.innovations.as_mut()[0] = told[0].error;
            return Ok(self.tell(self.intake.innovations.as_ref(), &told[0]));
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
        let Some(steady) = self.steady.filter(|_| !self.between.keeps_prior()) else { return 0 };
        // the watch looks at P now and then
        let room = self.monitor.as_ref().map_or(told.len(), |monitor| monitor.room(told.len()));
        let told = &mut told[..room];
        let (scratch, theta) = (self.work.scratch.as_mut(), self.theta.as_mut());
        let taken = self.factor.advance(steady.form, (phi, y), scratch, theta, (told, thetas));
        self.samples += told[..taken].iter().filter(|told| told.used).count() as u64;
        self.show(steady.lambda, phi, &mut told[..taken]);
        taken
    }

    /// Shows samples to the watch, and notes what it says of each.
    #[inline]
    fn show(&mut self, lambda: M::Real, phi: &[M::Real], told: &mut [Outcome<M::Real>]) {
        let Some(monitor) = &mut self.monitor else { return };
        let samples = Observations { forgetting_factor: lambda, phi, outcomes: told };
        let wound_up = monitor.watch(&self.factor, samples);
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
        let n = self.prior.memory().parameters();
        let (lambda, forgotten) = match self.steady {
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
            windup: match &self.monitor {
                Some(_) => told.windup,
                None => told.largest > self.windup_limit,
            },
            whitened: Whitened::Row { errors: error, noise: M::Real::ONE },
        }
    }
}
