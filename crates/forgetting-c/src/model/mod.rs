//! What the library needs of an estimator.

pub mod bank;
pub mod compact;
#[cfg(feature = "general")]
pub mod general;

use crate::code::Why;
use crate::number::Number;
use crate::report::{Health, Report};
use crate::settings::Settings;
use forgetting::choice::Values;
use forgetting::compact::{Given, Pace, Saved};
use forgetting::{Error, Kernels};

/// An estimator of one row and one target.
pub trait Model: Sized + 'static {
    /// The type of its numbers.
    type Real: Kernels;
    /// The same, as C names it.
    const NUMBER: Number;
    /// The least and the most parameters.
    const PARAMETERS: (usize, usize);

    /// The estimator that `settings` say.
    ///
    /// # Errors
    /// What is refused.
    fn make(settings: &Settings) -> Result<Self, Why>;
    /// n
    fn parameters(&self) -> usize;
    /// Back to the prior.
    fn reset(&mut self);
    /// Samples used.
    fn samples(&self) -> u64;
    /// What its monitor has found, if there is one.
    fn health(&self) -> Option<Health>;
    /// Takes a sample of n numbers `phi`; of a compact estimator it may be one of which this is `given`.
    ///
    /// # Errors
    /// What is refused; nothing has changed.
    fn update(
        &mut self,
        phi: &[Self::Real],
        y: Self::Real,
        given: Option<&Given<Self::Real>>,
    ) -> Result<Report<Self::Real>, Why>;
    /// φθ of n numbers `phi`
    fn predict(&self, phi: &[Self::Real]) -> Self::Real;
    /// θ, n numbers
    fn theta(&self) -> &[Self::Real];
    /// Goes on from θ = `theta`, n numbers.
    ///
    /// # Errors
    /// What is refused; nothing has changed.
    fn set_theta(&mut self, theta: &[Self::Real]) -> Result<(), Why>;
    /// P, written to n x n numbers.
    fn covariance(&mut self, covariance: &mut [Self::Real]);
    /// How far each member of a bank is believed; nothing of an estimator that is none.
    fn weights(&self) -> &[Self::Real] {
        &[]
    }
}

/// One that saves and loads itself, and knows what time and noise do to it.
pub trait Saves: Model {
    /// Takes a sample `elapsed` after the last one, of which Γ is `gamma` if it is known.
    ///
    /// # Errors
    /// What is refused; nothing has changed.
    fn update_after(
        &mut self,
        elapsed: Self::Real,
        phi: &[Self::Real],
        y: Self::Real,
        gamma: Option<Self::Real>,
    ) -> Result<Report<Self::Real>, Why>;
    /// The estimator that was saved as `bytes`.
    ///
    /// # Errors
    /// What is wrong with them.
    fn load(bytes: &[u8]) -> Result<Self, Why>;
    /// Gives its bytes to `put`, piece by piece.
    ///
    /// # Errors
    /// That it cannot be saved.
    fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<(), Why>;
}

/// One that only says what is to be saved.
pub trait Compact: Model {
    /// The name of its rule in the registry.
    const RULE: &'static str;

    /// With these parameters of the rule and this λ; the rest is read later.
    ///
    /// # Errors
    /// What is refused.
    fn of_values(values: &dyn Values, lambda: Self::Real) -> Result<Self, Error>;
    /// What is to be saved.
    fn saved(&mut self) -> &mut dyn Saved<Self::Real>;
    /// What time does to it.
    fn pace(&self) -> Pace<Self::Real>;
}

/// The type of number that C calls so.
pub trait Float: Kernels {
    /// Its name in C.
    const NUMBER: Number;
}

impl Float for f32 {
    const NUMBER: Number = Number::F32;
}

impl Float for f64 {
    const NUMBER: Number = Number::F64;
}
