//! How far to trust a sample: one file per weighting, one line per weighting in the registry
//! below. A weight w divides the sample's noise covariance: Γ ← Γ/w.

use crate::parameter::{Parameter, Value, Values};
use crate::sample::{Evidence, Needs};
use crate::{Error, Memory};

/// What the registry says of a weighting.
#[derive(Clone, Copy, Debug)]
pub struct AboutWeighting {
    /// the registry name, which is also the name of the file
    pub name: &'static str,
    /// the name of the type
    pub type_name: &'static str,
    /// the text of the file; its header (`//!`) is the documentation
    pub source: &'static str,
    /// the parameters
    pub parameters: &'static [Parameter],
}

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

macro_rules! registry {
    ($($module:ident :: $Weighting:ident,)*) => {
        $(
            pub mod $module;
            pub use $module::$Weighting;
        )*

        /// Every weighting: its name, parameters and documentation.
        pub const WEIGHTINGS: &[AboutWeighting] = &[$($module::ABOUT),*];

        /// Any weighting of the registry, chosen by name at run time.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the weighting of that name")]
        pub enum AnyWeighting<M: Memory> {
            $($Weighting($Weighting<M>),)*
        }

        impl<M: Memory> AnyWeighting<M> {
            /// The weighting called `name`, with these parameter values.
            ///
            /// # Errors
            /// [`Error::Unknown`] for a name not in the registry, else those of the weighting.
            pub fn named(name: &str, values: &dyn Values, memory: M) -> Result<Self, Error> {
                match name {
                    $(stringify!($module) => {
                        <$Weighting<M> as Weighting<M>>::configure(values, memory)
                            .map(Self::$Weighting)
                    })*
                    _ => Err(Error::Unknown { parameter: "weighting" }),
                }
            }

            /// The entry of this weighting in [`WEIGHTINGS`].
            pub fn about(&self) -> AboutWeighting {
                match self {
                    $(Self::$Weighting(_) => $module::ABOUT,)*
                }
            }
        }

        impl<M: Memory> Weighting<M> for AnyWeighting<M> {
            fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
                Err(Error::Missing { parameter: "weighting" })
            }

            fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
                match self {
                    $(Self::$Weighting(weighting) => weighting.describe(each),)*
                }
            }

            #[inline]
            fn needs(&self) -> Needs {
                match self {
                    $(Self::$Weighting(weighting) => weighting.needs(),)*
                }
            }

            fn is_equal(&self) -> bool {
                match self {
                    $(Self::$Weighting(weighting) => weighting.is_equal(),)*
                }
            }

            #[inline]
            fn weight(&self, evidence: &Evidence<'_, '_, M>) -> M::Real {
                match self {
                    $(Self::$Weighting(weighting) => weighting.weight(evidence),)*
                }
            }

            fn influence(&self, rows: usize) -> Option<M::Real> {
                match self {
                    $(Self::$Weighting(weighting) => weighting.influence(rows),)*
                }
            }
        }
    };
}

registry! {
    equal::Equal,
    huber::Huber,
    student_t::StudentT,
}
