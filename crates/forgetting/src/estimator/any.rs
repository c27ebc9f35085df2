//! The estimator of which everything is chosen at run time: what fleets and saved states are made of.

use super::design::Design;
use super::{Estimator, Recursion};
use crate::error::Error;
use crate::memory::Memory;
use crate::rates::{AnyRate, Constant, Rate};
use crate::rules::Rule;
use crate::sample::NoiseVariance;
use crate::weightings::AnyWeighting;
#[cfg(feature = "alloc")]
use {
    crate::memory::Dynamic,
    crate::rules::Forgetting,
    forgetting_kernels::{kernel::form::Form, Kernels},
};

/// An estimator of which rule, rate, weighting and gate are chosen by name.
pub type Named<M> = Estimator<Rule<M>, AnyRate<M>, AnyWeighting<M>, M>;

/// An estimator of which the size is chosen at run time, too.
#[cfg(feature = "alloc")]
pub type AnyEstimator<T> = Named<Dynamic<T>>;

impl<M: Memory> Named<M> {
    /// Forgets by this constant factor from now on, λ in (0, 1].
    ///
    /// # Errors
    /// [`Error`] names the factor unless it is in range, or says that the estimator has a rate that chooses
    /// it; nothing has changed.
    pub fn set_forgetting_factor(&mut self, factor: M::Real) -> Result<(), Error> {
        let constant = Constant::new(factor)?;
        let Design { rule, rate, weighting, gate, prior, estimates_noise, .. } =
            self.recursion.design.clone();
        if rate.constant().is_none() {
            let reason = "the forgetting factor cannot be set: a rate chooses it";
            return Err(Error::Unsupported { reason });
        }
        let design = Design::new(rule, AnyRate::Constant(constant), weighting, gate, prior);
        self.recursion.design = Design { estimates_noise, ..design };
        Ok(())
    }

    /// Whether the variance of the noise is to be estimated where Γ is not given, if any choice needs
    /// it: nothing is known of it from now on.
    pub(crate) fn estimate_noise(&mut self, estimate: bool) {
        let Recursion { design, state, .. } = &mut self.recursion;
        design.estimates_noise = estimate && design.needs_noise_variance();
        state.noise_variance = design.estimates_noise.then_some(NoiseVariance::UNKNOWN);
    }

    /// Whether it does so.
    pub(crate) fn estimates_noise(&self) -> bool {
        self.recursion.design.estimates_noise
    }

    /// Goes on in other units, for which there must be room: θ ← S θ and P ← S P S with
    /// S = diag(`ratios`).
    pub(crate) fn change_units(&mut self, ratios: &[M::Real]) {
        let changed = self.recursion.change_units(ratios);
        debug_assert!(changed.is_ok(), "there is room");
    }

    /// [`Estimator::is_sound`] for a state read from bytes; repairs its bound on P's trace if that
    /// is not one.
    pub(crate) fn check_read(&mut self) -> bool {
        let sound = self.is_sound();
        self.recursion.state.factor.check_bound();
        sound
    }
}

#[cfg(feature = "alloc")]
impl<T: Kernels> AnyEstimator<T> {
    /// How every sample changes P, if there is nothing to do but to forget, measure and correct.
    pub(crate) fn form(&self) -> Option<Form<T>> {
        self.recursion.design.steady.map(|steady| steady.form)
    }

    /// The same beside other estimators of the same kind: also a walk of many parameters.
    pub(crate) fn form_beside_others(&self) -> Option<Form<T>> {
        let design = &self.recursion.design;
        self.form().or_else(|| design.rule.walk().filter(|_| design.is_plain()))
    }

    /// Renews the units of the data after the last sample, for which that is due.
    pub(crate) fn renew_units(&mut self) {
        if let Some(measured) = &mut self.measured {
            measured.follow(&mut self.recursion);
        }
    }

    /// The element of D beyond which P counts as wound up, where no monitor says so.
    pub(crate) fn windup_limit(&self) -> T {
        self.recursion.design.windup_limit
    }
}
