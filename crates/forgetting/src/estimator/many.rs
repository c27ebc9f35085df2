//! Many samples in one call, where there is nothing to do but to forget, measure and correct.

use super::design::Steady;
use super::recursion::{Numbers, Recursion, Report};
use super::state::RecursionState;
use super::steps::forgotten;
use crate::memory::Memory;
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten};
use crate::sample::{Answer, Skip};
use crate::weightings::Weighting;
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::kernel::watch::Observations;
use forgetting_kernels::Real;

impl<F, R, W, M> Recursion<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    /// Whether a sample is forgotten, measured and corrected, and nothing else is to be done with it.
    #[inline]
    pub fn takes_many(&self) -> bool {
        self.design.steady.is_some() && !self.buffers.diagnostics.keeps_prior()
    }

    /// See [`Estimator::update_many`](super::Estimator::update_many).
    #[inline]
    pub fn update_many(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        outcomes: &mut [Outcome<M::Real>],
        thetas: &mut [M::Real],
    ) -> usize {
        let Self { design, state, buffers } = self;
        let Some(steady) = design.steady.filter(|_| !buffers.diagnostics.keeps_prior()) else {
            return 0;
        };
        // no further than to where the monitor looks at P
        let most = outcomes.len();
        let outcomes = &mut outcomes[..state.monitor.as_ref().map_or(most, |m| m.room(most))];
        let (scratch, theta) = (buffers.work.scratch.as_mut(), state.theta.as_mut());
        let results = (&mut *outcomes, thetas);
        let taken = state.factor.advance(steady.form, (phi, y), scratch, theta, results);
        let outcomes = &mut outcomes[..taken];
        state.samples += outcomes.iter().filter(|outcome| outcome.used).count() as u64;
        state.monitor_many(steady.lambda, phi, outcomes);
        taken
    }

    /// What an update would have reported of a sample that [`Recursion::update_many`] took.
    #[inline]
    pub fn report_of(&self, outcome: &Outcome<M::Real>) -> Report<M::Real> {
        let n = self.design.prior.memory().parameters();
        let (lambda, forgotten) = match self.design.steady {
            Some(Steady { lambda, form }) => (lambda, forgotten(form, outcome.forgot, n)),
            None => (M::Real::ONE, Forgotten::rank(0)),
        };
        Report {
            leverage: outcome.leverage,
            weight: M::Real::ONE,
            forgetting_factor: forgotten.forgetting_factor.map_or(lambda, M::Real::from_f64),
            rank: forgotten.rank,
            skipped: (!outcome.used).then_some(Skip::DeadZone),
            gate: Answer::Update,
            windup: match &self.state.monitor {
                Some(_) => outcome.windup,
                None => outcome.largest > self.design.windup_limit,
            },
            whitened: Numbers::Innovations,
        }
    }
}

impl<F: Forgetting<M>, R: Rate<M>, M: Memory> RecursionState<F, R, M> {
    /// Shows samples to the monitor, if there is one, and notes whether P had wound up after each.
    #[inline]
    fn monitor_many(
        &mut self,
        lambda: M::Real,
        phi: &[M::Real],
        outcomes: &mut [Outcome<M::Real>],
    ) {
        let Some(monitor) = &mut self.monitor else { return };
        let samples = Observations { forgetting_factor: lambda, phi, outcomes: &*outcomes };
        let wound_up = monitor.watch(&self.factor, samples);
        outcomes[..wound_up].iter_mut().for_each(|outcome| outcome.windup = true);
        if let Some(last) = outcomes.last_mut() {
            last.windup = monitor.windup();
        }
    }
}
