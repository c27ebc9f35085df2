//! The weights of the members, and what they make of the members' numbers.

use super::members::Members;
use crate::memory::state::{State, Visitor, MOST_SAMPLES};
use crate::memory::Memory;
use crate::mixers::{Forecasts, Mixer};
use forgetting_kernels::{Kernels, Real};

/// Samples a parameter before members are weighed.
const WARM_UP: u64 = 3;
/// Samples over which the noise variance and the members' parts are averaged.
const MEMORY: f64 = 1000.0;

/// w, and how the members have been doing.
#[derive(Clone, Debug)]
pub(super) struct Mixture<G: Members> {
    weights: G::Numbers,
    /// mean of h = s/(1 + s) of each member, s the leverage
    parts: G::Numbers,
    /// of the whitened errors of the mixture, each over 1 + s
    noise_variance: G::Real,
    /// the same of each target, where there are several
    target_variances: <G::Memory as Memory>::List,
    /// samples used
    samples: u64,
}

impl<T: Kernels, G: Members<Real = T>> Mixture<G> {
    /// Before the first sample; `weigh` writes how far each member is believed beforehand.
    pub fn new(members: &G, weigh: impl FnOnce(&mut [T])) -> Self {
        let memory = members.memory();
        let targets = memory.targets();
        let mut mixture = Self {
            weights: members.numbers(1),
            parts: members.numbers(1),
            noise_variance: T::ZERO,
            target_variances: memory.list(if targets > 1 { targets } else { 0 }),
            samples: 0,
        };
        mixture.weigh(weigh);
        mixture
    }

    #[inline]
    pub fn weights(&self) -> &[T] {
        self.weights.as_ref()
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
        let parts = self.weights().iter().zip(self.parts.as_ref()).filter(|(&w, _)| w > T::ZERO);
        parts.fold(T::ZERO, |sum, (&w, &h)| sum + w * (n / h))
    }

    /// Σ w_i x_i over the members that are awake, with what the others would have had shared out.
    #[inline]
    pub fn mean(&self, numbers: &[T], awake: &[bool]) -> T {
        if all(awake) {
            return self.mean_of_all(numbers);
        }
        self.mean_of(numbers.iter(), awake)
    }

    /// Σ w_i x_i over all members.
    #[inline]
    pub fn mean_of_all(&self, numbers: &[T]) -> T {
        let weights = self.weights();
        let ((fours, rest), (fours_of, rest_of)) =
            (weights.as_chunks::<4>(), numbers[..weights.len()].as_chunks::<4>());
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
        for (i, (&w, &x)) in self.weights().iter().zip(numbers.iter().step_by(width)).enumerate() {
            parts[i % 4] += w * x;
        }
        total(parts)
    }

    /// The errors of the mixture from those of the members.
    pub fn errors(&self, errors: &[T], awake: &[bool], mixed: &mut [T]) {
        let (count, width) = (self.weights().len(), mixed.len());
        if count == 1 {
            return mixed.copy_from_slice(errors);
        }
        let all = all(awake);
        for (j, mixed) in mixed.iter_mut().enumerate() {
            *mixed = if all {
                self.mean_of_every(errors.get(j..).unwrap_or_default(), width)
            } else {
                self.mean_of(errors.iter().skip(j).step_by(width), awake)
            };
        }
    }

