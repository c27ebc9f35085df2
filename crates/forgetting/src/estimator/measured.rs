//! Regressors in the units that the data choose: what stands between an estimator and its recursion
//! where P₀ follows the data.

use super::recursion::{Recursion, Report};
use crate::error::Error;
use crate::memory::Memory;
use crate::rates::Rate;
use crate::rules::Forgetting;
use crate::sample::Noise;
use crate::units::Units;
use crate::weightings::Weighting;
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::Real;

/// The most samples that are measured before they are used.
const BATCH: usize = 64;

/// The units, and what is expressed in them.
#[derive(Clone, Debug)]
pub(super) struct Measured<M: Memory> {
    pub units: Units<M>,
    /// not state: θ in the units of the user
    pub theta: M::Parameters,
    /// not state: a sample in units of s
    phi: M::Rows,
    /// not state: several samples in units of s, or nothing where lists have no room
    batch: M::List,
}

impl<M: Memory> Measured<M> {
    /// Before the first sample, θ being `theta`.
    pub fn new(memory: M, theta: &M::Parameters) -> Self {
        Self {
            units: Units::new(memory),
            theta: theta.clone(),
            phi: memory.regressors(),
            batch: memory.list(BATCH * memory.parameters()),
        }
    }

    /// Takes note of θ after a sample, here in units of 1/x.
    #[inline]
    pub fn express(&mut self, theta: &[M::Real]) {
        self.theta.as_mut().copy_from_slice(theta);
        self.units.express(self.theta.as_mut());
    }

    /// Takes note of a θ in the units of the user, and expresses it as the recursion has it.
    pub fn set_theta(&mut self, theta: &mut [M::Real]) {
        self.theta.as_mut().copy_from_slice(theta);
        let reciprocals = self.units.reciprocals();
        for target in theta.chunks_exact_mut(reciprocals.len()) {
            target.iter_mut().zip(reciprocals).for_each(|(own, &unit)| *own /= unit);
        }
    }

    /// [`Recursion::update`] for φ in the units of the user.
    pub fn update<F: Forgetting<M>, R: Rate<M>, W: Weighting<M>>(
        &mut self,
        recursion: &mut Recursion<F, R, W, M>,
        (phi, y): (&[M::Real], &[M::Real]),
        noise: Noise<'_, M::Real>,
        elapsed: M::Real,
    ) -> Result<Report<M::Real>, Error> {
        Error::check_length("phi", phi.len(), self.phi.as_ref().len())?;
        let n = recursion.design.prior.memory().parameters();
        let (theta, deviation) = (recursion.state.theta.as_mut(), noise.deviation());
        self.units.choose(phi, deviation, |i, reciprocal| {
            theta.iter_mut().skip(i).step_by(n).for_each(|theta| *theta /= reciprocal);
        });
        self.units.measure(phi, self.phi.as_mut());
        let report = recursion.update(self.phi.as_ref(), y, noise, elapsed);
        if matches!(report, Ok(Report { skipped: None, .. })) {
            self.units.learn_one(self.phi.as_mut(), deviation);
            self.follow(recursion);
        } else {
            self.take_back(recursion.state.theta.as_mut());
        }
        report.map_err(|error| blame(phi, error))
    }

    /// [`Recursion::update_many`] for φ in the units of the user.
    pub fn update_many<F: Forgetting<M>, R: Rate<M>, W: Weighting<M>>(
        &mut self,
        recursion: &mut Recursion<F, R, W, M>,
        (phi, y): (&[M::Real], &[M::Real]),
        outcomes: &mut [Outcome<M::Real>],
        thetas: &mut [M::Real],
    ) -> usize {
        if !recursion.takes_many() {
            return 0;
        }
        let n = recursion.design.prior.memory().parameters();
        let Self { units, phi: single, batch, .. } = self;
        let measured = if batch.as_ref().len() < n { single.as_mut() } else { batch.as_mut() };
        let most = outcomes.len().min(phi.len() / n).min(measured.len() / n);
        let most = units.room(phi, most);
        let measured = &mut measured[..most * n];
        units.measure(&phi[..most * n], measured);
        let taken = recursion.update_many(measured, y, &mut outcomes[..most], thetas);
        if taken == 0 {
            return 0;
        }
        let (measured, outcomes) = (&measured[..taken * n], &outcomes[..taken]);
        let used = outcomes.iter().filter(|outcome| outcome.used).count();
        if used == taken {
            units.learn(measured, taken as u64);
        } else {
            let samples = measured.chunks_exact(n).zip(outcomes);
            samples.filter(|(_, outcome)| outcome.used).for_each(|(x, _)| units.learn(x, 1));
        }
        if !thetas.is_empty() {
            units.express(&mut thetas[..taken * n]);
        }
        if used > 0 {
            self.follow(recursion);
        }
        if let Some(last) = thetas.chunks_exact_mut(n).nth(taken - 1) {
            // in units that may have been renewed, as after one update
            last.copy_from_slice(self.theta.as_ref());
        }
        taken
    }

    /// Renews the units if that is due, and takes note of θ.
    #[inline]
    pub fn follow<F: Forgetting<M>, R: Rate<M>, W: Weighting<M>>(
        &mut self,
        recursion: &mut Recursion<F, R, W, M>,
    ) {
        if let Some(ratios) = self.units.due() {
            if recursion.change_units(ratios).is_ok() {
                self.units.renew();
            }
        }
        self.express(recursion.state.theta.as_ref());
    }

    /// Puts back θ and the units of parameters that had none before a sample that was refused.
    #[cold]
    fn take_back(&mut self, theta: &mut [M::Real]) {
        let own = self.theta.as_ref();
        self.units.unchoose(|i, n| {
            for (theta, &own) in theta.iter_mut().zip(own).skip(i).step_by(n) {
                *theta = own;
            }
        });
    }
}

/// The error in the numbers of the user: that a number of φ is not finite.
#[cold]
fn blame<T: Real>(phi: &[T], error: Error) -> Error {
    match (error, phi.iter().position(|x| !x.is_finite())) {
        (Error::Value { parameter: "phi", allowed, .. }, Some(index)) => Error::Value {
            parameter: "phi",
            index: Some(index),
            value: phi[index].to_f64(),
            allowed,
        },
        (error, _) => error,
    }
}
