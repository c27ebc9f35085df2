//! The recursion step by step: admit, forget, measure and correct, watch.

use super::design::Design;
use super::diagnostics::Diagnostics;
use super::recursion::{Buffers, Numbers, Recursion, Report};
use super::state::RecursionState;
use super::statistics::Statistics;
use crate::error::Error;
use crate::gates::Gate;
use crate::memory::Memory;
use crate::rates::Rate;
use crate::rules::{Forgetting, Forgotten, Step};
use crate::sample::{check_elapsed, factor_after, leverage, measure_rows, whiten};
use crate::sample::{Answer, Needs, Noise, NoiseVariance, Sample, Skip};
use crate::weightings::Weighting;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::watch::Observation;
use forgetting_kernels::Real;

/// A sample that can be used.
struct Admitted<T> {
    statistics: Statistics<T>,
    gate: Answer,
    /// with what the sample tells of it, where it is estimated
    noise_variance: Option<NoiseVariance<T>>,
}

impl<F, R, W, M> Recursion<F, R, W, M>
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
        elapsed: M::Real,
    ) -> Result<Report<M::Real>, Error> {
        check_elapsed(elapsed)?;
        let Admitted { statistics, gate, noise_variance } = self.admit(phi, y, noise)?;
        let Self { design, state, buffers } = self;
        let (memory, squares) = (design.prior.memory(), statistics.squared_regressors);
        let buffer = &mut buffers.sample;
        let clipped = buffer.clipped.as_ref();
        let mut sample = Sample::new(memory, buffer.regressors.as_mut(), buffer.errors.as_mut());
        let lambda = match gate {
            Answer::Update => {
                let evidence = statistics.evidence(&sample, &state.factor, clipped);
                let lambda = usable(design.rate.forgetting_factor(&state.rate, &evidence)?)?;
                factor_after(lambda, elapsed)
            }
            Answer::Freeze | Answer::Hold => M::Real::ONE,
        };
        let step = Step {
            factor: &mut state.factor,
            sample: &mut sample,
            forgetting_factor: lambda,
            elapsed,
            work: &mut buffers.work,
        };
        let rule = (&design.rule, &mut state.rule);
        let theta = (state.theta.as_mut(), &mut buffer.remaining);
        let (Forgotten { rank, skipped, forgetting_factor }, leverage) =
            forget_and_measure((gate, squares), rule, step, theta, &mut buffers.diagnostics)?;
        if skipped.is_none() {
            let evidence = statistics.evidence(&sample, &state.factor, clipped);
            design.rate.learn(&mut state.rate, &evidence, lambda);
            state.samples += 1;
        }
        if noise_variance.is_some() {
            state.noise_variance = noise_variance;
        }
        // what the rule made of the sample is told apart
        let noise = sample.scaled() * sample.scaled();
        let leverage = if noise == M::Real::ONE { leverage } else { leverage / noise };
        if let Some(monitor) = &mut state.monitor {
            let observation = Observation {
                rows: sample.rows(),
                regressors: sample.regressors(),
                errors: sample.errors(),
                squared_error: statistics.weighted_squared_error(),
                leverage,
                forgetting_factor: lambda,
            };
            monitor.watch_one(&state.factor, skipped.is_none().then_some(observation));
        }
        Ok(Report {
            leverage,
            weight: statistics.weight() * noise,
            forgetting_factor: forgetting_factor.map_or(lambda, M::Real::from_f64),
            rank,
            skipped,
            gate,
            windup: match &state.monitor {
                Some(monitor) => monitor.windup(),
                None => state.factor.exceeds(design.windup_limit),
            },
            whitened: match memory.rows() {
                1 => Numbers::Errors(noise),
                _ => Numbers::Diagnostics,
            },
        })
    }

    /// Checks the sample and leaves it in its buffers, whitened, and weighted unless the gate holds
    /// it. The state has not changed.
    #[inline]
    fn admit(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
    ) -> Result<Admitted<M::Real>, Error> {
        let Design { rate, weighting, gate, prior, .. } = &self.design;
        let RecursionState { factor, theta, samples, noise_variance, .. } = &self.state;
        let Buffers { sample: buffer, work, .. } = &mut self.buffers;
        let memory = prior.memory();
        let squares = buffer.load(memory, theta.as_ref(), phi, y)?;
        let mut sample = Sample::new(memory, buffer.regressors.as_mut(), buffer.errors.as_mut());
        whiten(&mut sample, noise, buffer.noise.as_mut())?;
        let unit = matches!(noise, Noise::Unit);
        let squares = if unit { squares } else { sample.squared_regressors() };
        let mut statistics = Statistics::of(memory, &sample, squares, *samples)?;
        let noise_variance = noise_variance.filter(|_| unit);
        let of_noise = noise_variance.map_or(Needs::Errors, |_| Needs::Leverage);
        let needs = rate.needs().max(weighting.needs()).max(gate.needs()).max(of_noise);
        let free = (buffer.remaining.as_mut(), buffer.noise.as_mut());
        statistics.compute(needs, factor, &sample, work, free);
        let n = memory.parameters();
        let noise_variance = noise_variance.map(|estimate| statistics.judge_by(estimate, n));
        let gate = statistics.ask(gate, &sample, factor)?;
        if gate != Answer::Hold {
            statistics.weigh(weighting, &mut sample, buffer.clipped.as_mut(), factor)?;
        }
        Ok(Admitted { statistics, gate, noise_variance })
    }
}

