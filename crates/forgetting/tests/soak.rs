//! Soaking: every rule of O(n²) for as many samples as it may see in years. A short form runs with
//! the other tests; `make soak` takes a billion samples of each, and goes on where it was stopped. With
//! them the default bank and the default of an estimator.

#[path = "conformance/record.rs"]
mod record;
#[path = "conformance/subjects.rs"]
mod subjects;

use forgetting::bank::{default_members, default_mixer, Bank, BankOutcome, Kept};
use forgetting::rates::AnyRate;
use forgetting::rules::{RandomWalk, Rule};
use forgetting::weightings::{AnyWeighting, Equal};
use forgetting::{
    AnyEstimator, Constant, Dynamic, Estimator, Kernels, Noise, Outcome, Prior, DIFFUSE,
};
use record::Noise as Random;
use std::path::PathBuf;
use std::time::Instant;
use subjects::{rules, update, Subject};

const N: usize = 4;
/// Samples between two looks, saved states and changes of the input.
const BLOCK: usize = 1 << 16;
const TRUTH: [f64; N] = [1.0, -2.0, 0.5, 3.0];

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Regressors and measurements of a block: exciting, along one direction, silent, large, small, and
/// exciting again before each look at the estimate.
fn block(k: u64) -> (Vec<f64>, Vec<f64>) {
    let mut noise = Random::new(k + 1);
    let fixed: Vec<f64> = (0..N).map(|_| noise.next()).collect();
    let (mut phi, mut y) = (Vec::with_capacity(BLOCK * N), Vec::with_capacity(BLOCK));
    for i in 0..BLOCK {
        // short where a rule may wind up: in f32 it would soon refuse samples
        let until = if matches!(k % 6, 1 | 2) { 500 } else { BLOCK / 2 };
        let kind = if i > until { 0 } else { k % 6 };
        let row: Vec<f64> = match kind {
            1 => fixed.clone(),
            2 => vec![0.0; N],
            3 => (0..N).map(|_| 1e3 * noise.next()).collect(),
            4 => (0..N).map(|_| 1e-3 * noise.next()).collect(),
            _ => (0..N).map(|_| noise.next()).collect(),
        };
        let clean: f64 = row.iter().zip(TRUTH).map(|(x, theta)| x * theta).sum();
        y.push(clean + 0.01 * noise.next());
        phi.extend(row);
    }
    (phi, y)
}

/// What takes samples for years: an estimator or a bank.
trait Soaked<T: Kernels>: Sized {
    /// Takes samples of [`N`] numbers φ and one number y each.
    fn take(&mut self, phi: &[T], y: &[T]);
    fn theta(&self) -> &[T];
    fn is_sound(&self) -> bool;
    fn to_bytes(&self) -> Vec<u8>;
    fn from_bytes(bytes: &[u8]) -> Self;
}

/// Samples that are taken in one call, where that can be.
const TOGETHER: usize = 64;

impl<T: Kernels> Soaked<T> for AnyEstimator<T> {
    fn take(&mut self, phi: &[T], y: &[T]) {
        let (mut outcomes, mut i) = ([Outcome::default(); TOGETHER], 0);
        while i < y.len() {
            let most = TOGETHER.min(y.len() - i);
            let taken = self.update_many(&phi[i * N..], &y[i..], &mut outcomes[..most], &mut []);
            if taken == 0 {
                update(self, &phi[i * N..(i + 1) * N], &y[i..=i], Noise::Unit).unwrap();
            }
            i += taken.max(1);
        }
    }

    fn theta(&self) -> &[T] {
        self.theta()
    }

    fn is_sound(&self) -> bool {
        self.is_sound()
    }

    fn to_bytes(&self) -> Vec<u8> {
        self.to_bytes().unwrap()
    }

    fn from_bytes(bytes: &[u8]) -> Self {
        Self::from_bytes(bytes).unwrap()
    }
}

impl<T: Kernels> Soaked<T> for Bank<T> {
    fn take(&mut self, phi: &[T], y: &[T]) {
        let (mut outcomes, mut i) = ([BankOutcome::default(); TOGETHER], 0);
        while i < y.len() {
            let (most, kept) = (TOGETHER.min(y.len() - i), &mut Kept::default());
            let taken = self.update_many(&phi[i * N..], &y[i..], &mut outcomes[..most], kept);
            if taken == 0 {
                self.update(&phi[i * N..(i + 1) * N], &y[i..=i], Noise::Unit).unwrap();
            }
            i += taken.max(1);
        }
        let sum = self.weights().iter().fold(0.0, |sum, w| sum + w.to_f64());
        assert!((sum - 1.0).abs() < 1e-5, "weights add up to {sum}");
    }

    fn theta(&self) -> &[T] {
        self.theta()
    }

