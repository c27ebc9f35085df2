//! How much to forget: λ of each sample. A number is the rate `constant`; a rate goes in the place
//! of the forgetting factor of any rule that takes one.
//!
//! One file per design of the forgetting factor λ_k, one line per design in the registry below.

use crate::choice::registry::registry;
use crate::choice::{Value, Values};
use crate::error::Error;
use crate::memory::state::State;
use crate::memory::Memory;

mod averages;
mod limits;
mod next;
mod windows;

pub use crate::sample::{Evidence, Needs};
pub use averages::{Averages, Memories};
pub use limits::Limits;
pub use next::Next;
pub use windows::Windows;

/// A design of the forgetting factor.
pub trait Rate<M: Memory>: Clone + core::fmt::Debug + Send + Sync {
    /// What the design remembers from sample to sample.
    type State: State<M::Real>;

    /// The rate with these parameter values.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and the allowed range.
    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error>;

    /// Names each parameter with its value: [`Rate::configure`] takes them back.
    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>));

    /// The state before the first sample.
    fn start(&self, memory: M) -> Self::State;

    /// What the design uses beside the errors.
    #[inline]
    fn needs(&self) -> Needs {
        Needs::Errors
    }

    /// Whether errors are judged by their size: where no Γ is given, the variance of the noise is
    /// estimated for it.
    fn needs_noise_variance(&self) -> bool {
        false
    }

    /// λ, if it is the same for every sample and nothing is learned.
    fn constant(&self) -> Option<M::Real> {
        None
    }

    /// Takes note that the units of θ have changed: θ ← S θ and P ← S P S with S = diag(`ratios`).
    /// Only a design whose state is in these units need do so.
    #[inline]
    fn change_units(&self, state: &mut Self::State, ratios: &[M::Real]) {
        let _ = (state, ratios);
    }

    /// λ_k in (0, 1], from what is known before the sample is used.
    ///
    /// A design that finds λ for the next sample keeps it in its state and returns it here.
    ///
    /// # Errors
    /// [`Error::Function`] when a function of the user's fails: the sample is refused.
    fn forgetting_factor(
        &self,
        state: &Self::State,
        evidence: &Evidence<'_, '_, M>,
    ) -> Result<M::Real, Error>;

    /// Takes note of the sample, after it was used with the factor `lambda`.
    #[inline]
    fn learn(&self, _: &mut Self::State, _: &Evidence<'_, '_, M>, lambda: M::Real) {
        let _ = lambda;
    }
}

registry! {
    "rate", "rates", RATES, AnyRate [AnyRateState]: Rate {
        #[inline]
        fn needs(&self) -> Needs;
        fn needs_noise_variance(&self) -> bool;
        fn constant(&self) -> Option<M::Real>;
        #[inline]
        fn forgetting_factor(
            &self,
            state: &State,
            evidence: &Evidence<'_, '_, M>,
        ) -> Result<M::Real, Error>;
        fn change_units(&self, state: &mut State, ratios: &[M::Real]);
        #[inline]
        fn learn(&self, state: &mut State, evidence: &Evidence<'_, '_, M>, lambda: M::Real);
    }
    entries {
        constant::Constant,
        prediction_error::PredictionError,
        fortescue::Fortescue,
        noise_power::NoisePower,
        gradient::Gradient,
        exact_gradient::ExactGradient,
        rms_ratio::RmsRatio,
        f_test::FTest,
        unity_zone::UnityZone,
        schedule::Schedule,
        #[cfg(feature = "alloc")]
        function::Function,
    }
}
