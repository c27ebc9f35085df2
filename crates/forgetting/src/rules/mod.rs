//! Where to forget: one file per rule, one line per rule in the registry below.
//!
//! A rule is the step R̄ = R − F of the recursion (GF-RLS, Theorem 1). It sees P and the whitened
//! sample, never θ. To add one, write its file and add its line: its tests, its documentation,
//! its Python class and its place on the command line follow.

mod about;
mod root;

pub use crate::sample::Skip;
pub use about::{About, Claim};

use crate::parameter::{Value, Values};
use crate::state::{State, Visitor};
use crate::{Error, Factor, Memory, Sample, Work};
use forgetting_kernels::kernel::form::Form;

/// What a rule is given at each sample.
#[derive(Debug)]
pub struct Step<'a, 'b, M: Memory> {
    /// P, with the information of all samples before this one
    pub factor: &'a mut Factor<M>,
    /// the whitened sample; rows that are dropped are neither forgotten nor learned from
    pub sample: &'a mut Sample<'b, M>,
    /// λ_k in (0, 1]
    pub forgetting_factor: M::Real,
    /// buffers to use freely
    pub work: &'a mut Work<M>,
}

/// What a rule did with a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forgotten {
    /// the rank of F: the number of directions that lost information
    pub rank: usize,
    /// why the sample is left out altogether, if it is
    pub skipped: Option<Skip>,
    /// the forgetting factor, where the rule used another than the rate's
    pub forgetting_factor: Option<f64>,
}

impl Forgotten {
    /// F of this rank.
    #[inline]
    pub fn rank(rank: usize) -> Self {
        Self { rank, skipped: None, forgetting_factor: None }
    }

    /// F = 0, and nothing is learned from the sample either.
    #[inline]
    pub fn skipped(reason: Skip) -> Self {
        Self { rank: 0, skipped: Some(reason), forgetting_factor: None }
    }

    /// The same, done with this forgetting factor in place of the rate's.
    #[inline]
    pub fn with_factor(self, forgetting_factor: f64) -> Self {
        Self { forgetting_factor: Some(forgetting_factor), ..self }
    }
}

/// A forgetting rule: P ← P̄ = (P⁻¹ − F)⁻¹.
pub trait Forgetting<M: Memory>: Clone + core::fmt::Debug + Send + Sync {
    /// What the rule remembers from sample to sample beside P.
    type State: State<M::Real>;

    /// The rule with these parameter values, for a problem of these sizes.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and the allowed range.
    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error>;

    /// The rule called `name`, where the type leaves a choice; else the same as `configure`.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a name that is not in the registry, else those of the rule.
    fn called(name: &str, values: &dyn Values, memory: M) -> Result<Self, Error> {
        let _ = name;
        Self::configure(values, memory)
    }

    /// The registry name, where the type leaves a choice; else nothing.
    fn name(&self) -> &'static str {
        ""
    }

    /// Names each parameter with its value: [`Forgetting::configure`] takes them back.
    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>));

    /// The state before the first sample.
    fn start(&self, memory: M) -> Self::State;

    /// Whether P̄ stays bounded whatever the input (A2), so that it cannot wind up.
    fn is_bounded(&self) -> bool {
        false
    }

    /// What the rule does with this forgetting factor for a sample of one row, if it keeps no state
    /// and it is one of the ways that the factor forgets in while it measures.
    ///
    /// The estimator then does not call [`Forgetting::forget`], which must do the same.
    #[inline]
    fn form(&self, forgetting_factor: M::Real) -> Option<Form<M::Real>> {
        let _ = forgetting_factor;
        None
    }

    /// Takes note of a sample that is measured although nothing is forgotten, because a gate
    /// says so. Only a rule whose state follows P need do so; P itself is not to be changed.
    #[inline]
    fn follow(&self, state: &mut Self::State, step: Step<'_, '_, M>) {
        let _ = (state, step);
    }

    /// Forgets. Changes P, may rotate, scale or drop rows of the sample.
    ///
    /// # Errors
    /// [`Error::Range`] when P would overflow; then nothing has changed.
    fn forget(&self, state: &mut Self::State, step: Step<'_, '_, M>) -> Result<Forgotten, Error>;
}

