//! What the next sample needs of those before it.

use crate::covariance::Factor;
use crate::memory::state::{State, Visitor, MOST_SAMPLES};
use crate::memory::Memory;
use crate::monitor::Monitor;
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::sample::NoiseVariance;
use forgetting_kernels::Real;

/// θ, P, what rule and rate remember, the number of samples, and the monitor if there is one.
#[derive(Clone, Debug)]
pub(crate) struct RecursionState<F: Forgetting<M>, R: Rate<M>, M: Memory> {
    pub factor: Factor<M>,
    pub theta: M::Parameters,
    pub rule: F::State,
    pub rate: R::State,
    /// samples used
    pub samples: u64,
    pub monitor: Option<Monitor<M>>,
    /// where Γ is not given, if a choice judges errors by their size
    pub noise_variance: Option<NoiseVariance<M::Real>>,
}

impl<F: Forgetting<M>, R: Rate<M>, M: Memory> State<M::Real> for RecursionState<F, R, M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.factor.visit(visitor);
        visitor.reals(self.theta.as_mut());
        self.rule.visit(visitor);
        self.rate.visit(visitor);
        visitor.whole(&mut self.samples);
        if let Some(monitor) = &mut self.monitor {
            monitor.visit(visitor);
        }
        if let Some(noise_variance) = &mut self.noise_variance {
            noise_variance.visit(visitor);
        }
    }

    fn is_sound(&self) -> bool {
        self.theta.as_ref().iter().all(|x| x.is_finite())
            && self.factor.is_sound()
            && self.rule.is_sound()
            && self.rate.is_sound()
            && self.samples <= MOST_SAMPLES
            && self.monitor.as_ref().is_none_or(State::is_sound)
            && self.noise_variance.as_ref().is_none_or(State::is_sound)
    }
}
