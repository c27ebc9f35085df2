//! What a bank does with one sample, step by step.

use super::members::{Brought, Member, Members};
use super::whiten::whiten;
use super::{BankState, BankUpdate, Buffers, Mixed};
use crate::error::Error;
use crate::memory::Memory;
use crate::mixers::{Forecasts, Mixer};
use crate::sample::{Answer, Noise, Skip};
use forgetting_kernels::{Kernels, Real};

impl<T: Kernels, G: Members<Real = T>, X: Mixer<G::Weighed>> Mixed<G, X> {
    /// Takes a sample `elapsed` after the last one, member by member.
    ///
    /// # Errors
    /// [`Error`] names what was wrong, if no member can take the sample; the bank is as it was, bit for
    /// bit.
    pub(crate) fn update_in_steps(
        &mut self,
        elapsed: T,
        phi: &[T],
        y: &[T],
        noise: Noise<'_, T>,
    ) -> Result<BankUpdate<'_, T>, Error> {
        let noise = match noise {
            Noise::Full(_) if !G::SEVERAL_ROWS => {
                return Err(Error::Unsupported { reason: "a matrix gamma is for several rows" });
            }
            noise => noise,
        };
        self.measure(phi, noise.deviation())?;
        let taken = self.update_members(y, noise, elapsed);
        let Taken { forgetting_factor, skipped, gate, windup, asleep } = match taken {
            Ok(taken) => taken,
            Err(error) => {
                if let Some(units) = &mut self.state.units {
                    units.unchoose(|_, _| {});
                }
                return Err(error);
            }
        };
        self.mix(noise);
        let Buffers { leverages, awake, .. } = &self.buffers;
        let leverage = self.state.mixture.mean(leverages.as_ref(), awake.as_ref());
        self.learn(skipped.is_none().then_some(leverage));
        if let Some(units) = &mut self.state.units {
            match skipped {
                None => units.learn_one(self.buffers.phi.as_mut(), noise.deviation()),
                Some(_) => units.unchoose(|_, _| {}),
            }
        }
        if skipped.is_none() {
            self.follow();
        }
        let error = self.buffers.error.as_ref();
        Ok(BankUpdate { error, leverage, forgetting_factor, skipped, gate, windup, asleep })
    }

    /// φ in the units of the members, of which √Γ is the `deviation`.
    fn measure(&mut self, phi: &[T], deviation: T) -> Result<(), Error> {
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
    fn update_members(
        &mut self,
        y: &[T],
        noise: Noise<'_, T>,
        elapsed: T,
    ) -> Result<Taken<T>, Error> {
        let Buffers { phi, errors, leverages, awake, .. } = &mut self.buffers;
        let BankState { members, mixture, .. } = &mut self.state;
        let (width, count) = (self.memory.rows() * self.memory.targets(), members.count());
        let mut refused = None;
        let mut taken = Taken {
            forgetting_factor: T::ZERO,
            skipped: None,
            gate: Answer::Update,
            windup: true,
            asleep: 0,
        };
        let (mut left_out, mut believed, mut most) = (0, T::ZERO, T::ZERO);
        let places = errors.as_mut().chunks_exact_mut(width).zip(leverages.as_mut());
        let places = places.zip(awake.as_mut()).zip(mixture.weights());
        for (i, (member, place)) in members.each().iter_mut().zip(places).enumerate() {
            let (((errors, leverage), awake), &weight) = place;
            match member.take(elapsed, (phi.as_ref(), y), noise, errors) {
                Ok(Brought { leverage: own, forgetting_factor, skipped, gate, windup }) => {
                    *awake = true;
                    *leverage = own;
                    taken.forgetting_factor += weight * forgetting_factor;
                    taken.windup &= windup || weight == T::ZERO;
                    taken.skipped = taken.skipped.or(skipped);
                    if weight > most {
                        (most, taken.gate) = (weight, gate);
                    }
                    left_out += usize::from(skipped.is_some());
                    believed += weight;
                }
                // what is wrong with the sample itself is wrong for the first member, too
                Err(error) if i == 0 && !matches!(error, Error::Range { .. }) => return Err(error),
                Err(error) => {
                    *awake = false;
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
    fn mix(&mut self, noise: Noise<'_, T>) {
        let Buffers { errors, whitened, error, mixed, awake, root, .. } = &mut self.buffers;
        let (targets, error) = (self.memory.targets(), error.as_mut());
        let (whitened, mixed) = (whitened.as_mut(), mixed.as_mut());
        self.state.mixture.errors(errors.as_ref(), awake.as_ref(), error);
        whitened.copy_from_slice(errors.as_ref());
        mixed.copy_from_slice(error);
        for errors in whitened.chunks_exact_mut(error.len()).chain([mixed]) {
            whiten(errors, targets, noise, root.as_mut());
        }
    }

    /// The mixer learns from a sample that was used, of which the mixture had this leverage.
    fn learn(&mut self, leverage: Option<T>) {
        let Self { mixer, memory, state, buffers, .. } = self;
        let BankState { mixture, clip, mixer: remembered, .. } = state;
        let mut used = false;
        if let Some(leverage) = leverage {
            let Buffers { whitened, mixed, awake, .. } = buffers;
            let numbers = (whitened.as_mut(), mixed.as_mut());
            used = clip.clip(mixture, numbers, awake.as_ref(), memory.parameters());
            mixture.note(&buffers.forecasts(), leverage);
            let Buffers { whitened, mixed, .. } = buffers;
            clip.in_usual_units(mixture, whitened.as_mut(), mixed.as_mut());
        }
        let used = used.then(|| buffers.forecasts());
        mixture.learn((mixer, remembered), memory.parameters(), used.as_ref());
    }

    /// Renews the units if that is due, and takes note of θ.
    pub(super) fn follow(&mut self) {
        let BankState { members, units, .. } = &mut self.state;
        if let Some(units) = units {
            if let Some(ratios) = units.due() {
                let members = members.each();
                let largest = ratios.iter().fold(T::ONE, |largest, &r| largest.max(r));
                let fits = |member: &G::Member| member.trace() * largest * largest < T::CEILING;
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

impl<T: Real, G: Members<Real = T>> Buffers<G> {
    /// What the mixer is shown.
    fn forecasts(&self) -> Forecasts<'_, T> {
        Forecasts {
            errors: self.whitened.as_ref(),
            mixed: self.mixed.as_ref(),
            leverages: self.leverages.as_ref(),
            awake: self.awake.as_ref(),
        }
    }
}

/// What the members did with a sample.
struct Taken<T> {
    forgetting_factor: T,
    skipped: Option<Skip>,
    gate: Answer,
    windup: bool,
    asleep: usize,
}
