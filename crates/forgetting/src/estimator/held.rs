//! What an estimator holds and shows: θ, P, what it was made of, and its state.

use super::Estimator;
use crate::gates::AnyGate;
use crate::monitor::{Health, Monitor};
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::state::{State, Visitor, MOST_SAMPLES};
use crate::weighting::Weighting;
use crate::{Error, Factor, Memory, Prior, Real};
use forgetting_kernels::kernel::functions::dot;

impl<F, R, W, M> Estimator<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    /// φθ for p x n numbers `phi`, row by row; writes p x m numbers to `prediction`.
    ///
    /// # Errors
    /// [`Error::Length`] names what does not fit.
    pub fn predict(&self, phi: &[M::Real], prediction: &mut [M::Real]) -> Result<(), Error> {
        let memory = self.prior.memory();
        let (n, m) = (memory.parameters(), memory.targets());
        if n == 0 || phi.len() % n != 0 {
            return Err(Error::Length { parameter: "phi", length: phi.len(), expected: n });
        }
        Error::check_length("prediction", prediction.len(), phi.len() / n * m)?;
        for (row, predicted) in phi.chunks_exact(n).zip(prediction.chunks_exact_mut(m)) {
            for (theta, y) in self.theta.as_ref().chunks_exact(n).zip(predicted) {
                *y = dot(row, theta);
            }
        }
        Ok(())
    }

    /// What the watch has seen, if there is one.
    pub fn health(&self) -> Option<Health<'_, M::Real>> {
        self.monitor.as_ref().map(Monitor::health)
    }

    /// Keeps, from now on or no longer, P̄ of the last sample: [`Estimator::prior_factor`].
    /// O(n²) a sample.
    pub fn keep_prior(&mut self, keep: bool) {
        self.between.keep_prior(keep, &self.factor);
    }

    /// Keeps, from now on or no longer, what [`Update::whiten`] needs for samples of several rows:
    /// O(p n²/2 + p² n) a sample. For one row it costs nothing and need not be asked for.
    pub fn keep_innovations(&mut self, keep: bool) {
        self.between.keep_innovations(keep, self.prior.memory());
    }

    /// P̄ of the last sample, after forgetting and before the data, if it is kept.
    pub fn prior_factor(&self) -> Option<&Factor<M>> {
        self.between.prior()
    }

    /// θ, m x n numbers, one target after the other.
    #[inline]
    pub fn theta(&self) -> &[M::Real] {
        self.theta.as_ref()
    }

    /// P, factored.
    #[inline]
    pub fn factor(&self) -> &Factor<M> {
        &self.factor
    }

    /// Samples used since the start; skipped ones do not count.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// The forgetting rule.
    pub fn rule(&self) -> &F {
        &self.rule
    }

    /// The design of the forgetting factor.
    pub fn rate(&self) -> &R {
        &self.rate
    }

    /// What the design of the forgetting factor remembers.
    pub fn rate_state(&self) -> &R::State {
        &self.rate_state
    }

    /// The weighting of samples.
    pub fn weighting(&self) -> &W {
        &self.weighting
    }

    /// What decides whether a sample is used.
    pub fn gate(&self) -> &AnyGate<M> {
        &self.gate
    }

    /// θ₀ and P₀.
    pub fn prior(&self) -> &Prior<M> {
        &self.prior
    }

    /// Whether θ is finite, P positive definite, and what the rule, the rate and the watch
    /// remember is what they can: as after every sample.
    pub fn is_sound(&self) -> bool {
        self.theta.as_ref().iter().all(|x| x.is_finite())
            && self.factor.is_sound()
            && self.rule_state.is_sound()
            && self.rate_state.is_sound()
            && self.samples <= MOST_SAMPLES
            && self.monitor.as_ref().is_none_or(State::is_sound)
    }

    /// [`Estimator::is_sound`] for a state that was read, of which the bound of P's trace may be
    /// none.
    #[cfg(feature = "alloc")]
    pub(crate) fn check_read(&mut self) -> bool {
        let sound = self.is_sound();
        self.factor.check_bound();
        sound
    }

    /// Shows every number of the state to `visitor`.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.factor.visit(visitor);
        visitor.reals(self.theta.as_mut());
        self.rule_state.visit(visitor);
        self.rate_state.visit(visitor);
        visitor.whole(&mut self.samples);
        if let Some(monitor) = &mut self.monitor {
            monitor.visit(visitor);
        }
    }
}
