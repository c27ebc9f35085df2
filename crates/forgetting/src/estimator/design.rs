//! What an estimator is made of. It never changes while samples come.

use super::state::RecursionState;
use crate::covariance::{Factor, Prior};
use crate::gates::{AnyGate, Gate};
use crate::memory::Memory;
use crate::monitor::Monitor;
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::sample::NoiseVariance;
use crate::weightings::Weighting;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::Real;

/// See [`Estimator::WINDUP`](super::Estimator::WINDUP).
pub(super) const WINDUP: f64 = 10.0;

/// Rule, rate, weighting, gate and prior, and what follows from them.
#[derive(Clone, Debug)]
pub(super) struct Design<F, R, W, M: Memory> {
    pub rule: F,
    pub rate: R,
    pub weighting: W,
    pub gate: AnyGate<M>,
    pub prior: Prior<M>,
    /// whether the variance of the noise is estimated where Γ is not given
    pub estimates_noise: bool,
    /// what every sample does to P, if that is all that there is to do
    pub steady: Option<Steady<M::Real>>,
    /// the element of D beyond which P counts as wound up, where no monitor says so
    pub windup_limit: M::Real,
}

/// The same λ and the same form of forgetting for every sample, of one row and one target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Steady<T> {
    pub lambda: T,
    pub form: Form<T>,
}

impl<F, R, W, M> Design<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    /// From these parts.
    pub fn new(rule: F, rate: R, weighting: W, gate: AnyGate<M>, prior: Prior<M>) -> Self {
        let windup = M::Real::from_f64(WINDUP);
        let windup_limit = windup * prior.factor().largest();
        let estimates_noise = prior.is_of_data();
        let mut design = Self {
            rule,
            rate,
            weighting,
            gate,
            prior,
            estimates_noise,
            steady: None,
            windup_limit,
        };
        design.estimates_noise &= design.needs_noise_variance();
        if let Some(lambda) = design.rate.constant().filter(|_| design.is_plain()) {
            let lambda = lambda.max(M::Real::EPSILON);
            let form = design.rule.form(lambda, M::Real::ONE);
            design.steady = form.map(|form| Steady { lambda, form });
        }
        design
    }

    /// Whether samples have one row and one target and are all trusted alike.
    pub fn is_plain(&self) -> bool {
        let memory = self.prior.memory();
        let one = (memory.rows(), memory.targets()) == (1, 1);
        one && self.weighting.is_equal() && self.gate.is_open()
    }

    /// Whether rate, weighting or gate judge errors by their size.
    pub fn needs_noise_variance(&self) -> bool {
        self.rate.needs_noise_variance()
            || self.weighting.needs_noise_variance()
            || self.gate.needs_noise_variance()
    }

    /// The same with another gate.
    pub fn with_gate(self, gate: AnyGate<M>) -> Self {
        Self::new(self.rule, self.rate, self.weighting, gate, self.prior)
    }

    /// The state before the first sample.
    pub fn start(&self, monitored: bool) -> RecursionState<F, R, M> {
        let (memory, mut factor) = (self.prior.memory(), self.prior.factor());
        if self.rule.defers() {
            factor.start_deferring();
        }
        RecursionState {
            monitor: monitored.then(|| self.monitor(&factor)),
            theta: self.prior.theta().clone(),
            rule: self.rule.start(memory),
            rate: self.rate.start(memory),
            samples: 0,
            noise_variance: self.estimates_noise.then_some(NoiseVariance::UNKNOWN),
            factor,
        }
    }

    /// A monitor that starts at this P.
    pub fn monitor(&self, factor: &Factor<M>) -> Monitor<M> {
        Monitor::new(factor, self.rule.is_bounded())
    }
}
