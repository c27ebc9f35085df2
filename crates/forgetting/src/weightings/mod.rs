//! How far to trust a sample: a weight w divides its noise covariance, Γ ← Γ/w.
//!
//! One file per weighting, one line per weighting in the registry below.

use crate::choice::registry::registry;
use crate::choice::{Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::{Evidence, Needs};

/// A weighting of samples by their innovation.
pub trait Weighting<M: Memory>: Clone + core::fmt::Debug + Send + Sync {
    /// The weighting with these parameter values.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and the allowed range.
    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error>;

    /// Names each parameter with its value: [`Weighting::configure`] takes them back.
    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>));

    /// What the weighting uses beside the errors.
    #[inline]
    fn needs(&self) -> Needs {
        Needs::Errors
    }

    /// Whether errors are judged by their size: where no Γ is given, the variance of the noise is
    /// estimated for it.
    fn needs_noise_variance(&self) -> bool {
        false
    }

    /// Whether w = 1 for every sample.
    fn is_equal(&self) -> bool {
        false
    }

    /// w, positive, from the whitened innovation.
    fn weight(&self, evidence: &Evidence<'_, '_, M>) -> M::Real;

    /// c ≥ w‖ē‖ for samples of `rows` rows, whatever their error, if there is such a c: then one
    /// sample moves θ_i by at most c ‖(P̄φ̄ᵀ)_i‖.
    fn influence(&self, rows: usize) -> Option<M::Real>;
}

registry! {
    "weighting", "weightings", WEIGHTINGS, AnyWeighting: Weighting {
        #[inline]
        fn needs(&self) -> Needs;
        fn needs_noise_variance(&self) -> bool;
        fn is_equal(&self) -> bool;
        #[inline]
        fn weight(&self, evidence: &Evidence<'_, '_, M>) -> M::Real;
        fn influence(&self, rows: usize) -> Option<M::Real>;
    }
    entries {
        equal::Equal,
        huber::Huber,
        student_t::StudentT,
    }
}
