//! The recursion step by step: admit, forget, measure and correct, watch.

use super::{forgotten, Estimator};
use crate::between::Between;
use crate::evidence::Known;
use crate::gates::{Answer, Gate};
use crate::intake::{whiten, Noise};
use crate::measure::{leverage, measure_rows};
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten, Skip, Step};
use crate::update::{Update, Whitened};
use crate::weighting::Weighting;
use crate::{Error, Memory, Real, Sample};
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::watch::Observation;

/// What is known of a sample before it is used, and what the gate says of it.
struct Admitted<T> {
    known: Known<T>,
    gate: Answer,
    /// ‖φ̄‖²
    squares: T,
}

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
        let Admitted { known, gate, squares } = self.admit(phi, y, noise)?;
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
        let step = Step {
            factor: &mut self.factor,
            sample: &mut sample,
            forgetting_factor: lambda,
            work: &mut self.work,
        };
        let rule = (&self.rule, &mut self.rule_state);
        let buffers = (self.theta.as_mut(), &mut intake.remaining);
        let (Forgotten { rank, skipped, forgetting_factor }, leverage) =
            forget_and_measure((gate, squares), rule, step, buffers, &mut self.between)?;
        if skipped.is_none() {
            let evidence = known.evidence(&sample, &self.factor, seen, self.samples);
            self.rate.learn(&mut self.rate_state, &evidence, lambda);
            self.samples += 1;
        }
        if let Some(monitor) = &mut self.monitor {
            let observation = Observation {
                rows: sample.rows(),
                regressors: sample.regressors(),
                errors: sample.errors(),
                squared_error: known.used_error(),
                leverage,
                forgetting_factor: lambda,
            };
            monitor.watch_one(&self.factor, skipped.is_none().then_some(observation));
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
            whitened: match memory.rows() {
                1 => Whitened::Row { errors: self.intake.errors.as_ref(), noise },
                _ => self.between.whitened(),
            },
        })
    }

    /// Leaves the sample in its buffers, whitened, and weighted unless it is held. Nothing that
    /// lasts has changed.
    #[inline]
    fn admit(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<Admitted<M::Real>, Error> {
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
        let squares = if self.weighting.is_equal() { squares } else { sample.squared_regressors() };
        Ok(Admitted { known, gate, squares })
    }
}

/// Forgets as gate and rule say, measures and corrects θ; returns what was forgotten and
/// tr φ̄P̄φ̄ᵀ. Leaves in `between` what is asked for.
#[inline]
fn forget_and_measure<F: Forgetting<M>, M: Memory>(
    (gate, squares): (Answer, M::Real),
    (rule, state): (&F, &mut F::State),
    step: Step<'_, '_, M>,
    (theta, remaining): (&mut [M::Real], &mut M::Errors),
    between: &mut Between<M>,
) -> Result<(Forgotten, M::Real), Error> {
    let Step { factor, sample, forgetting_factor, work } = step;
    between.take(sample);
    let form = match (gate, sample.rows()) {
        (Answer::Update, 1) => rule.form(forgetting_factor),
        (Answer::Freeze, 1) => Some(Form::Scale { growth: M::Real::ONE }),
        _ => None,
    };
    let left_out = match form {
        _ if gate == Answer::Hold => Some(Skip::Gate),
        Some(Form::Along { dead_zone, .. }) if dead_zone.holds(squares) => Some(Skip::DeadZone),
        _ => None,
    };
    if let Some(reason) = left_out {
        between.look(factor, work);
        return Ok((Forgotten::skipped(reason), leverage(factor, sample)));
    }
    if gate == Answer::Freeze {
        rule.follow(state, Step { factor, sample, forgetting_factor, work });
    }
    if let Some(form) = form {
        if let (Answer::Update, Some(factor)) = (gate, between.copy(factor)) {
            rule.forget(state, Step { factor, sample, forgetting_factor, work })?;
        }
        let (f, scratch) = (sample.row(0), work.scratch.as_mut());
        let measured = factor.measure(form, (f, squares), scratch, (theta, sample.error(0)))?;
        return Ok((forgotten(form, measured.forgot, factor.parameters()), measured.leverage));
    }
    let forgotten = match gate {
        Answer::Update => rule.forget(state, Step { factor, sample, forgetting_factor, work })?,
        Answer::Freeze | Answer::Hold => Forgotten::rank(0),
    };
    between.look(factor, work);
    let leverage = if forgotten.skipped.is_some() {
        sample.restore();
        leverage(factor, sample)
    } else {
        measure_rows(factor, sample, work.gain.as_mut(), theta, remaining)
    };
    Ok((forgotten, leverage))
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
