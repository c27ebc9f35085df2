//! Whether a sample is used: `update`, `freeze` (learn from it, forget nothing) or `hold` (leave it
//! alone). A gate stands before rule, rate and weighting.
//!
//! One file per gate, one line per gate in the registry below. A gate judges by the evidence of the
//! sample, before it is used, and has no state.

use crate::choice::registry::registry;
use crate::choice::{Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::{Evidence, Needs};

mod otherwise;

pub use crate::sample::Answer;

/// What decides whether a sample is used.
pub trait Gate<M: Memory>: Clone + core::fmt::Debug + Send + Sync {
    /// The gate with these parameter values.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and the allowed range.
    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error>;

    /// Names each parameter with its value: [`Gate::configure`] takes them back.
    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>));

    /// What the gate uses beside the errors.
    #[inline]
    fn needs(&self) -> Needs {
        Needs::Errors
    }

    /// Whether errors are judged by their size: where no Γ is given, the variance of the noise is
    /// estimated for it.
    fn needs_noise_variance(&self) -> bool {
        false
    }

    /// Whether every sample passes, so that it need not be asked.
    fn is_open(&self) -> bool {
        false
    }

    /// What is done with the sample. Its errors are whitened, and not yet weighted.
    ///
    /// # Errors
    /// [`Error::Function`] when a function of the user's fails: the sample is refused.
    fn answer(&self, evidence: &Evidence<'_, '_, M>) -> Result<Answer, Error>;
}

registry! {
    "gate", "gates", GATES, AnyGate: Gate {
        #[inline]
        fn needs(&self) -> Needs;
        fn needs_noise_variance(&self) -> bool;
        #[inline]
        fn is_open(&self) -> bool;
        #[inline]
        fn answer(&self, evidence: &Evidence<'_, '_, M>) -> Result<Answer, Error>;
    }
    entries {
        open::Open,
        minimum_information::MinimumInformation,
        dead_zone::DeadZone,
        #[cfg(feature = "alloc")]
        gate_function::GateFunction,
    }
}
