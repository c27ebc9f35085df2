//! Where to forget: which directions of P.
//!
//! One file per rule, one line per rule in the registry below. A rule is the step R̄ = R − F of the
//! recursion (GF-RLS, Theorem 1). It sees P and the whitened sample, never θ. To add one, write its
//! file and add its line: its tests, its documentation, its Python class and its place on the
//! command line follow.

mod along_sample;
mod block_root;
mod blocks;
pub(crate) mod cycle;
mod ellipsoid;
mod root;

pub use crate::sample::Skip;
pub use blocks::Blocks;
pub use covariance_resetting::criterion;

use crate::choice::registry::registry;
use crate::choice::{Bounds, Constants, Value, Values};
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::state::State;
use crate::memory::Memory;
use crate::sample::{Sample, Work};
use forgetting_kernels::kernel::form::Form;

/// What a rule is given at each sample.
#[derive(Debug)]
pub struct Step<'a, 'b, M: Memory> {
    /// P, with the information of all samples before this one
    pub factor: &'a mut Factor<M>,
    /// the whitened sample; rows that are dropped are neither forgotten nor learned from
    pub sample: &'a mut Sample<'b, M>,
    /// λ_k in (0, 1], of the time that has passed
    pub forgetting_factor: M::Real,
    /// the time that has passed since the last sample, in units in which whatever a rule forgets by
    /// itself is stated: 1 where samples count
    pub elapsed: M::Real,
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

    /// Whether the rule adds to P by [`Factor::defer_diagonal`] where that is possible.
    fn defers(&self) -> bool {
        false
    }

    /// Bounds of the eigenvalues of P, where a formula for them is known; the header derives it.
    fn bounds(&self, constants: &Constants) -> Bounds {
        let _ = constants;
        Bounds::default()
    }

    /// What the rule does with this forgetting factor, `elapsed` after the last sample, for a sample of
    /// one row, if it keeps no state and it is one of the ways that the factor forgets in while it
    /// measures.
    ///
    /// The estimator then does not call [`Forgetting::forget`], which must do the same.
    #[inline]
    fn form(&self, forgetting_factor: M::Real, elapsed: M::Real) -> Option<Form<M::Real>> {
        let _ = (forgetting_factor, elapsed);
        None
    }

    /// The walk that [`Forgetting::forget`] takes at each sample, one unit of time after the last, if it is
    /// one of any number of parameters, and the rule keeps no state.
    fn walk(&self) -> Option<Form<M::Real>> {
        None
    }

    /// Takes note of a sample that is measured although nothing is forgotten, because a gate
    /// says so. Only a rule whose state follows P need do so; P itself is not to be changed.
    #[inline]
    fn follow(&self, state: &mut Self::State, step: Step<'_, '_, M>) {
        let _ = (state, step);
    }

    /// Takes note that the units of θ have changed: θ ← S θ and P ← S P S with S = diag(`ratios`).
    /// Only a rule whose state is in these units need do so.
    #[inline]
    fn change_units(&self, state: &mut Self::State, ratios: &[M::Real]) {
        let _ = (state, ratios);
    }

    /// Takes a sample before which P was replaced, by the one in `step`: chooses what is measured of
    /// it, as [`Forgetting::forget`] would, and takes from this P whatever the state keeps of P.
    /// Nothing is forgotten: the caller puts P back afterwards, or on an error.
    ///
    /// The default forgets, which is right where the state keeps nothing of P.
    ///
    /// # Errors
    /// Those of [`Forgetting::forget`]; then the state has not changed.
    #[inline]
    fn restart(&self, state: &mut Self::State, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        self.forget(state, step)
    }

    /// Forgets. Changes P, may rotate, scale or drop rows of the sample.
    ///
    /// # Errors
    /// [`Error::Range`] when P would overflow; then nothing has changed, and the sample is learned from
    /// without forgetting.
    fn forget(&self, state: &mut Self::State, step: Step<'_, '_, M>) -> Result<Forgotten, Error>;
}

registry! {
    "rule", "rules", RULES, Rule [RuleState]: Forgetting {
        fn is_bounded(&self) -> bool;
        fn defers(&self) -> bool;
        fn bounds(&self, constants: &Constants) -> Bounds;
        #[inline]
        fn form(&self, forgetting_factor: M::Real, elapsed: M::Real) -> Option<Form<M::Real>>;
        fn walk(&self) -> Option<Form<M::Real>>;
        #[inline(never)]
        fn follow(&self, state: &mut State, step: Step<'_, '_, M>);
        fn change_units(&self, state: &mut State, ratios: &[M::Real]);
        #[inline(never)]
        fn restart(&self, state: &mut State, step: Step<'_, '_, M>) -> Result<Forgotten, Error>;
        // not into every update: it is all the rules there are
        #[inline(never)]
        fn forget(&self, state: &mut State, step: Step<'_, '_, M>) -> Result<Forgotten, Error>;
    }
    entries {
        none::NoForgetting,
        exponential::Exponential,
        exponential_resetting::ExponentialResetting,
        cyclic_resetting::CyclicResetting,
        stabilised::Stabilised,
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
    // rules that take another rule as a parameter
    around InnerRule [InnerState] {
        covariance_resetting::CovarianceResetting,
    }
    also {
        fn called(name: &str, values: &dyn Values, memory: M) -> Result<Self, Error> {
            Self::named(name, values, memory)
        }

        fn name(&self) -> &'static str {
            Self::called(self)
        }
    }
}