/// Forgets as gate and rule say, measures and corrects θ; returns what was forgotten and
/// tr φ̄P̄φ̄ᵀ. Records in `diagnostics` what is asked for.
#[inline]
fn forget_and_measure<F: Forgetting<M>, M: Memory>(
    (gate, squares): (Answer, M::Real),
    (rule, state): (&F, &mut F::State),
    step: Step<'_, '_, M>,
    (theta, remaining): (&mut [M::Real], &mut M::Errors),
    diagnostics: &mut Diagnostics<M>,
) -> Result<(Forgotten, M::Real), Error> {
    let Step { factor, sample, forgetting_factor, elapsed, work } = step;
    diagnostics.record_sample(sample);
    let form = match (gate, sample.rows()) {
        (Answer::Update, 1) => rule.form(forgetting_factor, elapsed),
        (Answer::Freeze, 1) => Some(Form::NOTHING),
        _ => None,
    };
    let left_out = match form {
        _ if gate == Answer::Hold => Some(Skip::Gate),
        Some(Form::Along { dead_zone, .. }) if dead_zone.holds(squares) => Some(Skip::DeadZone),
        _ => None,
    };
    if let Some(reason) = left_out {
        diagnostics.record_prior(factor, work);
        return Ok((Forgotten::skipped(reason), leverage(factor, sample)));
    }
    if gate == Answer::Freeze {
        rule.follow(state, Step { factor, sample, forgetting_factor, elapsed, work });
    }
    if let Some(form) = form {
        if let (Answer::Update, Some(factor)) = (gate, diagnostics.copy_prior(factor)) {
            forget(rule, state, Step { factor, sample, forgetting_factor, elapsed, work })?;
        }
        let (f, scratch) = (sample.row(0), work.scratch.as_mut());
        let measured = factor.measure(form, (f, squares), scratch, (theta, sample.error(0)));
        return Ok((forgotten(form, measured.forgot, factor.parameters()), measured.leverage));
    }
    let forgotten = match gate {
        Answer::Update => {
            forget(rule, state, Step { factor, sample, forgetting_factor, elapsed, work })?
        }
        Answer::Freeze | Answer::Hold => Forgotten::rank(0),
    };
    diagnostics.record_prior(factor, work);
    let leverage = if forgotten.skipped.is_some() {
        sample.restore();
        leverage(factor, sample)
    } else {
        measure_rows(factor, sample, work.gain.as_mut(), theta, remaining)
    };
    Ok((forgotten, leverage))
}

/// What the rule forgets: nothing where P would leave the range of the number type.
#[inline]
fn forget<F: Forgetting<M>, M: Memory>(
    rule: &F,
    state: &mut F::State,
    step: Step<'_, '_, M>,
) -> Result<Forgotten, Error> {
    let Step { factor, sample, forgetting_factor, elapsed, work } = step;
    let again = Step { factor, sample, forgetting_factor, elapsed, work };
    match rule.forget(state, again) {
        Err(Error::Range { .. }) => {
            rule.follow(state, Step { factor, sample, forgetting_factor, elapsed, work });
            Ok(Forgotten::rank(0).with_factor(1.0))
        }
        forgotten => forgotten,
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

/// What forgetting in this form did to P, of n parameters.
#[inline]
pub(super) fn forgotten<T: Real>(form: Form<T>, forgot: bool, n: usize) -> Forgotten {
    match form {
        Form::Scale { growth } if growth == T::ONE => Forgotten::rank(0).with_factor(1.0),
        Form::Scale { .. } if !forgot => Forgotten::rank(0).with_factor(1.0),
        Form::Scale { .. } => Forgotten::rank(n),
        Form::Along { .. } => Forgotten::rank(usize::from(forgot)),
        Form::Walk { .. } => Forgotten::rank(if forgot { n } else { 0 }),
    }
}
