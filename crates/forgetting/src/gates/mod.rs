//! Whether a sample is used: one file per gate, one line per gate in the registry below.
//!
//! A gate sees what is known of a sample before it is used, and says `update`, `freeze` (learn,
//! but forget nothing) or `hold` (do nothing). It remembers nothing.

use crate::parameter::{Parameter, Value, Values};
use crate::sample::{Evidence, Needs};
use crate::{Error, Memory};

mod otherwise;

pub use crate::sample::Answer;

/// What the registry says of a gate.
#[derive(Clone, Copy, Debug)]
pub struct AboutGate {
    /// the registry name, which is also the name of the file
    pub name: &'static str,
    /// the name of the type
    pub type_name: &'static str,
    /// the text of the file; its header (`//!`) is the documentation
    pub source: &'static str,
    /// the parameters
    pub parameters: &'static [Parameter],
}

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

macro_rules! registry {
    ($($(#[$only:meta])* $module:ident :: $Gate:ident,)*) => {
        $(
            $(#[$only])*
            pub mod $module;
            $(#[$only])*
            pub use $module::$Gate;
        )*

        /// Every gate: its name, parameters and documentation.
        pub const GATES: &[AboutGate] = &[$($(#[$only])* $module::ABOUT),*];

        /// Any gate of the registry, chosen by name at run time.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the gate of that name")]
        pub enum AnyGate<M: Memory> {
            $($(#[$only])* $Gate($Gate<M>),)*
        }

        impl<M: Memory> AnyGate<M> {
            /// The gate called `name`, with these parameter values.
            ///
            /// # Errors
            /// [`Error::Unknown`] for a name that is not in the registry, else those of the gate.
            pub fn named(name: &str, values: &dyn Values, memory: M) -> Result<Self, Error> {
                match name {
                    $($(#[$only])* stringify!($module) => {
                        <$Gate<M> as Gate<M>>::configure(values, memory).map(Self::$Gate)
                    })*
                    _ => Err(Error::Unknown { parameter: "gate" }),
                }
            }

            /// The entry of this gate in [`GATES`].
            pub fn about(&self) -> AboutGate {
                match self {
                    $($(#[$only])* Self::$Gate(_) => $module::ABOUT,)*
                }
            }
        }

        impl<M: Memory> Gate<M> for AnyGate<M> {
            fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
                Err(Error::Missing { parameter: "gate" })
            }

            fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
                match self {
                    $($(#[$only])* Self::$Gate(gate) => gate.describe(each),)*
                }
            }

            #[inline]
            fn needs(&self) -> Needs {
                match self {
                    $($(#[$only])* Self::$Gate(gate) => Gate::<M>::needs(gate),)*
                }
            }

            #[inline]
            fn is_open(&self) -> bool {
                match self {
                    $($(#[$only])* Self::$Gate(gate) => Gate::<M>::is_open(gate),)*
                }
            }

            #[inline]
            fn answer(&self, evidence: &Evidence<'_, '_, M>) -> Result<Answer, Error> {
                match self {
                    $($(#[$only])* Self::$Gate(gate) => gate.answer(evidence),)*
                }
            }
        }
    };
}

registry! {
    open::Open,
    minimum_information::MinimumInformation,
    dead_zone::DeadZone,
    #[cfg(feature = "alloc")]
    gate_function::GateFunction,
}
