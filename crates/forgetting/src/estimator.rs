//! The one recursion (GF-RLS, Theorem 1), sample by sample.
//!
//! ```text
//! forget    R̄ = R − F                          R = P⁻¹; only P changes
//! measure   R₊ = R̄ + φᵀ Γ⁻¹ φ                  P and the gain
//! correct   θ₊ = θ + R₊⁻¹ φᵀ Γ⁻¹ (y − φ θ)     θ changes here and nowhere else
//! ```

use crate::evidence::Known;
use crate::factor::kernel::{dot, Told};
use crate::factor::Form;
use crate::intake::{whiten, Intake, Noise};
use crate::measure::{leverage, measure_rows};
use crate::monitor::{Health, Monitor, Seen};
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten, Skip, Step};
use crate::state::{State, Visitor};
use crate::weighting::Weighting;
use crate::{Error, Factor, Memory, Prior, Real, Sample, Work};

/// What one sample told.
#[derive(Clone, Copy, Debug)]
pub struct Update<'a, T> {
    /// y − φθ with the θ of before: p x m numbers, row by row, in units of y
    pub error: &'a [T],
    /// tr φ̄P̄φ̄ᵀ: the variance of the prediction in units of the noise's
    pub leverage: T,
    /// the λ used
    pub forgetting_factor: T,
    /// the number of directions that lost information
    pub rank: usize,
    /// why the sample was left out, if it was
    pub skipped: Option<Skip>,
    /// whether P has wound up: as the watch says ([`Health::windup`]) if there is one, else
    /// whether P has grown beyond [`Estimator::WINDUP`] times its first value
    pub windup: bool,
}

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
        let Some(steady) = self.steady.filter(|_| self.monitor.is_none()) else { return 0 };
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
            windup: told.largest > self.windup_limit,
        }
    }

    /// The recursion step by step.
    #[inline(never)]
    fn update_in_steps(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<Update<'_, M::Real>, Error> {
        let squares = self.intake.take(self.prior.memory(), self.theta.as_ref(), phi, y)?;
        let memory = self.prior.memory();
        let intake = &mut self.intake;
        let mut sample = Sample::new(memory, intake.regressors.as_mut(), intake.errors.as_mut());
        whiten(&mut sample, noise, intake.noise.as_mut())?;
        let unit = matches!(noise, Noise::Unit);
        let squares = if unit { squares } else { sample.squared_regressors() };
        let mut known = Known::of(memory, &sample, squares)?;
        let needs = self.rate.needs().max(self.weighting.needs());
        let (seen, buffers) =
            (intake.seen.as_mut(), (intake.remaining.as_mut(), intake.noise.as_mut()));
        known.find(needs, &self.factor, &sample, &mut self.work, buffers);
        known.weigh(&self.weighting, &mut sample, seen, &self.factor, self.samples)?;
        let evidence = known.evidence(&sample, &self.factor, seen, self.samples);
        let lambda = self.rate.forgetting_factor(&self.rate_state, &evidence)?;
        if !(lambda > M::Real::ZERO && lambda <= M::Real::ONE) {
            return Err(Error::value("forgetting_factor", lambda.to_f64(), "(0, 1]"));
        }
        // less than the rounding unit forgets every digit all the same, and would swamp those of
        // the directions that are kept
        let lambda = lambda.max(M::Real::EPSILON);
        let form = if sample.rows() == 1 { self.rule.form(lambda) } else { None };
        let squares =
            if unit && self.weighting.is_equal() { squares } else { sample.squared_regressors() };
        let theta = self.theta.as_mut();
        let (Forgotten { rank, skipped, forgetting_factor }, leverage) = match form {
            Some(Form::Along { dead_zone, .. }) if dead_zone.holds(squares) => {
                (Forgotten::skipped(Skip::DeadZone), leverage(&self.factor, &sample))
            }
            Some(form) => {
                let (f, errors) = (sample.row(0), sample.error(0));
                let scratch = self.work.scratch.as_mut();
                let measured = self.factor.measure(form, (f, squares), scratch, (theta, errors))?;
                (forgotten(form, measured.forgot, memory.parameters()), measured.leverage)
            }
            None => {
                let step = Step {
                    factor: &mut self.factor,
                    sample: &mut sample,
                    forgetting_factor: lambda,
                    work: &mut self.work,
                };
                let forgotten = self.rule.forget(&mut self.rule_state, step)?;
                let gain = self.work.gain.as_mut();
                let leverage = match forgotten.skipped {
                    Some(_) => leverage(&self.factor, &sample),
                    None => {
                        let remaining = &mut intake.remaining;
                        measure_rows(&mut self.factor, &sample, gain, theta, remaining)
                    }
                };
                (forgotten, leverage)
            }
        };
        if skipped.is_none() {
            let evidence = known.evidence(&sample, &self.factor, seen, self.samples);
            self.rate.learn(&mut self.rate_state, &evidence, lambda);
            self.samples += 1;
        }
        if let Some(monitor) = &mut self.monitor {
            let squared_error = known.used_error();
            let seen = Seen { sample: &sample, squared_error, leverage, forgetting_factor: lambda };
            monitor.watch(&self.factor, skipped.is_none().then_some(seen));
        }
        Ok(Update {
            error: self.intake.innovations.as_ref(),
            leverage,
            forgetting_factor: forgetting_factor.map_or(lambda, M::Real::from_f64),
            rank,
            skipped,
            windup: match &self.monitor {
                Some(monitor) => monitor.windup(),
                None => self.factor.exceeds(self.windup_limit),
            },
        })
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

    /// θ₀ and P₀.
    pub fn prior(&self) -> &Prior<M> {
        &self.prior
    }

    /// Whether θ is finite and P positive definite, as after every sample.
    pub fn is_sound(&self) -> bool {
        self.theta.as_ref().iter().all(|x| x.is_finite()) && self.factor.is_sound()
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
