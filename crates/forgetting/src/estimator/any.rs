//! The estimator of which everything is chosen at run time: what fleets and saved states are made of.

use super::{Estimator, EstimatorState};
use crate::memory::Dynamic;
use crate::rates::AnyRate;
use crate::rules::Rule;
use crate::weightings::AnyWeighting;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::Kernels;

/// An estimator of any size, rule, rate, weighting and gate, chosen at run time.
pub type AnyEstimator<T> =
    Estimator<Rule<Dynamic<T>>, AnyRate<Dynamic<T>>, AnyWeighting<Dynamic<T>>, Dynamic<T>>;

impl<T: Kernels> AnyEstimator<T> {
    /// Everything that changes with the samples.
    pub(crate) fn state(
        &self,
    ) -> &EstimatorState<Rule<Dynamic<T>>, AnyRate<Dynamic<T>>, Dynamic<T>> {
        &self.state
    }

    /// How every sample changes P, if there is nothing to do but to forget, measure and correct.
    pub(crate) fn form(&self) -> Option<Form<T>> {
        self.design.steady.map(|steady| steady.form)
    }

    /// [`Estimator::is_sound`] for a state read from bytes; repairs its bound on P's trace if that
    /// is not one.
    pub(crate) fn check_read(&mut self) -> bool {
        let sound = self.is_sound();
        self.state.factor.check_bound();
        sound
    }
}
