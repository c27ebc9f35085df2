//! Any estimator, after any samples: what it saves can be read, is the same again, and holds
//! numbers only.

use crate::subjects::{pairs, subjects, update, Given, Item, Subject};
use crate::target::{fuzz, number};
use forgetting::choice::{About, Defaults, Kind};
use forgetting::gates::{AnyGate, GATES};
use forgetting::memory::state::Visitor;
use forgetting::rates::{AnyRate, RATES};
use forgetting::saved::AnyEstimator;
use forgetting::weightings::{AnyWeighting, WEIGHTINGS};
use forgetting::{Dynamic, Estimator, Kernels, Noise, Prior, Real};
use proptest::prelude::*;
use proptest::sample::Index;

#[derive(Clone, Debug)]
struct Trial {
    /// which rule, rate, weighting and gate
    choices: [Index; 4],
    monitored: bool,
    sizes: (usize, usize, usize),
    /// log10 of P₀, log10 of 1 − λ
    start: (f64, f64),
    /// φ, y and a number for Γ, as many numbers as the largest sizes need
    samples: Vec<(Vec<f64>, Vec<f64>, f64)>,
}

fn trial() -> impl Strategy<Value = Trial> {
    let mild = || prop_oneof![20 => -3.0..3.0, 2 => Just(0.0), 1 => number()];
    let numbers = |any: bool, count: usize| match any {
        true => prop::collection::vec(number(), count).boxed(),
        false => prop::collection::vec(mild(), count).boxed(),
    };
    let samples = move |any| {
        let gamma = prop_oneof![3 => Just(1.0), 1 => number()];
        prop::collection::vec((numbers(any, 39), numbers(any, 9), gamma), 1..60)
    };
    (
        any::<[Index; 4]>(),
        any::<bool>(),
        // among many parameters some rules add to P in another way
        (prop_oneof![4 => 1..=4usize, 1 => 11..=13usize], 1..=3usize, 1..=3usize),
        (-15.0..15.0f64, -6.0..0.0f64),
        prop_oneof![samples(true), samples(false)],
    )
        .prop_map(|(choices, monitored, sizes, start, samples)| Trial {
            choices,
            monitored,
            sizes,
            start,
            samples,
        })
}

/// Whether an estimator with it can be saved: a function is not data.
fn is_data(about: &&About) -> bool {
    about.parameters.iter().all(|parameter| parameter.kind != Kind::Function)
}

fn pick<'a, X>(index: &Index, all: &'a [X]) -> &'a X {
    &all[index.index(all.len())]
}

/// Every rule, and every rule around every other.
pub fn all_subjects() -> Vec<Subject> {
    subjects().into_iter().chain(pairs()).filter(|s| is_data(&s.about)).collect()
}

fn estimator<T: Kernels>(trial: &Trial) -> Option<AnyEstimator<T>> {
    let (n, p, m) = trial.sizes;
    let memory = Dynamic::<T>::new(n, p, m).unwrap();
    let [rule, rate, weighting, gate] = &trial.choices;
    let rule = pick(rule, &all_subjects()).rule(memory).ok()?;
    let rates: Vec<_> = RATES.iter().filter(is_data).collect();
    let factor = (1.0 - 10f64.powf(trial.start.1)).max(1e-3);
    let given = Given::one("forgetting_factor", Item::Real(factor));
    let name = pick(rate, &rates).name;
    let rate = given.with(|values| AnyRate::named(name, values, memory)).ok()?;
    let weightings: Vec<_> = WEIGHTINGS.iter().filter(is_data).collect();
    let weighting = pick(weighting, &weightings).name;
    let weighting = AnyWeighting::named(weighting, &Defaults, memory).ok()?;
    let gates: Vec<_> = GATES.iter().filter(is_data).collect();
    let freeze = Given(vec![
        ("otherwise", Item::Word("freeze")),
        ("width", Item::Real(0.5)),
        ("information", Item::Real(0.05)),
    ]);
    let name = pick(gate, &gates).name;
    let gate = freeze.with(|values| AnyGate::named(name, values, memory)).ok()?;
    let prior = Prior::scalar(memory, T::from_f64(10f64.powf(trial.start.0))).ok()?;
    let mut estimator = Estimator::new(rule, rate, weighting, prior).with_gate(gate);
    if trial.monitored {
        estimator.enable_monitor();
    }
    Some(estimator)
}

/// Whether all numbers seen are finite.
struct Finite(bool);

impl<T: Real> Visitor<T> for Finite {
    fn reals(&mut self, values: &mut [T]) {
        self.0 &= values.iter().all(|x| x.is_finite());
    }
    fn whole(&mut self, _: &mut u64) {}
}

