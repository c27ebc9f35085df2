//! Several estimators on the same samples, and their mixture: nothing need be chosen beforehand.
//!
//! ```text
//! φθ = Σ w_i φθ_i                                      prediction; θ = Σ w_i θ_i
//! P  = Σ w_i (P_i + (θ_i − θ)(θ_i − θ)ᵀ/σ²)            covariance, with what the members disagree about
//! N  = Σ w_i n/h̄_i                                     memory in samples, h̄_i the mean of s/(1 + s) of member i
//! ```
//!
//! The weights w are those of a mixer ([`crate::mixers`]), which learns from the errors of the members.
//! For the first 3n samples, in which each member still learns what θ is, each is believed as far as beforehand.
//! A member that cannot take a sample sleeps: it has no part in that prediction, and stays as it was.
//!
//! A bank of one is that estimator, bit for bit.

mod clip;
mod defaults;
#[cfg(feature = "alloc")]
mod group;
#[cfg(feature = "alloc")]
mod many;
mod members;
mod mixture;
mod read;
mod steps;
#[cfg(feature = "alloc")]
mod together;
mod whiten;

#[cfg(feature = "alloc")]
pub use defaults::{default_members, default_mixer};
pub use defaults::{DEFAULT_NOISE, DEFAULT_PRIOR_RATIO};
#[cfg(feature = "alloc")]
pub use many::{BankOutcome, Kept};
pub(crate) use members::{mix, Brought, Member, Members};

use crate::memory::Memory;
use crate::mixers::Mixer;
use crate::sample::{Answer, Skip};
use crate::units::Units;
use clip::Clip;
use forgetting_kernels::Kernels;
use mixture::Mixture;
#[cfg(feature = "alloc")]
use {
    crate::error::Error, crate::estimator::AnyEstimator, crate::memory::Dynamic,
    crate::mixers::AnyMixer, alloc::vec::Vec, group::Group,
};

/// The most samples that are measured before they are used.
#[cfg(feature = "alloc")]
const BATCH: usize = 32;

#[cfg(feature = "alloc")]
/// Estimators of any kind and of the same sizes, and what mixes them.
///
/// ```
/// use forgetting::bank::{default_members, default_mixer, Bank};
/// use forgetting::{Dynamic, Noise};
///
/// let memory = Dynamic::<f64>::new(2, 1, 1)?;
/// let mut bank = Bank::of_data(default_members(memory)?, default_mixer()?)?;
/// for k in 0..100 {
///     let phi = [1.0, f64::from(k % 7)];
///     bank.update(&phi, &[3.0 + 0.5 * phi[1]], Noise::Unit)?;
/// }
/// assert!((bank.theta()[0] - 3.0).abs() < 1e-3);
/// # Ok::<(), forgetting::Error>(())
/// ```
#[cfg(feature = "alloc")]
pub type Bank<T> = Mixed<Group<T>, AnyMixer<Dynamic<T>>>;

/// Estimators `G` of the same sizes, mixed by `X`: what every bank is, wherever its members are kept.
#[derive(Clone, Debug)]
pub struct Mixed<G: Members, X: Mixer<G::Weighed>> {
    mixer: X,
    memory: G::Memory,
    /// whether the units of φ are those of the data
    follows_data: bool,
    state: BankState<G, X>,
    buffers: Buffers<G>,
}

/// What the next sample needs.
#[derive(Clone, Debug)]
struct BankState<G: Members, X: Mixer<G::Weighed>> {
    members: G,
    mixer: X::State,
    mixture: Mixture<G>,
    clip: Clip<G>,
    units: Option<Units<G::Memory>>,
}

/// What an update writes to, and the next one need not read.
#[derive(Clone, Debug)]
struct Buffers<G: Members> {
    phi: <G::Memory as Memory>::Rows,
    /// several samples in the units of the members, where these can run side by side
    #[cfg(feature = "alloc")]
    batch: <G::Memory as Memory>::List,
    /// p x m numbers a member: y − φθ, in units of y
    errors: G::Numbers,
    /// the same, whitened
    whitened: G::Numbers,
    /// of the mixture
    error: <G::Memory as Memory>::Errors,
    mixed: <G::Memory as Memory>::Errors,
    leverages: G::Numbers,
    awake: G::Flags,
    /// θ of the mixture in the units of the user, m x n numbers
    theta: <G::Memory as Memory>::Parameters,
    root: <G::Memory as Memory>::Noise,
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

#[cfg(feature = "alloc")]
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

    fn with_units(
        mut members: Vec<AnyEstimator<T>>,
        mixer: AnyMixer<Dynamic<T>>,
        follows_data: bool,
    ) -> Result<Self, Error> {
        members.iter_mut().for_each(|member| {
            member.estimate_noise(follows_data);
            member.reset();
        });
        Ok(Self::of_members(Group::new(members)?, mixer, follows_data))
    }
}

impl<T: Kernels, G: Members<Real = T>, X: Mixer<G::Weighed>> Mixed<G, X> {
    /// These members as they are, mixed by `mixer` from its start.
    pub(crate) fn of_members(members: G, mixer: X, follows_data: bool) -> Self {
        let memory = members.memory();
        let width = memory.rows() * memory.targets();
        let buffers = Buffers {
            phi: memory.regressors(),
            #[cfg(feature = "alloc")]
            batch: memory.list(BATCH * memory.parameters()),
            errors: members.numbers(width),
            whitened: members.numbers(width),
            error: memory.errors(),
            mixed: memory.errors(),
            leverages: members.numbers(1),
            awake: members.flags(),
            theta: memory.theta(),
            root: memory.noise(),
        };
        let learned = mixer.start(members.weighed());
        let state = BankState {
            mixture: Mixture::new(&members, |weights| mixer.weigh(&learned, weights)),
            mixer: learned,
            clip: Clip::new(&members, memory.targets()),
            units: follows_data.then(|| Units::new(memory)),
            members,
        };
        let mut bank = Self { mixer, memory, follows_data, state, buffers };
        bank.express();
        bank
    }

    /// Back to the prior, as if no sample had been seen.
    pub fn reset(&mut self) {
        let Self { mixer, memory, follows_data, state, .. } = self;
        let BankState { members, .. } = state;
        members.each().iter_mut().for_each(Member::reset);
        state.mixer = mixer.start(members.weighed());
        state.mixture = Mixture::new(members, |weights| mixer.weigh(&state.mixer, weights));
        state.clip = Clip::new(members, memory.targets());
        state.units = follows_data.then(|| Units::new(*memory));
        self.express();
    }

    /// Does `work`. If that fails, the bank is as it was before, bit for bit.
    ///
    /// # Errors
    /// Those of `work`.
    pub fn all_or_nothing<Y, E>(
        &mut self,
        work: impl FnOnce(&mut Self) -> Result<Y, E>,
    ) -> Result<Y, E> {
        let (before, theta) = (self.state.clone(), self.buffers.theta.clone());
        work(self).inspect_err(|_| (self.state, self.buffers.theta) = (before, theta))
    }
}
