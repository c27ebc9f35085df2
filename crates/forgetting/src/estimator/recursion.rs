//! The recursion in the units that it is given: design, state, buffers.

use super::design::Design;
use super::diagnostics::Diagnostics;
use super::state::RecursionState;
use crate::error::Error;
use crate::memory::Memory;
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::sample::{Answer, Noise, SampleBuffers, Skip, Update, Whitened, Work};
use crate::weightings::Weighting;
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::Real;

/// What an estimator is made of but for the units: the recursion takes φ as it is.
#[derive(Clone, Debug)]
pub(super) struct Recursion<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    pub design: Design<F, R, W, M>,
    pub state: RecursionState<F, R, M>,
    pub buffers: Buffers<M>,
}

/// What an update writes to, and the next one need not read.
#[derive(Clone, Debug)]
pub(super) struct Buffers<M: Memory> {
    pub sample: SampleBuffers<M>,
    pub work: Work<M>,
    pub diagnostics: Diagnostics<M>,
}

/// What an update reports, but for the numbers that stay in the buffers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Report<T> {
    pub leverage: T,
    pub weight: T,
    pub forgetting_factor: T,
    pub rank: usize,
    pub skipped: Option<Skip>,
    pub gate: Answer,
    pub windup: bool,
    pub whitened: Numbers<T>,
}

/// Where the whitened errors of a report are.
#[derive(Clone, Copy, Debug)]
pub(super) enum Numbers<T> {
    /// the errors themselves: one row, Γ = 1
    Innovations,
    /// the whitened errors of one row, of which this is 1/Γ
    Errors(T),
    /// with the diagnostics
    Diagnostics,
}

impl<F, R, W, M> Recursion<F, R, W, M>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    /// At the start of `design`.
    pub fn new(design: Design<F, R, W, M>) -> Self {
        let memory = design.prior.memory();
        let buffers = Buffers {
            sample: SampleBuffers::new(memory),
            work: Work::new(memory),
            diagnostics: Diagnostics::new(),
        };
        Self { state: design.start(false), design, buffers }
    }

    /// Takes a sample with the noise covariance Γ = `noise`, so much time after the last one.
    #[inline]
    pub fn update(
        &mut self,
        phi: &[M::Real],
        y: &[M::Real],
        noise: Noise<'_, M::Real>,
        elapsed: M::Real,
    ) -> Result<Report<M::Real>, Error> {
        let n = self.design.prior.memory().parameters();
        let mut outcome = [Outcome::default()];
        if phi.len() == n
            && y.len() == 1
            && matches!(noise, Noise::Unit)
            && elapsed == M::Real::ONE
            && self.update_many(phi, y, &mut outcome, &mut []) == 1
        {
            self.buffers.sample.innovations.as_mut()[0] = outcome[0].error;
            return Ok(self.report_of(&outcome[0]));
        }
        self.update_in_steps(phi, y, noise, elapsed)
    }

    /// What is reported, with the numbers that are in the buffers.
    #[inline]
    pub fn complete(&self, report: Report<M::Real>) -> Update<'_, M::Real> {
        let Buffers { sample, diagnostics, .. } = &self.buffers;
        report.with(
            sample.innovations.as_ref(),
            match report.whitened {
                Numbers::Innovations => {
                    Whitened::Row { errors: sample.innovations.as_ref(), noise: M::Real::ONE }
                }
                Numbers::Errors(noise) => Whitened::Row { errors: sample.errors.as_ref(), noise },
                Numbers::Diagnostics => diagnostics.whitened(),
            },
        )
    }

    /// θ ← S θ and P ← S P S with S = diag(`ratios`).
    ///
    /// # Errors
    /// [`Error::Range`] when P would leave the range of the number type; nothing has changed.
    pub fn change_units(&mut self, ratios: &[M::Real]) -> Result<(), Error> {
        let Self { design, state, buffers } = self;
        state.factor.change_units(ratios)?;
        buffers.diagnostics.change_units(ratios);
        for theta in state.theta.as_mut().chunks_exact_mut(ratios.len()) {
            theta.iter_mut().zip(ratios).for_each(|(theta, &ratio)| *theta *= ratio);
        }
        design.rule.change_units(&mut state.rule, ratios);
        design.rate.change_units(&mut state.rate, ratios);
        if let Some(monitor) = &mut state.monitor {
            monitor.change_units(ratios);
        }
        Ok(())
    }
}

impl<T: Real> Report<T> {
    /// The update of these errors.
    #[inline]
    pub fn with<'a>(self, error: &'a [T], whitened: Whitened<'a, T>) -> Update<'a, T> {
        let Self { leverage, weight, forgetting_factor, rank, skipped, gate, windup, .. } = self;
        Update { error, leverage, weight, forgetting_factor, rank, skipped, gate, windup, whitened }
    }
}
