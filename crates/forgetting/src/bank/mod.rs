//! Several estimators on the same samples, and their mixture: nothing need be chosen beforehand.
//!
//! ```text
//! φθ = Σ w_i φθ_i                                      prediction; θ = Σ w_i θ_i
//! P  = Σ w_i (P_i + (θ_i − θ)(θ_i − θ)ᵀ/σ²)            covariance, with what the members disagree about
//! N  = Σ w_i n/h̄_i                                     memory in samples, h̄_i the mean of s/(1 + s) of member i
//! ```
//!
//! The weights w are those of a mixer ([`crate::mixers`]), which learns from the errors of the members.
//! For the first 3n samples, in which each member still learns what θ is, all are believed alike.
//! A member that cannot take a sample sleeps: it has no part in that prediction, and stays as it was.
//!
//! A bank of one is that estimator, bit for bit.

mod clip;
mod group;
mod many;
mod members;
mod mixture;
mod read;
mod steps;
mod together;
mod whiten;

pub use many::{BankOutcome, Kept};
pub use members::{default_members, DEFAULT_NOISE};

use crate::error::Error;
use crate::estimator::AnyEstimator;
use crate::memory::{Aligned, Dynamic, Memory};
use crate::mixers::{AnyMixer, AnyMixerState, Mixer};
use crate::sample::{Answer, Noise, Skip};
use crate::units::Units;
use crate::weightings::Weighting;
use alloc::vec::Vec;
use clip::Clip;
use forgetting_kernels::Kernels;
use group::Group;
use mixture::Mixture;
use steps::Taken;

/// Estimators of the same sizes, and what mixes them.
///
/// ```
/// use forgetting::bank::{default_members, Bank};
/// use forgetting::choice::Defaults;
/// use forgetting::mixers::AnyMixer;
/// use forgetting::{Dynamic, Noise};
///
/// let memory = Dynamic::<f64>::new(2, 1, 1)?;
/// let members = default_members(memory)?;
/// let mixer = AnyMixer::named("mlpol", &Defaults, Dynamic::new(members.len(), 1, 1)?)?;
/// let mut bank = Bank::of_data(members, mixer)?;
/// for k in 0..100 {
///     let phi = [1.0, f64::from(k % 7)];
///     bank.update(&phi, &[3.0 + 0.5 * phi[1]], Noise::Unit)?;
/// }
/// assert!((bank.theta()[0] - 3.0).abs() < 1e-3);
/// # Ok::<(), forgetting::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Bank<T: Kernels> {
    mixer: AnyMixer<Dynamic<T>>,
    memory: Dynamic<T>,
    /// whether the units of φ are those of the data
    follows_data: bool,
    /// whether members trust some samples less than others
    is_weighted: bool,
    state: BankState<T>,
    buffers: Buffers<T>,
}

/// What the next sample needs.
#[derive(Clone, Debug)]
struct BankState<T: Kernels> {
    members: Group<T>,
    mixer: AnyMixerState<Dynamic<T>>,
    mixture: Mixture<T>,
    clip: Clip<T>,
    units: Option<Units<Dynamic<T>>>,
}

/// What an update writes to, and the next one need not read.
#[derive(Clone, Debug)]
struct Buffers<T: Kernels> {
    phi: Aligned<T>,
    /// several samples in the units of the members
    batch: Aligned<T>,
    /// p x m numbers a member: y − φθ, in units of y
    errors: Vec<T>,
    /// the same, whitened
    whitened: Vec<T>,
    /// of the mixture
    error: Vec<T>,
    mixed: Vec<T>,
    leverages: Vec<T>,
    awake: Vec<bool>,
    /// θ of the mixture in the units of the user, m x n numbers
    theta: Aligned<T>,
    root: Aligned<T>,
}

/// What a bank reports of a sample.
#[derive(Clone, Copy, Debug)]
pub struct BankUpdate<'a, T> {
    /// y − φθ of the mixture with the θ of before: p x m numbers, row by row, in units of y
    pub error: &'a [T],
    /// Σ w_i s_i: the variance of the prediction in units of the noise's, without what members
    /// disagree about
    pub leverage: T,
    /// λ of the members, mixed
    pub forgetting_factor: T,
    /// why the sample was left out, if all members left it out
    pub skipped: Option<Skip>,
    /// what the gate of the member that is believed most said
    pub gate: Answer,
    /// whether P of every member that is believed has wound up
    pub windup: bool,
    /// members that could not take the sample
    pub asleep: usize,
}

impl<T: Kernels> Bank<T> {
    /// These members, mixed by `mixer`, which is made for as many. They take φ as it is.
    ///
    /// # Errors
    /// [`Error::Unsupported`] without members, or for members of different sizes or with a prior that
    /// follows the data.
    pub fn new(members: Vec<AnyEstimator<T>>, mixer: AnyMixer<Dynamic<T>>) -> Result<Self, Error> {
        Self::with_units(members, mixer, false)
    }

