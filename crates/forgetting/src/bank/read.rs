//! Reading a bank: predictions, θ, P, weights, memory, its members.

use super::members::{Member, Members};
use super::Mixed;
use crate::error::Error;
use crate::memory::state::{State, Visitor};
use crate::memory::Memory;
use crate::mixers::Mixer;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::{Kernels, Real};
#[cfg(feature = "alloc")]
use {super::Bank, crate::estimator::AnyEstimator, alloc::borrow::Cow};

impl<T: Kernels, G: Members<Real = T>, X: Mixer<G::Weighed>> Mixed<G, X> {
    /// φθ for rows of n numbers `phi`; writes m numbers a row to `prediction`.
    ///
    /// # Errors
    /// [`Error::Length`] names what does not fit.
    pub fn predict(&self, phi: &[T], prediction: &mut [T]) -> Result<(), Error> {
        let memory = self.memory;
        let (n, m) = (memory.parameters(), memory.targets());
        if !phi.len().is_multiple_of(n) {
            return Err(Error::Length { parameter: "phi", length: phi.len(), expected: n });
        }
        Error::check_length("prediction", prediction.len(), phi.len() / n * m)?;
        for (row, predicted) in phi.chunks_exact(n).zip(prediction.chunks_exact_mut(m)) {
            for (theta, y) in self.theta().chunks_exact(n).zip(predicted) {
                *y = dot(row, theta);
            }
        }
        Ok(())
    }

    /// θ of the mixture, m x n numbers, one target after the other.
    pub fn theta(&self) -> &[T] {
        self.buffers.theta.as_ref()
    }

    /// w of each member for the next sample.
    pub fn weights(&self) -> &[T] {
        self.state.mixture.weights()
    }

    /// Over how many samples the mixture remembers: Σ w_i n/h̄_i.
    pub fn memory_in_samples(&self) -> T {
        self.state.mixture.memory(self.memory.parameters())
    }

    /// σ²: the variance of the whitened noise, over up to the last thousand samples; 0 before the first.
    pub fn noise_variance(&self) -> T {
        self.state.mixture.noise_variance()
    }

    /// P of the mixture as n x n numbers, with what the members disagree about. O(K n³).
    pub fn covariance(&self, dense: &mut [T]) {
        let memory = self.memory;
        let n = memory.parameters();
        let (mut own, mut distance) = (memory.square(), memory.vector());
        let (own, distance) = (own.as_mut(), distance.as_mut());
        dense.fill(T::ZERO);
        self.state.members.visit_each(|i, member| {
            let weight = self.weights()[i];
            if !(weight > T::ZERO) {
                return;
            }
            member.covariance(self.reciprocal_units(), own);
            dense.iter_mut().zip(&*own).for_each(|(sum, &p)| *sum += weight * p);
            for (t, theta) in member.theta().chunks_exact(n).enumerate() {
                distance.copy_from_slice(theta);
                if let Some(units) = &self.state.units {
                    units.express(distance);
                }
                let mixed = &self.theta()[t * n..(t + 1) * n];
                distance.iter_mut().zip(mixed).for_each(|(own, &mixed)| *own -= mixed);
                if let Some(per_target) = self.disagreement_in(t) {
                    add_square(dense, weight / per_target, distance);
                }
            }
        });
    }

    /// What squares of distances between members are divided by for target t, to be in units of the
    /// noise variance and averaged over targets; nothing where members cannot disagree.
    fn disagreement_in(&self, t: usize) -> Option<T> {
        let targets = T::from_f64(self.memory.targets() as f64);
        let per_target = self.state.mixture.target_variance(t) * targets;
        (per_target > T::ZERO && self.state.members.count() > 1).then_some(per_target)
    }

    /// Samples used since the start.
    pub fn samples(&self) -> u64 {
        self.state.mixture.samples()
    }

    /// Its sizes.
    pub fn memory(&self) -> G::Memory {
        self.memory
    }

    /// Whether φ is measured in units that the data choose.
    pub fn follows_data(&self) -> bool {
        self.follows_data
    }

    /// 1/s_i, where the bank follows the data: its members are given φ_i/s_i.
    pub fn reciprocal_units(&self) -> Option<&[T]> {
        self.state.units.as_ref().map(|units| units.reciprocals())
    }

    /// Whether what the bank remembers is what it can: as after every sample.
    pub fn is_sound(&self) -> bool {
        let (state, mut members) = (&self.state, true);
        state.members.visit_each(|_, member| members &= member.is_sound());
        members
            && state.mixer.is_sound()
            && state.mixture.is_sound()
            && state.clip.is_sound()
            && state.units.as_ref().is_none_or(State::is_sound)
    }

    /// Shows every number of the state to `visitor`, which may put others in their place: as many, and in
    /// the same order, as those of any bank of the same members, mixer and units.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        self.state.members.visit(visitor);
        self.visit_own(visitor);
    }

    /// What mixes them.
    pub fn mixer(&self) -> &X {
        &self.mixer
    }

    /// The members, to be updated one by one.
    pub(crate) fn each(&mut self) -> &mut [G::Member] {
        self.state.members.each()
    }

    /// Shows every number of the state but those of the members to `visitor`.
    pub(crate) fn visit_own(&mut self, visitor: &mut dyn Visitor<T>) {
        self.state.mixer.visit(visitor);
        self.state.mixture.visit(visitor);
        self.state.clip.visit(visitor);
        if let Some(units) = &mut self.state.units {
            units.visit(visitor);
        }
        self.express();
    }
}

#[cfg(feature = "alloc")]
impl<T: Kernels> Bank<T> {
    /// The diagonal of P of the mixture, n numbers. O(K n²).
    pub fn variances(&self, variances: &mut [T]) {
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        let mut own = alloc::vec![T::ZERO; n];
        variances.fill(T::ZERO);
        self.state.members.visit_each(|k, member| {
            let weight = self.weights()[k];
            if !(weight > T::ZERO) {
                return;
            }
            member.factor().variances(&mut own);
            for (i, (sum, &p)) in variances.iter_mut().zip(&own).enumerate() {
                let unit = self.reciprocal_units().map_or(T::ONE, |units| units[i]);
                *sum += weight * p * unit * unit;
                for t in 0..m {
                    let Some(per_target) = self.disagreement_in(t) else { continue };
                    let apart = member.theta()[t * n + i] * unit - self.theta()[t * n + i];
                    *sum += weight / per_target * apart * apart;
                }
            }
        });
    }

    /// Whether P of each member that is believed has wound up.
    pub fn windup(&self) -> bool {
        self.state.members.windup(self.weights())
    }

    /// The members. Where the bank follows the data, θ and P of a member are in units of the bank.
    pub fn members(&self) -> Cow<'_, [AnyEstimator<T>]> {
        self.state.members.read()
    }

    /// The members, of which only what they are made of is to be read.
    pub(crate) fn made(&self) -> &[AnyEstimator<T>] {
        self.state.members.made()
    }
}

/// A ← A + c·x·xᵀ
fn add_square<T: Real>(matrix: &mut [T], c: T, x: &[T]) {
    for (row, &own) in matrix.chunks_exact_mut(x.len()).zip(x) {
        row.iter_mut().zip(x).for_each(|(sum, &other)| *sum += c * own * other);
    }
}
