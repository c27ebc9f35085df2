//! How much to forget: one file per design of the forgetting factor λ_k, one line per design in
//! the registry below. Every rule that uses a forgetting factor takes any of them.

use crate::parameter::{Parameter, Value, Values};
use crate::state::{State, Visitor};
use crate::{Error, Memory};

mod averages;
mod f_law;
mod limits;
mod next;
mod windows;

pub use crate::sample::{Evidence, Needs};
pub use averages::{Averages, Memories};
pub use limits::Limits;
pub use next::Next;
pub use windows::Windows;

/// What the registry says of a rate.
#[derive(Clone, Copy, Debug)]
pub struct AboutRate {
    /// the registry name, which is also the name of the file
    pub name: &'static str,
    /// the name of the type
    pub type_name: &'static str,
    /// the text of the file; its header (`//!`) is the documentation
    pub source: &'static str,
    /// the parameters
    pub parameters: &'static [Parameter],
}

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

    /// λ, if it is the same for every sample and nothing is learned.
    fn constant(&self) -> Option<M::Real> {
        None
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

macro_rules! registry {
    ($($(#[$only:meta])* $module:ident :: $Rate:ident,)*) => {
        $(
            $(#[$only])*
            pub mod $module;
            $(#[$only])*
            pub use $module::$Rate;
        )*

        /// Every rate: its name, parameters and documentation.
        pub const RATES: &[AboutRate] = &[$($(#[$only])* $module::ABOUT),*];

        /// Any rate of the registry, chosen by name at run time.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the rate of that name")]
        pub enum AnyRate<M: Memory> {
            $($(#[$only])* $Rate($Rate<M>),)*
        }

        /// The state of any rate of the registry.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the state of the rate of that name")]
        pub enum AnyRateState<M: Memory> {
            $($(#[$only])* $Rate(<$Rate<M> as Rate<M>>::State),)*
        }

        impl<M: Memory> AnyRate<M> {
            /// The rate called `name`, with these parameter values.
            ///
            /// # Errors
            /// [`Error::Unknown`] for a name that is not in the registry, else those of the rate.
            pub fn named(name: &str, values: &dyn Values, memory: M) -> Result<Self, Error> {
                match name {
                    $($(#[$only])* stringify!($module) => {
                        <$Rate<M> as Rate<M>>::configure(values, memory).map(Self::$Rate)
                    })*
                    _ => Err(Error::Unknown { parameter: "rate" }),
                }
            }

            /// The entry of this rate in [`RATES`].
            pub fn about(&self) -> AboutRate {
                match self {
                    $($(#[$only])* Self::$Rate(_) => $module::ABOUT,)*
                }
            }
        }

        impl<M: Memory> State<M::Real> for AnyRateState<M> {
            fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
                match self {
                    $($(#[$only])* Self::$Rate(state) => state.visit(visitor),)*
                }
            }

            fn is_sound(&self) -> bool {
                match self {
                    $($(#[$only])* Self::$Rate(state) => State::<M::Real>::is_sound(state),)*
                }
            }
        }

        impl<M: Memory> Rate<M> for AnyRate<M> {
            type State = AnyRateState<M>;

            fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
                Err(Error::Missing { parameter: "rate" })
            }

            fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
                match self {
                    $($(#[$only])* Self::$Rate(rate) => rate.describe(each),)*
                }
            }

            fn start(&self, memory: M) -> Self::State {
                match self {
                    $($(#[$only])* Self::$Rate(rate) => AnyRateState::$Rate(rate.start(memory)),)*
                }
            }

            #[inline]
            fn needs(&self) -> Needs {
                match self {
                    $($(#[$only])* Self::$Rate(rate) => rate.needs(),)*
                }
            }

            fn constant(&self) -> Option<M::Real> {
                match self {
                    $($(#[$only])* Self::$Rate(rate) => rate.constant(),)*
                }
            }

            #[inline]
            fn forgetting_factor(
                &self,
                state: &Self::State,
                evidence: &Evidence<'_, '_, M>,
            ) -> Result<M::Real, Error> {
                match (self, state) {
                    $($(#[$only])* (Self::$Rate(rate), AnyRateState::$Rate(state)) => {
                        rate.forgetting_factor(state, evidence)
                    })*
                    _ => Err(Error::State { reason: "the state is that of another rate" }),
                }
            }

            #[inline]
            fn learn(
                &self,
                state: &mut Self::State,
                evidence: &Evidence<'_, '_, M>,
                lambda: M::Real,
            ) {
                match (self, state) {
                    $($(#[$only])* (Self::$Rate(rate), AnyRateState::$Rate(state)) => {
                        rate.learn(state, evidence, lambda);
                    })*
                    _ => {}
                }
            }
        }
    };
}

registry! {
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
