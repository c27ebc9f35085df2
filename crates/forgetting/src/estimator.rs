//! The one recursion (GF-RLS, Theorem 1), sample by sample.
//!
//! ```text
//! forget    R̄ = R − F                          R = P⁻¹; only P changes
//! measure   R₊ = R̄ + φᵀ Γ⁻¹ φ                  P and the gain
//! correct   θ₊ = θ + R₊⁻¹ φᵀ Γ⁻¹ (y − φ θ)     θ changes here and nowhere else
//! ```

use crate::between::Between;
use crate::factor::kernel::{dot, Told};
use crate::factor::Form;
use crate::gates::{Answer, AnyGate, Gate, Open};
use crate::intake::{Intake, Noise};
use crate::monitor::{Health, Monitor};
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten, Skip};
use crate::state::{State, Visitor, MOST_SAMPLES};
use crate::update::{Update, Whitened};
use crate::weighting::Weighting;
use crate::{Error, Factor, Memory, Prior, Real, Work};

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

    /// What the watch has seen, if there is one.
    pub fn health(&self) -> Option<Health<'_, M::Real>> {
        self.monitor.as_ref().map(Monitor::health)
    }

    /// Keeps, from now on or no longer, P̄ of the last sample: [`Estimator::prior_factor`].
    /// O(n²) a sample.
    pub fn keep_prior(&mut self, keep: bool) {
        self.between.keep_prior(keep, &self.factor);
    }

    /// Keeps, from now on or no longer, what [`Update::whiten`] needs for samples of several rows:
    /// O(p n²/2 + p² n) a sample. For one row it costs nothing and need not be asked for.
    pub fn keep_innovations(&mut self, keep: bool) {
        self.between.keep_innovations(keep, self.prior.memory());
    }

    /// P̄ of the last sample, after forgetting and before the data, if it is kept.
    pub fn prior_factor(&self) -> Option<&Factor<M>> {
        self.between.prior()
    }

    /// φθ for p x n numbers `phi`, row by row; writes p x m numbers to `prediction`.
    ///
    /// # Errors
    /// [`Error::Length`] names what does not fit.
    pub fn predict(&self, phi: &[M::Real], prediction: &mut [M::Real]) -> Result<(), Error> {
        let memory = self.prior.memory();
        let (n, m) = (memory.parameters(), memory.targets());
        if n == 0 || phi.len() % n != 0 {
            return Err(Error::Length { parameter: "phi", length: phi.len(), expected: n });
        }
        Error::check_length("prediction", prediction.len(), phi.len() / n * m)?;
        for (row, predicted) in phi.chunks_exact(n).zip(prediction.chunks_exact_mut(m)) {
            for (theta, y) in self.theta.as_ref().chunks_exact(n).zip(predicted) {
                *y = dot(row, theta);
            }
        }
        Ok(())
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
        let mut told = [Told::default()];
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
    /// It takes none where it has more to do than to forget, measure and correct (a watch, a
    /// variable rate, …), and stops before a sample that it cannot use: [`Estimator::update`]
    /// takes the next one or says what is wrong with it. The bits are those of as many calls of
    /// that. `thetas` has room for n numbers a sample, θ after it, or is empty.
    #[inline]
    pub fn advance(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        told: &mut [Told<M::Real>],
        thetas: &mut [M::Real],
    ) -> usize {
        let watched = self.monitor.is_some() || self.between.keeps_prior();
        let Some(steady) = self.steady.filter(|_| !watched) else { return 0 };
        let (scratch, theta) = (self.work.scratch.as_mut(), self.theta.as_mut());
        let taken = self.factor.advance(steady.form, (phi, y), scratch, theta, (told, thetas));
        self.samples += told[..taken].iter().filter(|told| told.used).count() as u64;
        taken
    }

    /// What a sample told that [`Estimator::advance`] took.
    #[inline]
    pub fn update_of<'a>(&self, told: &'a Told<M::Real>) -> Update<'a, M::Real> {
        self.tell(core::slice::from_ref(&told.error), told)
    }

    #[inline]
    fn tell<'a>(&self, error: &'a [M::Real], told: &Told<M::Real>) -> Update<'a, M::Real> {
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
            windup: told.largest > self.windup_limit,
            whitened: Whitened::Row { errors: error, noise: M::Real::ONE },
        }
    }

    /// θ, m x n numbers, one target after the other.
    #[inline]
    pub fn theta(&self) -> &[M::Real] {
        self.theta.as_ref()
    }

    /// P, factored.
    #[inline]
    pub fn factor(&self) -> &Factor<M> {
        &self.factor
    }

    /// Samples used since the start; skipped ones do not count.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// The forgetting rule.
    pub fn rule(&self) -> &F {
        &self.rule
    }

    /// The design of the forgetting factor.
    pub fn rate(&self) -> &R {
        &self.rate
    }

    /// What the design of the forgetting factor remembers.
    pub fn rate_state(&self) -> &R::State {
        &self.rate_state
    }

    /// The weighting of samples.
    pub fn weighting(&self) -> &W {
        &self.weighting
    }

    /// What decides whether a sample is used.
    pub fn gate(&self) -> &AnyGate<M> {
        &self.gate
    }

    /// θ₀ and P₀.
    pub fn prior(&self) -> &Prior<M> {
        &self.prior
    }

    /// Whether θ is finite, P positive definite, and what the rule, the rate and the watch
    /// remember is what they can: as after every sample.
    pub fn is_sound(&self) -> bool {
        self.theta.as_ref().iter().all(|x| x.is_finite())
            && self.factor.is_sound()
            && self.rule_state.is_sound()
            && self.rate_state.is_sound()
            && self.samples <= MOST_SAMPLES
            && self.monitor.as_ref().is_none_or(State::is_sound)
    }

    /// [`Estimator::is_sound`] for a state that was read, of which the bound of P's trace may be
    /// none.
    #[cfg(feature = "alloc")]
    pub(crate) fn check_read(&mut self) -> bool {
        let sound = self.is_sound();
        self.factor.check_bound();
        sound
    }

    /// Shows every number of the state to `visitor`.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.factor.visit(visitor);
        visitor.reals(self.theta.as_mut());
        self.rule_state.visit(visitor);
        self.rate_state.visit(visitor);
        visitor.whole(&mut self.samples);
        if let Some(monitor) = &mut self.monitor {
            monitor.visit(visitor);
        }
    }
}
