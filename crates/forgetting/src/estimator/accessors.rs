//! Reading an estimator: predictions, θ, P, the monitor, what it was made of, and its state.

use super::Estimator;
use crate::covariance::{Factor, Prior};
use crate::error::Error;
use crate::gates::AnyGate;
use crate::memory::state::{State, Visitor};
use crate::memory::Memory;
use crate::monitor::{Health, Monitor};
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::weightings::Weighting;
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
        let memory = self.recursion.design.prior.memory();
        let (n, m) = (memory.parameters(), memory.targets());
        if n == 0 || phi.len() % n != 0 {
            return Err(Error::Length { parameter: "phi", length: phi.len(), expected: n });
        }
        Error::check_length("prediction", prediction.len(), phi.len() / n * m)?;
        for (row, predicted) in phi.chunks_exact(n).zip(prediction.chunks_exact_mut(m)) {
            for (theta, y) in self.theta().chunks_exact(n).zip(predicted) {
                *y = dot(row, theta);
            }
        }
        Ok(())
    }

    /// What the monitor has found, if there is one.
    pub fn health(&self) -> Option<Health<'_, M::Real>> {
        self.recursion.state.monitor.as_ref().map(Monitor::health)
    }

    /// Keeps, from now on or no longer, P̄ of the last sample: [`Estimator::prior_factor`].
    /// O(n²) a sample.
    pub fn keep_prior(&mut self, keep: bool) {
        self.recursion.buffers.diagnostics.keep_prior(keep, &self.recursion.state.factor);
    }

    /// Keeps, from now on or no longer, what [`Update::whiten`] needs for samples of several rows:
    /// O(p n²/2 + p² n) a sample. For one row it costs nothing and need not be asked for.
    pub fn keep_innovations(&mut self, keep: bool) {
        self.recursion
            .buffers
            .diagnostics
            .keep_innovations(keep, self.recursion.design.prior.memory());
    }

    /// P̄ of the last sample, after forgetting and before the data, if it is kept: as the recursion has
    /// it, see [`Estimator::factor`].
    pub fn prior_factor(&self) -> Option<&Factor<M>> {
        self.recursion.buffers.diagnostics.prior()
    }

    /// θ, m x n numbers, one target after the other.
    #[inline]
    pub fn theta(&self) -> &[M::Real] {
        match &self.measured {
            None => self.recursion.state.theta.as_ref(),
            Some(measured) => measured.theta.as_ref(),
        }
    }

    /// P, factored, as the recursion has it: where P₀ follows the data, for regressors in units that
    /// the data chose; see [`Estimator::express`].
    #[inline]
    pub fn factor(&self) -> &Factor<M> {
        &self.recursion.state.factor
    }

    /// 1/s_i, where P₀ follows the data: the recursion is given φ_i/s_i.
    pub fn reciprocal_units(&self) -> Option<&[M::Real]> {
        self.measured.as_ref().map(|measured| measured.units.reciprocals())
    }

    /// P as the recursion has it, in the units of the user. O(n²).
    pub fn express(&self, factor: &Factor<M>) -> Factor<M> {
        let mut factor = factor.clone();
        if let Some(reciprocals) = self.reciprocal_units() {
            factor.express(reciprocals);
        }
        factor
    }

    /// Samples used since the start; skipped ones do not count.
    pub fn samples(&self) -> u64 {
        self.recursion.state.samples
    }

    /// The forgetting rule.
    pub fn rule(&self) -> &F {
        &self.recursion.design.rule
    }

    /// The design of the forgetting factor.
    pub fn rate(&self) -> &R {
        &self.recursion.design.rate
    }

    /// What the design of the forgetting factor remembers.
    pub fn rate_state(&self) -> &R::State {
        &self.recursion.state.rate
    }

    /// The weighting of samples.
    pub fn weighting(&self) -> &W {
        &self.recursion.design.weighting
    }

    /// What decides whether a sample is used.
    pub fn gate(&self) -> &AnyGate<M> {
        &self.recursion.design.gate
    }

    /// θ₀ and P₀.
    pub fn prior(&self) -> &Prior<M> {
        &self.recursion.design.prior
    }

    /// Whether θ is finite, P positive definite, and what the rule, the rate and the monitor
    /// remember is what they can: as after every sample.
    pub fn is_sound(&self) -> bool {
        self.recursion.state.is_sound()
            && self.measured.as_ref().is_none_or(|measured| measured.units.is_sound())
    }

    /// Shows every number of the state to `visitor`.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        let state = &mut self.recursion.state;
        state.visit(visitor);
        if let Some(measured) = &mut self.measured {
            measured.units.visit(visitor);
            measured.express(state.theta.as_ref());
        }
    }
}
