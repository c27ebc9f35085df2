//! The recursion step by step: admit, forget, measure and correct, watch.

use super::{scaled, Estimator};
use crate::evidence::Known;
use crate::gates::{Answer, Gate};
use crate::intake::{whiten, Noise};
use crate::measure::{leverage, measure};
use crate::monitor::Seen;
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten, Skip, Step};
use crate::update::{Update, Whitened};
use crate::weighting::Weighting;
use crate::{Error, Memory, Real, Sample};

impl<F, R, W, M> Estimator<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    /// The whole recursion.
    #[inline(never)]
    pub(super) fn update_in_steps(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<Update<'_, M::Real>, Error> {
        let memory = self.prior.memory();
        let (known, gate) = self.admit(phi, y, noise)?;
        let intake = &mut self.intake;
        let seen = intake.seen.as_ref();
        let mut sample = Sample::new(memory, intake.regressors.as_mut(), intake.errors.as_mut());
        let lambda = match gate {
            Answer::Update => {
                let evidence = known.evidence(&sample, &self.factor, seen, self.samples);
                usable(self.rate.forgetting_factor(&self.rate_state, &evidence)?)?
            }
            Answer::Freeze | Answer::Hold => M::Real::ONE,
        };
        self.between.take(&sample);
        let step = Step {
            factor: &mut self.factor,
            sample: &mut sample,
            forgetting_factor: lambda,
            work: &mut self.work,
        };
        let (forgotten, growth) = forget(gate, &self.rule, &mut self.rule_state, step)?;
        let Forgotten { rank, skipped, forgetting_factor } = forgotten;
        self.between.look(&self.factor, growth, &mut self.work);
        let leverage = if skipped.is_some() {
            sample.restore();
            leverage(&self.factor, &sample)
        } else {
            let (gain, theta) = (self.work.gain.as_mut(), self.theta.as_mut());
            let remaining = &mut intake.remaining;
            let leverage = measure(&mut self.factor, growth, &sample, gain, theta, remaining);
            let evidence = known.evidence(&sample, &self.factor, seen, self.samples);
            self.rate.learn(&mut self.rate_state, &evidence, lambda);
            self.samples += 1;
            leverage
        };
        if let Some(monitor) = &mut self.monitor {
            let squared_error = known.used_error();
            let seen = Seen { sample: &sample, squared_error, leverage, forgetting_factor: lambda };
            monitor.watch(&self.factor, skipped.is_none().then_some(seen));
        }
        let noise = sample.scaled() * sample.scaled();
        Ok(Update {
            error: self.intake.innovations.as_ref(),
            leverage,
            forgetting_factor: forgetting_factor.map_or(lambda, M::Real::from_f64),
            rank,
            skipped,
            gate,
            windup: match &self.monitor {
                Some(monitor) => monitor.windup(),
                None => self.factor.exceeds(self.windup_limit),
            },
            whitened: if memory.rows() == 1 {
                Whitened::Row { errors: self.intake.errors.as_ref(), noise }
            } else {
                self.between.whitened()
            },
        })
    }

    /// Leaves the sample in its buffers, whitened, and weighted unless it is held; returns what is
    /// known of it and what the gate says. Nothing that lasts has changed.
    #[inline]
    fn admit(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<(Known<M::Real>, Answer), Error> {
        let memory = self.prior.memory();
        let intake = &mut self.intake;
        let squares = intake.take(memory, self.theta.as_ref(), phi, y)?;
        let mut sample = Sample::new(memory, intake.regressors.as_mut(), intake.errors.as_mut());
        whiten(&mut sample, noise, intake.noise.as_mut())?;
        let unit = matches!(noise, Noise::Unit);
        let squares = if unit { squares } else { sample.squared_regressors() };
        let mut known = Known::of(memory, &sample, squares)?;
        let needs = self.rate.needs().max(self.weighting.needs()).max(self.gate.needs());
        let buffers = (intake.remaining.as_mut(), intake.noise.as_mut());
        known.find(needs, &self.factor, &sample, &mut self.work, buffers);
        let gate = known.ask(&self.gate, &sample, &self.factor, self.samples)?;
        if gate != Answer::Hold {
            let seen = intake.seen.as_mut();
            known.weigh(&self.weighting, &mut sample, seen, &self.factor, self.samples)?;
        }
        Ok((known, gate))
    }
}

/// λ, if it is one.
///
/// Less than the rounding unit forgets every digit all the same, and would swamp those of the
/// directions that are kept: it is taken as that unit.
#[inline]
fn usable<T: Real>(lambda: T) -> Result<T, Error> {
    if lambda > T::ZERO && lambda <= T::ONE {
        Ok(lambda.max(T::EPSILON))
    } else {
        Err(Error::value("forgetting_factor", lambda.to_f64(), "(0, 1]"))
    }
}

/// Forgets as the rule does, if the gate says so; returns what a single row must still scale P
/// with while it is measured, else 1.
#[inline]
fn forget<F: Forgetting<M>, M: Memory>(
    gate: Answer,
    rule: &F,
    state: &mut F::State,
    step: Step<'_, '_, M>,
) -> Result<(Forgotten, M::Real), Error> {
    let one = M::Real::ONE;
    match (gate, rule.scaling(step.forgetting_factor)) {
        (Answer::Hold, _) => Ok((Forgotten::skipped(Skip::Gate), one)),
        (Answer::Freeze, _) => {
            rule.follow(state, step);
            Ok((Forgotten::rank(0), one))
        }
        (Answer::Update, Some(growth)) if step.sample.rows() == 1 => {
            step.factor.reserve(growth, M::Real::ZERO)?;
            Ok((scaled(growth, step.factor.parameters()), growth))
        }
        (Answer::Update, _) => Ok((rule.forget(state, step)?, one)),
    }
}