    /// The same, the members being given φ in units that the data choose: their priors are in these.
    ///
    /// # Errors
    /// Those of [`Bank::new`].
    pub fn of_data(
        members: Vec<AnyEstimator<T>>,
        mixer: AnyMixer<Dynamic<T>>,
    ) -> Result<Self, Error> {
        Self::with_units(members, mixer, true)
    }

    pub(crate) fn with_units(
        mut members: Vec<AnyEstimator<T>>,
        mixer: AnyMixer<Dynamic<T>>,
        follows_data: bool,
    ) -> Result<Self, Error> {
        let memory = members::common_memory(&members)?;
        let is_weighted = members.iter().any(|member| !member.weighting().is_equal());
        members.iter_mut().for_each(|member| member.estimate_noise(follows_data));
        let of_members = Dynamic::new(members.len(), 1, 1)?;
        let (count, width) = (members.len(), memory.rows() * memory.targets());
        let zeros = |length| alloc::vec![T::ZERO; length];
        let buffers = Buffers {
            phi: memory.regressors(),
            batch: memory.list(many::BATCH * memory.parameters()),
            errors: zeros(count * width),
            whitened: zeros(count * width),
            error: zeros(width),
            mixed: zeros(width),
            leverages: zeros(count),
            awake: alloc::vec![true; count],
            theta: memory.theta(),
            root: memory.noise(),
        };
        let state = BankState {
            mixer: mixer.start(of_members),
            mixture: Mixture::new(count, memory.targets()),
            clip: Clip::new(memory.targets(), is_weighted),
            units: follows_data.then(|| Units::new(memory)),
            members: Group::new(members),
        };
        let mut bank = Self { mixer, memory, follows_data, is_weighted, state, buffers };
        bank.reset();
        Ok(bank)
    }

    /// Back to the prior, as if no sample had been seen.
    pub fn reset(&mut self) {
        let Self { mixer, memory, follows_data, is_weighted, state, .. } = self;
        let count = state.members.count();
        state.members.each().iter_mut().for_each(AnyEstimator::reset);
        // as many were allowed before
        if let Ok(of_members) = Dynamic::new(count, 1, 1) {
            state.mixer = mixer.start(of_members);
        }
        state.mixture = Mixture::new(count, memory.targets());
        state.clip = Clip::new(memory.targets(), *is_weighted);
        state.units = follows_data.then(|| Units::new(*memory));
        self.express();
    }

    /// Does `work`. If that fails, the bank is as it was before, bit for bit.
    ///
    /// # Errors
    /// Those of `work`.
    pub fn all_or_nothing<X, E>(
        &mut self,
        work: impl FnOnce(&mut Self) -> Result<X, E>,
    ) -> Result<X, E> {
        let (before, theta) = (self.state.clone(), self.buffers.theta.clone());
        work(self).inspect_err(|_| (self.state, self.buffers.theta) = (before, theta))
    }

    /// Takes the sample of p x n numbers `phi` and p x m numbers `y` with the noise covariance
    /// Γ = `noise`.
    ///
    /// # Errors
    /// [`Error`] names what was wrong, if no member can take the sample; the bank is as it was, bit for
    /// bit.
    pub fn update(
        &mut self,
        phi: &[T],
        y: &[T],
        noise: Noise<'_, T>,
    ) -> Result<BankUpdate<'_, T>, Error> {
        self.update_after(T::ONE, phi, y, noise)
    }

    /// The same, `elapsed` after the last sample; see [`Estimator::update_after`](crate::Estimator).
    ///
    /// # Errors
    /// Those of [`Bank::update`].
    pub fn update_after(
        &mut self,
        elapsed: T,
        phi: &[T],
        y: &[T],
        noise: Noise<'_, T>,
    ) -> Result<BankUpdate<'_, T>, Error> {
        let mut outcome = [BankOutcome::default()];
        if matches!(noise, Noise::Unit)
            && elapsed == T::ONE
            && (phi.len(), y.len()) == (self.memory.parameters(), 1)
            && self.update_many(phi, y, &mut outcome, &mut Kept::default()) == 1
        {
            self.buffers.error[0] = outcome[0].error;
            return Ok(outcome[0].report(&self.buffers.error));
        }
        self.measure(phi, noise.deviation())?;
        let taken = self.update_members(y, noise, elapsed);
        let Taken { forgetting_factor, skipped, gate, windup, asleep } = match taken {
            Ok(taken) => taken,
            Err(error) => {
                if let Some(units) = &mut self.state.units {
                    units.unchoose(|_, _| {});
                }
                return Err(error);
            }
        };
        self.mix(noise);
        let leverage = self.state.mixture.mean(&self.buffers.leverages, &self.buffers.awake);
        self.learn(skipped.is_none().then_some(leverage));
        if let Some(units) = &mut self.state.units {
            match skipped {
                None => units.learn_one(self.buffers.phi.as_mut(), noise.deviation()),
                Some(_) => units.unchoose(|_, _| {}),
            }
        }
        if skipped.is_none() {
            self.follow();
        }
        let error = &self.buffers.error;
        Ok(BankUpdate { error, leverage, forgetting_factor, skipped, gate, windup, asleep })
    }
}
