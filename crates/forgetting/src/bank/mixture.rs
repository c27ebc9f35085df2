//! The weights of the members, and what they make of the members' numbers.

use crate::estimator::AnyEstimator;
use crate::memory::state::{State, Visitor, MOST_SAMPLES};
use crate::mixers::Forecasts;
use crate::sample::{cholesky, Noise};
use alloc::vec::Vec;
use forgetting_kernels::kernel::functions::add_scaled;
use forgetting_kernels::Kernels;

/// Samples over which the noise variance and the members' leverages are averaged.
const MEMORY: f64 = 1000.0;

/// w, and how the members have been doing.
#[derive(Clone, Debug)]
pub(super) struct Mixture<T> {
    weights: Vec<T>,
    /// mean leverage of each member
    leverages: Vec<T>,
    /// of the whitened errors of the mixture, each over 1 + s
    noise_variance: T,
    /// samples used
    samples: u64,
}

impl<T: Kernels> Mixture<T> {
    /// All alike.
    pub fn new(count: usize) -> Self {
        let equal = T::ONE / T::from_f64(count as f64);
        Self {
            weights: alloc::vec![equal; count],
            leverages: alloc::vec![T::ZERO; count],
            noise_variance: T::ZERO,
            samples: 0,
        }
    }

    pub fn weights(&self) -> &[T] {
        &self.weights
    }

    pub fn samples(&self) -> u64 {
        self.samples
    }

    pub fn noise_variance(&self) -> T {
        self.noise_variance
    }

    /// n/s̄_i of each member, infinite before it has taken a sample, mixed.
    pub fn memory(&self, parameters: usize) -> T {
        let n = T::from_f64(parameters as f64);
        let parts = self.weights.iter().zip(&self.leverages).filter(|(&w, _)| w > T::ZERO);
        parts.fold(T::ZERO, |sum, (&w, &s)| sum + w * (n / s))
    }

    /// Σ w_i x_i over the members that are awake, with what the others would have had shared out.
    pub fn mean(&self, numbers: &[T], awake: &[bool]) -> T {
        self.mean_of(&|i| numbers[i], awake)
    }

    /// The errors of the mixture from those of the members.
    pub fn errors(&self, errors: &[T], awake: &[bool], mixed: &mut [T]) {
        let (count, width) = (self.weights.len(), mixed.len());
        if count == 1 {
            return mixed.copy_from_slice(errors);
        }
        for (j, mixed) in mixed.iter_mut().enumerate() {
            *mixed = self.mean_of(&|i| errors[i * width + j], awake);
        }
    }

    /// [`Mixture::mean`] of numbers that are computed.
    fn mean_of(&self, number: &dyn Fn(usize) -> T, awake: &[bool]) -> T {
        let believed =
            (0..awake.len()).filter(|&i| awake[i]).fold(T::ZERO, |sum, i| sum + self.weights[i]);
        let count = T::from_f64(awake.iter().filter(|awake| **awake).count() as f64);
        (0..awake.len()).filter(|&i| awake[i]).fold(T::ZERO, |sum, i| {
            let share =
                if believed > T::ZERO { self.weights[i] / believed } else { T::ONE / count };
            if share > T::ZERO {
                sum + share * number(i)
            } else {
                sum
            }
        })
    }

    /// θ of the mixture, m x n numbers, in the units of the members.
    pub fn theta(&self, members: &[AnyEstimator<T>], theta: &mut [T]) {
        if let [only] = members {
            return theta.copy_from_slice(only.theta());
        }
        theta.fill(T::ZERO);
        for (member, &weight) in members.iter().zip(&self.weights) {
            if weight > T::ZERO {
                add_scaled(theta, weight, member.theta());
            }
        }
    }

    /// Takes note of a sample that was used.
    pub fn note(&mut self, forecasts: &Forecasts<'_, T>) {
        self.samples += 1;
        let share = T::ONE / T::from_f64(self.samples as f64).min(T::from_f64(MEMORY));
        let leverage = self.mean(forecasts.leverages, forecasts.awake);
        for i in forecasts.awake() {
            let now = forecasts.leverages[i].min(T::CEILING);
            let mean = &mut self.leverages[i];
            *mean += share * (now - *mean);
        }
        let scale = (T::ONE + leverage).sqrt();
        let width = T::from_f64(forecasts.mixed.len() as f64);
        let squared =
            forecasts.mixed.iter().fold(T::ZERO, |sum, &e| sum + (e / scale) * (e / scale) / width);
        self.noise_variance += share * (squared.min(T::CEILING) - self.noise_variance);
    }

    /// Takes the weights that `write` writes, in proportion.
    pub fn weigh(&mut self, write: impl FnOnce(&mut [T])) {
        write(&mut self.weights);
        let largest = self.weights.iter().fold(T::ZERO, |largest, &w| largest.max(w));
        if largest > T::ZERO && largest.is_finite() {
            // first so that the sum does not overflow
            self.weights.iter_mut().for_each(|w| *w /= largest);
            let sum = self.weights.iter().fold(T::ZERO, |sum, &w| sum + w);
            self.weights.iter_mut().for_each(|w| *w /= sum);
        } else {
            let equal = T::ONE / T::from_f64(self.weights.len() as f64);
            self.weights.fill(equal);
        }
    }
}

impl<T: Kernels> State<T> for Mixture<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(&mut self.weights);
        visitor.reals(&mut self.leverages);
        visitor.reals(core::slice::from_mut(&mut self.noise_variance));
        visitor.whole(&mut self.samples);
    }

    fn is_sound(&self) -> bool {
        let sum = self.weights.iter().fold(T::ZERO, |sum, &w| sum + w);
        let numbers = self.weights.iter().chain(&self.leverages).chain([&self.noise_variance]);
        numbers.into_iter().all(|x| *x >= T::ZERO && x.is_finite())
            && (sum - T::ONE).abs() <= T::from_f64(1e-3)
            && self.samples <= MOST_SAMPLES
    }
}

/// e ← Γ^(−1/2) e for p x m numbers e; `root` is a buffer of p x p numbers.
pub(super) fn whiten<T: Kernels>(
    errors: &mut [T],
    targets: usize,
    noise: Noise<'_, T>,
    root: &mut [T],
) {
    match noise {
        Noise::Unit => {}
        Noise::Scalar(gamma) => {
            let scale = T::ONE / gamma.sqrt();
            errors.iter_mut().for_each(|e| *e *= scale);
        }
        Noise::Full(gamma) => {
            let p = errors.len() / targets;
            root.copy_from_slice(gamma);
            // the members have already taken a sample with this Γ
            if cholesky(root, p, "gamma").is_err() {
                return;
            }
            for i in 0..p {
                let (above, row) = errors.split_at_mut(i * targets);
                let row = &mut row[..targets];
                for (k, solved) in above.chunks_exact(targets).enumerate() {
                    add_scaled(row, -root[i * p + k], solved);
                }
                row.iter_mut().for_each(|e| *e /= root[i * p + i]);
            }
        }
    }
}