macro_rules! choice_of_rules {
    ($Rule:ident, $State:ident, $which:literal: $($module:ident :: $Variant:ident,)*) => {
        #[doc = concat!($which, ", chosen by name at run time.")]
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the rule of that name")]
        pub enum $Rule<M: Memory> {
            $($Variant($Variant<M>),)*
        }

        #[doc = concat!("The state of ", stringify!($Rule), ".")]
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "each variant is the state of the rule of that name")]
        pub enum $State<M: Memory> {
            $($Variant(<$Variant<M> as Forgetting<M>>::State),)*
        }

        impl<M: Memory> $Rule<M> {
            /// The rule called `name`, with these parameter values.
            ///
            /// # Errors
            /// [`Error::Unknown`] for a name that is not in the registry, [`Error::Value`] for
            /// more rows than the rule takes, else those of the rule.
            pub fn named(name: &str, values: &dyn Values, memory: M) -> Result<Self, Error> {
                match name {
                    $(stringify!($module) => {
                        $module::ABOUT.check_rows(memory.rows())?;
                        <$Variant<M> as Forgetting<M>>::configure(values, memory)
                            .map(Self::$Variant)
                    })*
                    _ => Err(Error::Unknown { parameter: "rule" }),
                }
            }

            /// The entry of this rule in [`RULES`].
            pub fn about(&self) -> About {
                match self {
                    $(Self::$Variant(_) => $module::ABOUT,)*
                }
            }
        }

        impl<M: Memory> State<M::Real> for $State<M> {
            fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
                match self {
                    $(Self::$Variant(state) => state.visit(visitor),)*
                }
            }

            fn is_sound(&self) -> bool {
                match self {
                    $(Self::$Variant(state) => State::<M::Real>::is_sound(state),)*
                }
            }
        }

        impl<M: Memory> Forgetting<M> for $Rule<M> {
            type State = $State<M>;

            fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
                Err(Error::Missing { parameter: "rule" })
            }

            fn called(name: &str, values: &dyn Values, memory: M) -> Result<Self, Error> {
                Self::named(name, values, memory)
            }

            fn name(&self) -> &'static str {
                self.about().name
            }

            fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
                match self {
                    $(Self::$Variant(rule) => rule.describe(each),)*
                }
            }

            fn start(&self, memory: M) -> Self::State {
                match self {
                    $(Self::$Variant(rule) => $State::$Variant(rule.start(memory)),)*
                }
            }

            fn is_bounded(&self) -> bool {
                match self {
                    $(Self::$Variant(rule) => rule.is_bounded(),)*
                }
            }

            #[inline]
            fn form(&self, forgetting_factor: M::Real) -> Option<Form<M::Real>> {
                match self {
                    $(Self::$Variant(rule) => rule.form(forgetting_factor),)*
                }
            }

            #[inline(never)]
            fn follow(&self, state: &mut Self::State, step: Step<'_, '_, M>) {
                match (self, state) {
                    $((Self::$Variant(rule), $State::$Variant(state)) => rule.follow(state, step),)*
                    _ => {}
                }
            }

            // not into every update: it is all the rules there are
            #[inline(never)]
            fn forget(
                &self,
                state: &mut Self::State,
                step: Step<'_, '_, M>,
            ) -> Result<Forgotten, Error> {
                match (self, state) {
                    $((Self::$Variant(rule), $State::$Variant(state)) => rule.forget(state, step),)*
                    _ => Err(Error::State { reason: "the state is that of another rule" }),
                }
            }
        }
    };
}

macro_rules! registry {
    (
        around [$($wrapper:ident :: $Wrapper:ident),*]
        $($module:ident :: $Rule:ident,)*
    ) => {
        $(
            pub mod $module;
            pub use $module::$Rule;
        )*
        $(
            pub mod $wrapper;
            pub use $wrapper::$Wrapper;
        )*

        /// Every rule: its name, parameters, guarantees and documentation.
        pub const RULES: &[About] = &[$($module::ABOUT,)* $($wrapper::ABOUT),*];

        choice_of_rules! {
            Rule, RuleState, "Any rule of the registry":
            $($module::$Rule,)* $($wrapper::$Wrapper,)*
        }
        choice_of_rules! {
            InnerRule, InnerState, "Any rule that another can be put around":
            $($module::$Rule,)*
        }
    };
}

// `around`: rules that take another rule as a parameter
registry! {
    around [covariance_resetting::CovarianceResetting]
    none::NoForgetting,
    exponential::Exponential,
    exponential_resetting::ExponentialResetting,
    cyclic_resetting::CyclicResetting,
    subspace::Subspace,
    directional::Directional,
    oblique_projection::ObliqueProjection,
    restricted::Restricted,
    data_dependent::DataDependent,
    component::Component,
    random_walk::RandomWalk,
    variable_direction::VariableDirection,
    matrix_forgetting::MatrixForgetting,
    efra::Efra,
    constant_trace::ConstantTrace,
    multiple::Multiple,
    custom::Custom,
}