    /// [`Mixture::mean`] of a number of each member, where some are asleep.
    pub fn mean_of<'a>(&self, numbers: impl Iterator<Item = &'a T>, awake: &[bool]) -> T {
        let those = || self.weights().iter().zip(awake).filter(|(_, &awake)| awake);
        let believed = those().fold(T::ZERO, |sum, (&w, _)| sum + w);
        let count = T::from_f64(those().count() as f64);
        let share = |w: T| if believed > T::ZERO { w / believed } else { T::ONE / count };
        let all = self.weights().iter().zip(awake).zip(numbers);
        all.filter(|((&w, &awake), _)| awake && share(w) > T::ZERO)
            .fold(T::ZERO, |sum, ((&w, _), &x)| sum + share(w) * x)
    }

    /// The mixer learns from a sample, if it was used, and weighs the members of n `parameters`.
    #[inline]
    pub fn learn<X: Mixer<G::Weighed>>(
        &mut self,
        (mixer, remembered): (&X, &mut X::State),
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
        let parts = self.parts.as_mut();
        let count = parts.len();
        let (leverages, awake) = (&forecasts.leverages[..count], &forecasts.awake[..count]);
        for i in 0..count {
            // what the sample decides of its own fit: at most 1, also where nothing is known yet
            let part = leverages[i] / (T::ONE + leverages[i]);
            let step = share * (part - parts[i]);
            parts[i] += if awake[i] { step } else { T::ZERO };
        }
        let mut squared = T::ZERO;
        for &e in forecasts.mixed {
            squared += e * e;
        }
        let variance = (T::ONE + leverage) * T::from_f64(forecasts.mixed.len() as f64);
        self.noise_variance += share * ((squared / variance).min(T::CEILING) - self.noise_variance);
        let variances = self.target_variances.as_mut();
        let targets = variances.len();
        for (t, own) in variances.iter_mut().enumerate() {
            let errors = forecasts.mixed.iter().skip(t).step_by(targets);
            let squared = errors.fold(T::ZERO, |sum, &e| sum + e * e) * T::from_f64(targets as f64);
            *own += share * ((squared / variance).min(T::CEILING) - *own);
        }
    }

    /// The variance of the noise of target t.
    pub fn target_variance(&self, t: usize) -> T {
        self.target_variances.as_ref().get(t).copied().unwrap_or(self.noise_variance)
    }

    /// The noise variance so far of each target, where there are several.
    pub fn target_variances(&self) -> &[T] {
        self.target_variances.as_ref()
    }

    /// Takes the weights that `write` writes, in proportion.
    #[inline]
    fn weigh(&mut self, write: impl FnOnce(&mut [T])) {
        let weights = self.weights.as_mut();
        write(weights);
        let (fours, rest) = weights.as_chunks::<4>();
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
            for w in weights {
                *w *= inverse;
            }
        } else {
            weigh_out_of_range(weights);
        }
    }
}

/// In proportion where their sum or its reciprocal is no number.
#[cold]
fn weigh_out_of_range<T: Real>(weights: &mut [T]) {
    let largest = weights.iter().fold(T::ZERO, |largest, &w| largest.max(w));
    if largest > T::ZERO && largest.is_finite() {
        weights.iter_mut().for_each(|w| *w /= largest);
        let sum = weights.iter().fold(T::ZERO, |sum, &w| sum + w);
        weights.iter_mut().for_each(|w| *w /= sum);
    } else {
        let equal = T::ONE / T::from_f64(weights.len() as f64);
        weights.fill(equal);
    }
}

/// Errors, each over the standard deviation of its target's noise: members are weighed by all targets
/// alike, whatever their units. Without `variances` they stay as they are.
pub(super) fn in_deviations<T: Real>(
    variances: impl ExactSizeIterator<Item = T>,
    errors: &mut [T],
    mixed: &mut [T],
) {
    let targets = variances.len();
    for (t, variance) in variances.enumerate() {
        let deviation = variance.sqrt();
        // without an error so far all errors of the target are 0
        let scale = if deviation > T::ZERO { T::ONE / deviation } else { T::ZERO };
        for errors in [&mut *errors, &mut *mixed] {
            errors.iter_mut().skip(t).step_by(targets).for_each(|e| *e *= scale);
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
fn total<T: Real>(parts: [T; 4]) -> T {
    (parts[0] + parts[1]) + (parts[2] + parts[3])
}

impl<T: Real, G: Members<Real = T>> State<T> for Mixture<G> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(self.weights.as_mut());
        visitor.reals(self.parts.as_mut());
        visitor.reals(core::slice::from_mut(&mut self.noise_variance));
        visitor.reals(self.target_variances.as_mut());
        visitor.whole(&mut self.samples);
    }

    fn is_sound(&self) -> bool {
        let (weights, parts) = (self.weights.as_ref(), self.parts.as_ref());
        let sum = weights.iter().fold(T::ZERO, |sum, &w| sum + w);
        let variances = self.target_variances.as_ref().iter().chain([&self.noise_variance]);
        let numbers = weights.iter().chain(parts).chain(variances);
        numbers.into_iter().all(|x| *x >= T::ZERO && x.is_finite())
            && (sum - T::ONE).abs() <= T::from_f64(1e-3)
            && self.samples <= MOST_SAMPLES
    }
}