fn check<T: Kernels>(trial: &Trial) {
    let (n, p, m) = trial.sizes;
    let Some(mut estimator) = estimator::<T>(trial) else { return };
    let name = format!(
        "{} {} {} {} with {} bytes",
        estimator.rule().about().name,
        estimator.rate().about().name,
        forgetting::Weighting::<Dynamic<T>>::is_equal(estimator.weighting()),
        forgetting::gates::Gate::<Dynamic<T>>::is_open(estimator.gate()),
        T::BYTES
    );
    let real = |values: &[f64]| -> Vec<T> { values.iter().map(|&x| T::from_f64(x)).collect() };
    for (k, (phi, y, gamma)) in trial.samples.iter().enumerate() {
        let (phi, y) = (real(&phi[..p * n]), real(&y[..p * m]));
        let noise = if k % 2 == 0 { Noise::Unit } else { Noise::Scalar(T::from_f64(*gamma)) };
        let before = estimator.to_bytes().unwrap();
        let outcome = update(&mut estimator, &phi, &y, noise);
        let after = estimator.to_bytes().unwrap();
        match outcome {
            Ok(update) => assert!(update.leverage.is_finite(), "{name}, sample {k}: {update:?}"),
            Err(_) => assert!(before == after, "{name}: a refused sample {k} changed the state"),
        }
        let mut finite = Finite(true);
        estimator.visit(&mut finite);
        assert!(finite.0 && estimator.is_sound(), "{name}, sample {k}: {estimator:?}");
        let again = AnyEstimator::<T>::from_bytes(&after);
        let again = again.unwrap_or_else(|error| panic!("{name}, sample {k}: {error}"));
        assert!(again.to_bytes().unwrap() == after, "{name}: another state, sample {k}");
    }
}

#[test]
fn every_state_can_be_read_again() {
    fuzz(("states", file!()), 1500, trial, |trial: Trial| {
        check::<f64>(&trial);
        check::<f32>(&trial);
    });
}

/// The leverage of this sample is 2.5e9: its square is beyond what other statistics reach.
#[test]
fn a_rate_that_squares_what_it_is_told_saves_what_can_be_read() {
    let memory = Dynamic::<f32>::new(1, 1, 1).unwrap();
    let exponential = subjects().into_iter().find(|s| s.about.name == "exponential").unwrap();
    for about in RATES.iter().filter(is_data) {
        let Ok(rate) = AnyRate::named(about.name, &Defaults, memory) else { continue };
        let weighting = AnyWeighting::named("equal", &Defaults, memory).unwrap();
        let rule = exponential.rule(memory).unwrap();
        let prior = Prior::scalar(memory, 100.0).unwrap();
        let mut estimator = Estimator::new(rule, rate, weighting, prior);
        for phi in [5e3, 1e5, 4e6, 2e9] {
            update(&mut estimator, &[phi], &[1.0], Noise::Unit).unwrap();
            estimator = AnyEstimator::from_bytes(&estimator.to_bytes().unwrap()).unwrap();
        }
    }
}

/// Two rows that are nearly multiples of each other, with errors that no one noise explains: their
/// square, in units of what P says of them, has no end.
#[test]
fn a_change_is_found_again_after_errors_beyond_all_size() {
    let memory = Dynamic::<f32>::new(2, 2, 1).unwrap();
    let resetting = subjects().into_iter().find(|subject| {
        subject.about.name == "covariance_resetting" && format!("{subject:?}").contains("change")
    });
    let mut subject = resetting.unwrap();
    subject.given.0.push(("memory", Item::Real(1.0)));
    assert!(subject.rule(memory).is_ok());
    for k in 0..200 {
        let mut estimator = subject.estimator::<f32>((2, 2, 1), 0.99, 100.0).unwrap();
        let longer = 83.19 + 1e-3 * k as f32;
        let phi = [-1567.0, -2080.0, -1567.0 * longer, -2080.0 * longer];
        for _ in 0..2 {
            let size = 1e17 * (1.0 + 0.2 * k as f32);
            let _ = update(&mut estimator, &phi, &[size, -size], Noise::Unit);
            let mut finite = Finite(true);
            estimator.visit(&mut finite);
            assert!(finite.0, "{k}: {estimator:?}");
        }
        // what is usual is forgotten with the memory; then a change is a change again
        let (phi, mut found) = ([1e-12, 0.0, 0.0, 1e-12], false);
        for k in 0..60 {
            let mut y = [0.0; 2];
            estimator.predict(&phi, &mut y).unwrap();
            let share = if k < 50 { 1e-4 } else { 0.5 };
            y.iter_mut().for_each(|y| *y *= 1.0 + share);
            let told = update(&mut estimator, &phi, &y, Noise::Unit).unwrap();
            found |= k >= 50 && told.rank == 2;
        }
        assert!(found, "{k}: {estimator:?}");
    }
}
