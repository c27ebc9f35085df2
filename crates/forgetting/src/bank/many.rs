//! Many samples in one call, where the members run side by side.

use super::members::Members;
use super::{Bank, BankUpdate};
use crate::error::Error;
use crate::memory::Memory;
use crate::mixers::Forecasts;
use crate::sample::{Answer, Noise};
use forgetting_kernels::Kernels;

/// What became of a sample of one row and one target.
#[derive(Clone, Copy, Debug, Default)]
pub struct BankOutcome<T> {
    /// y − φθ of the mixture with the θ of before
    pub error: T,
    /// see [`BankUpdate::leverage`]
    pub leverage: T,
    /// λ of the members, mixed
    pub forgetting_factor: T,
    /// whether P of every member that is believed has wound up
    pub windup: bool,
}

impl<T: Copy> BankOutcome<T> {
    /// What an update would have reported, the error being in `error`.
    pub fn report<'a>(&self, error: &'a [T]) -> BankUpdate<'a, T> {
        let Self { leverage, forgetting_factor, windup, .. } = *self;
        BankUpdate {
            error,
            leverage,
            forgetting_factor,
            skipped: None,
            gate: Answer::Update,
            windup,
            asleep: 0,
        }
    }
}

/// What is kept of each sample beside its outcome: nothing, or room for as many samples.
#[derive(Debug, Default)]
pub struct Kept<'a, T> {
    /// θ after it, n numbers
    pub theta: &'a mut [T],
    /// w of the members with which it was predicted, K numbers
    pub weights: &'a mut [T],
    /// over how many samples the bank remembers, after it
    pub memory: &'a mut [T],
}

impl<T: Kernels> Bank<T> {
    /// Takes the sample of p x n numbers `phi` and p x m numbers `y` with the noise covariance
    /// Γ = `noise`.
    ///
    /// # Errors
    /// [`Error`] names what was wrong, if no member can take the sample; the bank is as it was, bit for
    /// bit.
    pub fn update(
        &mut self,
        phi: &[T],
        y: &[T],
        noise: Noise<'_, T>,
    ) -> Result<BankUpdate<'_, T>, Error> {
        self.update_after(T::ONE, phi, y, noise)
    }

    /// The same, `elapsed` after the last sample; see [`Estimator::update_after`](crate::Estimator).
    ///
    /// # Errors
    /// Those of [`Bank::update`].
    pub fn update_after(
        &mut self,
        elapsed: T,
        phi: &[T],
        y: &[T],
        noise: Noise<'_, T>,
    ) -> Result<BankUpdate<'_, T>, Error> {
        let mut outcome = [BankOutcome::default()];
        if matches!(noise, Noise::Unit)
            && elapsed == T::ONE
            && (phi.len(), y.len()) == (self.memory.parameters(), 1)
            && self.update_many(phi, y, &mut outcome, &mut Kept::default()) == 1
        {
            let error = self.buffers.error.as_mut();
            error[0] = outcome[0].error;
            return Ok(outcome[0].report(error));
        }
        self.update_in_steps(elapsed, phi, y, noise)
    }

    /// Takes samples of n numbers `phi` and one number `y` each, in one call; writes what became of
    /// each to `outcomes` and returns how many it took, at most as many as there are outcomes.
    ///
    /// It takes none unless all members forget in the same way, have one row, one target, equal weights
    /// and no gate, and at most ten parameters, or, if they are random walks, 16 MiB. It stops before a sample
    /// that one of them cannot use: [`Bank::update`] takes that one, or says what is wrong with it. The
    /// result is that of one update a sample, bit for bit. Where a noise or an elapsed time is given,
    /// the members take the sample one by one: of more than ten parameters the same to rounding.
    pub fn update_many(
        &mut self,
        phi: &[T],
        y: &[T],
        outcomes: &mut [BankOutcome<T>],
        kept: &mut Kept<'_, T>,
    ) -> usize {
        let n = self.memory.parameters();
        let Self { state, buffers, .. } = self;
        let Some(lanes) = state.members.lanes() else { return 0 };
        let most = outcomes.len().min(y.len()).min(phi.len() / n).min(lanes.most());
        let taken = match &state.units {
            None => lanes.advance(&phi[..most * n], &y[..most]),
            Some(units) => {
                let most = units.room(phi, most);
                let measured = &mut buffers.batch.as_mut()[..most * n];
                units.measure(&phi[..most * n], measured);
                lanes.advance(measured, &y[..most])
            }
        };
        if taken == 0 {
            return 0;
        }
        buffers.awake.fill(true);
        for (k, outcome) in outcomes[..taken].iter_mut().enumerate() {
            *outcome = self.mix_one(k, kept);
        }
        if let Some(units) = &mut self.state.units {
            units.learn(&self.buffers.batch[..taken * n], taken as u64);
            units.express(kept.theta.get_mut(..taken * n).unwrap_or_default());
        }
        self.follow();
        if let Some(last) = kept.theta.get_mut((taken - 1) * n..taken * n) {
            // as it is read from now on: in units that may have been renewed
            last.copy_from_slice(self.theta());
        }
        taken
    }

    /// Mixes what the members brought at the k-th of the samples that they just took.
    #[inline]
    fn mix_one(&mut self, k: usize, kept: &mut Kept<'_, T>) -> BankOutcome<T> {
        let Self { mixer, memory, state, buffers, .. } = self;
        let (n, count) = (memory.parameters(), state.members.count());
        let Some(lanes) = state.members.in_lanes() else { return BankOutcome::default() };
        let (mixture, (errors, leverages)) = (&mut state.mixture, lanes.outcomes(k));
        if let Some(weights) = kept.weights.get_mut(k * count..(k + 1) * count) {
            weights.copy_from_slice(mixture.weights());
        }
        let (error, leverage) = (mixture.mean_of_all(errors), mixture.mean_of_all(leverages));
        let outcome = BankOutcome {
            error,
            leverage,
            forgetting_factor: lanes.forgetting_factor(mixture.weights()),
            windup: lanes.windup(k, mixture.weights()),
        };
        let forecasts = Forecasts { errors, mixed: &[error], leverages, awake: &buffers.awake };
        mixture.note(&forecasts, leverage);
        mixture.learn((mixer, &mut state.mixer), n, Some(&forecasts));
        if let Some(theta) = kept.theta.get_mut(k * n..(k + 1) * n) {
            lanes.theta_after(k, mixture.weights(), theta);
        }
        if let Some(memory) = kept.memory.get_mut(k) {
            *memory = mixture.memory(n);
        }
        outcome
    }
}