    fn is_sound(&self) -> bool {
        self.is_sound()
    }

    fn to_bytes(&self) -> Vec<u8> {
        self.to_bytes().unwrap()
    }

    fn from_bytes(bytes: &[u8]) -> Self {
        Self::from_bytes(bytes).unwrap()
    }
}

/// Takes samples until there were `steps`, from where it was stopped; returns how many it took.
fn soak<T: Kernels, S: Soaked<T>>(
    name: &str,
    fresh: S,
    forgets: bool,
    steps: u64,
    folder: Option<&PathBuf>,
) -> u64 {
    let name = format!("{name}-{}", 8 * T::BYTES);
    let place = folder.map(|folder| folder.join(name.clone() + ".state"));
    let saved = place.as_ref().and_then(|place| std::fs::read(place).ok());
    let (mut k, mut estimator) = match saved {
        Some(bytes) => {
            let (count, state) = bytes.split_at(8);
            (u64::from_le_bytes(count.try_into().unwrap()), S::from_bytes(state))
        }
        None => (0, fresh),
    };
    let first = k;
    while k * (BLOCK as u64) < steps {
        let (phi, y) = block(k);
        let phi: Vec<T> = phi.into_iter().map(T::from_f64).collect();
        let y: Vec<T> = y.into_iter().map(T::from_f64).collect();
        estimator.take(&phi, &y);
        k += 1;
        assert!(estimator.is_sound(), "{name}, block {k}");
        // the last half of a block excites: whoever forgets has found the truth again
        for (found, truth) in estimator.theta().iter().zip(TRUTH) {
            let off = (found.to_f64() - truth).abs();
            assert!(off < 0.05 || !forgets, "{name}, block {k}: {:?}", estimator.theta());
        }
        if let Some(place) = &place {
            let mut bytes = k.to_le_bytes().to_vec();
            bytes.extend(estimator.to_bytes());
            std::fs::write(place.with_extension("new"), bytes).unwrap();
            std::fs::rename(place.with_extension("new"), place).unwrap();
        }
    }
    (k - first) * BLOCK as u64
}

/// The rule where none is named: a random walk, bounded, with a prior that follows the data.
fn default_estimator<T: Kernels>() -> AnyEstimator<T> {
    let memory = Dynamic::new(N, 1, 1).unwrap();
    let rule = RandomWalk::bounded(T::from_f64(3e-3), T::from_f64(DIFFUSE), memory).unwrap();
    let (rate, weighting) = (Constant::new(T::ONE).unwrap(), AnyWeighting::Equal(Equal::new()));
    let (rule, rate) = (Rule::RandomWalk(rule), AnyRate::Constant(rate));
    Estimator::new(rule, rate, weighting, Prior::of_data(memory))
}

fn default_bank<T: Kernels>() -> Bank<T> {
    let members = default_members(Dynamic::new(N, 1, 1).unwrap()).unwrap();
    Bank::of_data(members, default_mixer().unwrap()).unwrap()
}

#[test]
fn nothing_wears_out() {
    let steps = number("SOAK_STEPS").unwrap_or(2 * BLOCK as u64);
    let only = std::env::var("SOAK_ONLY").unwrap_or_default();
    let folder = std::env::var("SOAK_FOLDER").ok().map(PathBuf::from);
    if let Some(folder) = &folder {
        std::fs::create_dir_all(folder).unwrap();
    }
    let folder = folder.as_ref();
    let wanted = |name: &str| only.is_empty() || only.split(',').any(|each| each == name);
    let say = |name: &str, start: Instant, (double, single): (u64, u64)| {
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "soak {name}: 0 failures in {double} f64 and {single} f32 samples, {seconds:.0} s"
        );
    };
    if wanted("bank") {
        let start = Instant::now();
        let double = soak("bank", default_bank::<f64>(), true, steps, folder);
        say("bank", start, (double, soak("bank", default_bank::<f32>(), true, steps, folder)));
    }
    if wanted("default") {
        let (name, start) = ("default", Instant::now());
        let double = soak(name, default_estimator::<f64>(), true, steps, folder);
        say(name, start, (double, soak(name, default_estimator::<f32>(), true, steps, folder)));
    }
    let square =
        |subject: &Subject| subject.about.cost.contains("n^2") && wanted(subject.about.name);
    for subject in rules().filter(square) {
        let (name, start) = (subject.about.name, Instant::now());
        let forgets = !matches!(name, "none" | "restricted" | "data_dependent");
        let sizes = (N, 1, 1);
        let double = subject.estimator::<f64>(sizes, 0.99, 100.0).unwrap();
        let single = subject.estimator::<f32>(sizes, 0.99, 100.0).unwrap();
        let double = soak(name, double, forgets, steps, folder);
        say(name, start, (double, soak(name, single, forgets, steps, folder)));
    }
}
