//! What a bank does with one sample, step by step.

use super::whiten::whiten;
use super::{Bank, BankState, Buffers};
use crate::error::Error;
use crate::estimator::AnyEstimator;
use crate::memory::Memory;
use crate::mixers::Forecasts;
use crate::sample::{Answer, Noise, Skip};
use forgetting_kernels::Kernels;

impl<T: Kernels> Bank<T> {
    /// φ in the units of the members, of which √Γ is the `deviation`.
    pub(super) fn measure(&mut self, phi: &[T], deviation: T) -> Result<(), Error> {
        let measured = self.buffers.phi.as_mut();
        Error::check_length("phi", phi.len(), measured.len())?;
        match &mut self.state.units {
            None => measured.copy_from_slice(phi),
            Some(units) => {
                units.choose(phi, deviation, |_, _| {});
                units.measure(phi, measured);
            }
        }
        Ok(())
    }

    /// Each member takes the sample, or sleeps.
    pub(super) fn update_members(
        &mut self,
        y: &[T],
        noise: Noise<'_, T>,
        elapsed: T,
    ) -> Result<Taken<T>, Error> {
        let Buffers { phi, errors, leverages, awake, .. } = &mut self.buffers;
        let BankState { members, mixture, .. } = &mut self.state;
        let members = members.each();
        let (width, count) = (errors.len() / members.len(), members.len());
        let mut refused = None;
        let mut taken = Taken {
            forgetting_factor: T::ZERO,
            skipped: None,
            gate: Answer::Update,
            windup: true,
            asleep: 0,
        };
        let (mut left_out, mut believed, mut most) = (0, T::ZERO, T::ZERO);
        for (i, member) in members.iter_mut().enumerate() {
            let weight = mixture.weights()[i];
            match member.update_after(elapsed, phi.as_ref(), y, noise) {
                Ok(update) => {
                    awake[i] = true;
                    errors[i * width..(i + 1) * width].copy_from_slice(update.error);
                    leverages[i] = update.leverage;
                    taken.forgetting_factor += weight * update.forgetting_factor;
                    taken.windup &= update.windup || weight == T::ZERO;
                    taken.skipped = taken.skipped.or(update.skipped);
                    if weight > most {
                        (most, taken.gate) = (weight, update.gate);
                    }
                    left_out += usize::from(update.skipped.is_some());
                    believed += weight;
                }
                // what is wrong with the sample itself is wrong for the first member, too
                Err(error) if i == 0 && !matches!(error, Error::Range { .. }) => return Err(error),
                Err(error) => {
                    awake[i] = false;
                    taken.asleep += 1;
                    refused.get_or_insert(error);
                }
            }
        }
        if taken.asleep == count {
            return Err(refused.unwrap_or(Error::Memory));
        }
        if left_out + taken.asleep < count {
            taken.skipped = None;
        }
        taken.forgetting_factor = if believed > T::ZERO {
            (taken.forgetting_factor / believed).min(T::ONE)
        } else {
            T::ONE
        };
        Ok(taken)
    }

    /// The errors of the mixture, and all errors whitened.
    pub(super) fn mix(&mut self, noise: Noise<'_, T>) {
        let Buffers { errors, whitened, error, mixed, awake, root, .. } = &mut self.buffers;
        let mixture = &self.state.mixture;
        let targets = self.memory.targets();
        mixture.errors(errors, awake, error);
        whitened.copy_from_slice(errors);
        mixed.copy_from_slice(error);
        for errors in whitened.chunks_exact_mut(error.len()).chain([mixed.as_mut_slice()]) {
            whiten(errors, targets, noise, root.as_mut());
        }
    }

    /// The mixer learns from a sample that was used, of which the mixture had this leverage.
    pub(super) fn learn(&mut self, leverage: Option<T>) {
        let Self { mixer, memory, state, buffers, .. } = self;
        let BankState { mixture, clip, mixer: remembered, .. } = state;
        if let Some(leverage) = leverage {
            let Buffers { whitened, mixed, awake, .. } = buffers;
            clip.clip(mixture, (whitened, mixed), awake, memory.parameters());
            mixture.note(&buffers.forecasts(), leverage);
            let Buffers { whitened, mixed, .. } = buffers;
            mixture.in_deviations(whitened, mixed);
        }
        let used = leverage.is_some().then(|| buffers.forecasts());
        mixture.learn((mixer, remembered), memory.parameters(), used.as_ref());
    }

    /// Renews the units if that is due, and takes note of θ.
    pub(super) fn follow(&mut self) {
        let BankState { members, units, .. } = &mut self.state;
        if let Some(units) = units {
            if let Some(ratios) = units.due() {
                let members = members.each();
                let largest = ratios.iter().fold(T::ONE, |largest, &r| largest.max(r));
                let fits = |member: &AnyEstimator<T>| {
                    let trace = member.factor().trace();
                    trace * largest * largest < T::CEILING
                };
                if members.iter().all(fits) {
                    members.iter_mut().for_each(|member| member.change_units(ratios));
                    units.renew();
                }
            }
        }
        self.express();
    }

    /// θ of the mixture in the units of the user.
    pub(super) fn express(&mut self) {
        let theta = self.buffers.theta.as_mut();
        self.state.members.theta(self.state.mixture.weights(), theta);
        if let Some(units) = &self.state.units {
            units.express(theta);
        }
    }
}

impl<T: Kernels> Buffers<T> {
    /// What the mixer is shown.
    fn forecasts(&self) -> Forecasts<'_, T> {
        let Self { whitened, mixed, leverages, awake, .. } = self;
        Forecasts { errors: whitened, mixed, leverages, awake }
    }
}

/// What the members did with a sample.
pub(super) struct Taken<T> {
    pub forgetting_factor: T,
    pub skipped: Option<Skip>,
    pub gate: Answer,
    pub windup: bool,
    pub asleep: usize,
}
