//! The weights of the members, and what they make of the members' numbers.

use crate::memory::state::{State, Visitor, MOST_SAMPLES};
use crate::memory::Dynamic;
use crate::mixers::{AnyMixer, AnyMixerState, Forecasts, Mixer};
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// Samples a parameter before members are weighed.
const WARM_UP: u64 = 3;
/// Samples over which the noise variance and the members' parts are averaged.
const MEMORY: f64 = 1000.0;

/// w, and how the members have been doing.
#[derive(Clone, Debug)]
pub(super) struct Mixture<T> {
    weights: Vec<T>,
    /// mean of h = s/(1 + s) of each member, s the leverage
    parts: Vec<T>,
    /// of the whitened errors of the mixture, each over 1 + s
    noise_variance: T,
    /// the same of each target, where there are several
    target_variances: Vec<T>,
    /// samples used
    samples: u64,
}

impl<T: Kernels> Mixture<T> {
    /// All alike.
    pub fn new(count: usize, targets: usize) -> Self {
        let equal = T::ONE / T::from_f64(count as f64);
        Self {
            weights: alloc::vec![equal; count],
            parts: alloc::vec![T::ZERO; count],
            noise_variance: T::ZERO,
            target_variances: alloc::vec![T::ZERO; if targets > 1 { targets } else { 0 }],
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

    /// n/h̄_i of each member, infinite before it has taken a sample, mixed.
    pub fn memory(&self, parameters: usize) -> T {
        let n = T::from_f64(parameters as f64);
        let parts = self.weights.iter().zip(&self.parts).filter(|(&w, _)| w > T::ZERO);
        parts.fold(T::ZERO, |sum, (&w, &h)| sum + w * (n / h))
    }

    /// Σ w_i x_i over the members that are awake, with what the others would have had shared out.
    #[inline]
    pub fn mean(&self, numbers: &[T], awake: &[bool]) -> T {
        if all(awake) {
            return self.mean_of_all(numbers);
        }
        self.mean_of(&|i| numbers[i], awake)
    }

    /// Σ w_i x_i over all members.
    #[inline]
    pub fn mean_of_all(&self, numbers: &[T]) -> T {
        let ((fours, rest), (fours_of, rest_of)) =
            (self.weights.as_chunks::<4>(), numbers[..self.weights.len()].as_chunks::<4>());
        let mut parts = [T::ZERO; 4];
        for k in 0..fours.len().min(fours_of.len()) {
            for j in 0..4 {
                parts[j] += fours[k][j] * fours_of[k][j];
            }
        }
        for j in 0..rest.len().min(rest_of.len()) {
            parts[j] += rest[j] * rest_of[j];
        }
        total(parts)
    }

    /// The same of the first of every `width` numbers.
    fn mean_of_every(&self, numbers: &[T], width: usize) -> T {
        let mut parts = [T::ZERO; 4];
        for (i, &w) in self.weights.iter().enumerate() {
            parts[i % 4] += w * numbers[i * width];
        }
        total(parts)
    }

    /// The errors of the mixture from those of the members.
    pub fn errors(&self, errors: &[T], awake: &[bool], mixed: &mut [T]) {
        let (count, width) = (self.weights.len(), mixed.len());
        if count == 1 {
            return mixed.copy_from_slice(errors);
        }
        let all = all(awake);
        for (j, mixed) in mixed.iter_mut().enumerate() {
            *mixed = if all {
                self.mean_of_every(&errors[j..], width)
            } else {
                self.mean_of(&|i| errors[i * width + j], awake)
            };
        }
    }

    /// [`Mixture::mean`] of numbers that are computed, where some members are asleep.
    pub fn mean_of(&self, number: &dyn Fn(usize) -> T, awake: &[bool]) -> T {
        let those = || (0..awake.len()).filter(|&i| awake[i]);
        let believed = those().fold(T::ZERO, |sum, i| sum + self.weights[i]);
        let count = T::from_f64(those().count() as f64);
        let share = |i: usize| {
            if believed > T::ZERO {
                self.weights[i] / believed
            } else {
                T::ONE / count
            }
        };
        those().filter(|&i| share(i) > T::ZERO).fold(T::ZERO, |sum, i| sum + share(i) * number(i))
    }

    /// The mixer learns from a sample, if it was used, and weighs the members of n `parameters`.
    #[inline]
    pub fn learn(
        &mut self,
        (mixer, remembered): (&AnyMixer<Dynamic<T>>, &mut AnyMixerState<Dynamic<T>>),
        parameters: usize,
        used: Option<&Forecasts<'_, T>>,
    ) {
        if let Some(forecasts) = used.filter(|_| self.samples > WARM_UP * parameters as u64) {
            mixer.learn(remembered, forecasts);
        }
        self.weigh(|weights| mixer.weigh(remembered, weights));
    }

    /// Takes note of a sample that was used, `leverage` being that of the mixture.
    #[inline]
    pub fn note(&mut self, forecasts: &Forecasts<'_, T>, leverage: T) {
        self.samples += 1;
        let share = T::ONE / T::from_f64(self.samples as f64).min(T::from_f64(MEMORY));
        let count = self.parts.len();
        let (leverages, awake) = (&forecasts.leverages[..count], &forecasts.awake[..count]);
        for i in 0..count {
            // what the sample decides of its own fit: at most 1, also where nothing is known yet
            let part = leverages[i] / (T::ONE + leverages[i]);
            let step = share * (part - self.parts[i]);
            self.parts[i] += if awake[i] { step } else { T::ZERO };
        }
        let mut squared = T::ZERO;
        for &e in forecasts.mixed {
            squared += e * e;
        }
        let variance = (T::ONE + leverage) * T::from_f64(forecasts.mixed.len() as f64);
        self.noise_variance += share * ((squared / variance).min(T::CEILING) - self.noise_variance);
        let targets = self.target_variances.len();
        for (t, own) in self.target_variances.iter_mut().enumerate() {
            let errors = forecasts.mixed.iter().skip(t).step_by(targets);
            let squared = errors.fold(T::ZERO, |sum, &e| sum + e * e) * T::from_f64(targets as f64);
            *own += share * ((squared / variance).min(T::CEILING) - *own);
        }
    }

    /// The variance of the noise of target t.
    pub fn target_variance(&self, t: usize) -> T {
        self.target_variances.get(t).copied().unwrap_or(self.noise_variance)
    }

    /// The errors of several targets, each over the standard deviation of its noise so far: members are
    /// weighed by all of them alike, whatever their units.
    pub fn in_deviations(&self, errors: &mut [T], mixed: &mut [T]) {
        let targets = self.target_variances.len();
        for (t, &variance) in self.target_variances.iter().enumerate() {
            let deviation = variance.sqrt();
            // without an error so far all errors of the target are 0
            let scale = if deviation > T::ZERO { T::ONE / deviation } else { T::ZERO };
            for e in errors.iter_mut().skip(t).step_by(targets) {
                *e *= scale;
            }
            mixed.iter_mut().skip(t).step_by(targets).for_each(|e| *e *= scale);
        }
    }

    /// Takes the weights that `write` writes, in proportion.
    #[inline]
    fn weigh(&mut self, write: impl FnOnce(&mut [T])) {
        write(&mut self.weights);
        let (fours, rest) = self.weights.as_chunks::<4>();
        let mut parts = [T::ZERO; 4];
        for four in fours {
            for j in 0..4 {
                parts[j] += four[j];
            }
        }
        for j in 0..rest.len() {
            parts[j] += rest[j];
        }
        let inverse = T::ONE / total(parts);
        if inverse > T::ZERO && inverse.is_finite() {
            for w in &mut self.weights {
                *w *= inverse;
            }
        } else {
            self.weigh_out_of_range();
        }
    }

    /// In proportion where their sum or its reciprocal is no number.
    #[cold]
    fn weigh_out_of_range(&mut self) {
        let largest = self.weights.iter().fold(T::ZERO, |largest, &w| largest.max(w));
        if largest > T::ZERO && largest.is_finite() {
            self.weights.iter_mut().for_each(|w| *w /= largest);
            let sum = self.weights.iter().fold(T::ZERO, |sum, &w| sum + w);
            self.weights.iter_mut().for_each(|w| *w /= sum);
        } else {
            let equal = T::ONE / T::from_f64(self.weights.len() as f64);
            self.weights.fill(equal);
        }
    }
}

/// Whether all members are awake.
#[inline]
fn all(awake: &[bool]) -> bool {
    awake.iter().fold(true, |all, &awake| all & awake)
}

/// A sum of what was added up in four parts, so that fewer wait for each other.
#[inline(always)]
fn total<T: Kernels>(parts: [T; 4]) -> T {
    (parts[0] + parts[1]) + (parts[2] + parts[3])
}

impl<T: Kernels> State<T> for Mixture<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(&mut self.weights);
        visitor.reals(&mut self.parts);
        visitor.reals(core::slice::from_mut(&mut self.noise_variance));
        visitor.reals(&mut self.target_variances);
        visitor.whole(&mut self.samples);
    }

    fn is_sound(&self) -> bool {
        let sum = self.weights.iter().fold(T::ZERO, |sum, &w| sum + w);
        let variances = self.target_variances.iter().chain([&self.noise_variance]);
        let numbers = self.weights.iter().chain(&self.parts).chain(variances);
        numbers.into_iter().all(|x| *x >= T::ZERO && x.is_finite())
            && (sum - T::ONE).abs() <= T::from_f64(1e-3)
            && self.samples <= MOST_SAMPLES
    }
}
