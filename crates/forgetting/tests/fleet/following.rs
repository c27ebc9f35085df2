//! Streams whose initial covariance follows the data: each is the estimator, bit for bit.

use super::beside::expected;
use super::given::{fleet, given, noise, Factor, Given, COUNT};
use forgetting::choice::Defaults;
use forgetting::fleet::{Fleet, Outputs, Samples};
use forgetting::rates::AnyRate;
use forgetting::rules::Rule;
use forgetting::saved::AnyEstimator;
use forgetting::weightings::AnyWeighting;
use forgetting::{Dynamic, Error, Estimator, Kernels, Prior};

const RULES: [&str; 5] = ["none", "exponential", "subspace", "directional", "random_walk"];

fn with_prior<T: Kernels>(rule: &str, factor: f64, prior: Prior<Dynamic<T>>) -> AnyEstimator<T> {
    let memory = prior.memory();
    Estimator::new(
        Rule::named(rule, &Defaults, memory).unwrap(),
        AnyRate::named("constant", &Factor(factor), memory).unwrap(),
        AnyWeighting::named("equal", &Defaults, memory).unwrap(),
        prior,
    )
}

fn follower<T: Kernels>(rule: &str, n: usize) -> AnyEstimator<T> {
    with_prior(rule, 0.95, Prior::of_data(Dynamic::new(n, 1, 1).unwrap()))
}

/// What [`given`] gives, with columns of all sizes; the last is silent for a while, longer for later
/// streams, and a third of the streams start late.
fn samples<T: Kernels>(step: usize, n: usize) -> Given<T> {
    let mut given = given::<T>(step, n);
    for stream in 0..COUNT {
        for i in 0..n {
            given.phi[stream * n + i] *= T::from_f64(10f64.powi((i + stream) as i32 % 9 - 4));
        }
        if step < 2 * stream && n > 1 {
            given.phi[stream * n + n - 1] = T::ZERO;
        }
        given.mask[stream] &= stream % 3 != 1 || step > 11;
    }
    given
}

/// A fleet beside as many estimators.
struct Both<T: Kernels> {
    fleet: Fleet<T>,
    singles: Vec<AnyEstimator<T>>,
}

impl<T: Kernels> Both<T> {
    fn new(fresh: &AnyEstimator<T>) -> Self {
        let mut fleet = Fleet::of(fresh.clone()).unwrap();
        fleet.grow(COUNT).unwrap();
        Self { fleet, singles: vec![fresh.clone(); COUNT] }
    }

    fn take(&mut self, steps: core::ops::Range<usize>) {
        let n = self.fleet.parameters();
        let (mut error, mut leverage) = (vec![T::ZERO; COUNT], vec![T::ZERO; COUNT]);
        let mut skipped = vec![0; COUNT];
        for step in steps {
            let Given { phi, y, mask } = samples::<T>(step, n);
            let told = Outputs {
                error: Some(&mut error),
                leverage: Some(&mut leverage),
                skipped: Some(&mut skipped),
            };
            let samples = Samples { phi: &phi, y: &y, mask: Some(&mask) };
            let used = self.fleet.update(samples, told).unwrap();
            assert_eq!(used, skipped.iter().filter(|&&code| code == 0).count());
            for (i, single) in self.singles.iter_mut().enumerate() {
                let told = expected(single, &phi[i * n..(i + 1) * n], y[i], mask[i]);
                let same = |a: T, b: f64| {
                    let a = a.to_f64();
                    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
                };
                assert!(same(error[i], told.0), "n = {n}, stream {i}, step {step}");
                assert!(same(leverage[i], told.1), "n = {n}, stream {i}, step {step}");
                assert_eq!(skipped[i], told.2, "n = {n}, stream {i}, step {step}");
            }
        }
    }

    fn check(&self, what: &str) {
        let n = self.fleet.parameters();
        let [mut theta, mut variances] = [vec![T::ZERO; COUNT * n], vec![T::ZERO; COUNT * n]];
        self.fleet.theta(0, &mut theta);
        self.fleet.variances(0, &mut variances);
        for (i, single) in self.singles.iter().enumerate() {
            let bytes = single.to_bytes().unwrap();
            assert_eq!(self.fleet.get(i).to_bytes().unwrap(), bytes, "{what}, stream {i}");
            assert_eq!(&theta[i * n..(i + 1) * n], single.theta(), "{what}, stream {i}");
            let mut own = vec![T::ZERO; n * n];
            single.express(single.factor()).reconstruct(&mut own);
            let own: Vec<_> = (0..n).map(|j| own[j * n + j]).collect();
            assert_eq!(&variances[i * n..(i + 1) * n], own, "{what}, stream {i}");
        }
        let phi: Vec<T> = (0..COUNT * n).map(|i| T::from_f64(noise(i))).collect();
        let mut predicted = vec![T::ZERO; COUNT];
        self.fleet.predict(0, &phi, &mut predicted).unwrap();
        for (i, single) in self.singles.iter().enumerate() {
            let mut own = [T::ZERO];
            single.predict(&phi[i * n..(i + 1) * n], &mut own).unwrap();
            let (own, of_fleet) = (own[0].to_f64(), predicted[i].to_f64());
            let size: f64 = single.theta().iter().map(|x| x.to_f64().abs()).sum();
            assert!((own - of_fleet).abs() <= 1e-5 * size, "{what}, stream {i}: {own} {of_fleet}");
        }
    }
}

fn streams_are_estimators<T: Kernels>(rule: &str, n: usize) {
    let mut both = Both::<T>::new(&follower(rule, n));
    both.take(0..1);
    both.check("after one");
    both.take(1..2 * n);
    both.check("before the units are renewed");
    both.take(2 * n..100);
    both.check("after all");
}

#[test]
fn a_stream_that_follows_the_data_is_the_estimator() {
    for rule in RULES {
        for n in 1..=10 {
            streams_are_estimators::<f64>(rule, n);
            streams_are_estimators::<f32>(rule, n);
        }
    }
}

#[test]
fn streams_come_go_and_start_again() {
    for n in [1, 3, 10] {
        let mut both = Both::<f64>::new(&follower("exponential", n));
        both.take(0..30);
        let mask: Vec<_> = (0..COUNT).map(|i| i % 5 == 2).collect();
        both.fleet.reset((0..COUNT).filter(|&i| mask[i]));
        for (single, &mask) in both.singles.iter_mut().zip(&mask) {
            if mask {
                single.reset();
            }
        }
        // another stream's state, one with another λ, one from bytes
        let old = both.singles[7].clone();
        let quick = with_prior("exponential", 0.5, Prior::of_data(old.prior().memory()));
        let saved = AnyEstimator::from_bytes(&both.singles[9].to_bytes().unwrap()).unwrap();
        for (stream, estimator) in [(3, old), (20, quick), (36, saved)] {
            both.fleet.put(stream, estimator.clone()).unwrap();
            both.singles[stream] = estimator;
        }
        both.check("changed");
        both.take(30..90);
        both.check("after");
        both.fleet.reset(0..COUNT);
        both.singles.iter_mut().for_each(Estimator::reset);
        both.check("reset");
    }
}

#[test]
fn streams_with_and_without_an_initial_covariance_are_neighbours() {
    for n in [2, 10] {
        let memory = Dynamic::<f64>::new(n, 1, 1).unwrap();
        let given = with_prior("exponential", 0.95, Prior::scalar(memory, 10.0).unwrap());
        for (fresh, other) in
            [(follower("exponential", n), &given), (given.clone(), &follower("exponential", n))]
        {
            let mut both = Both::new(&fresh);
            both.take(0..9);
            for stream in [0, 1, 11, COUNT - 1] {
                both.fleet.put(stream, other.clone()).unwrap();
                both.singles[stream] = other.clone();
            }
            both.check("mixed");
            both.take(9..60);
            both.check("after");
            both.fleet.put(1, fresh.clone()).unwrap();
            both.singles[1] = fresh;
            both.take(60..80);
            both.check("put back");
        }
    }
}

#[test]
fn new_streams_join_old_ones() {
    let fresh = follower::<f64>("exponential", 2);
    let (mut fleet, mut late) = (Fleet::of(fresh.clone()).unwrap(), fresh.clone());
    fleet.grow(3).unwrap();
    let none = || Outputs { error: None, leverage: None, skipped: None };
    for step in 0..40 {
        if step == 11 {
            fleet.grow(9).unwrap();
        }
        let Given { phi, y, .. } = given::<f64>(step + 6, 2);
        let count = fleet.count();
        let samples = Samples { phi: &phi[..2 * count], y: &y[..count], mask: None };
        fleet.update(samples, none()).unwrap();
        if step >= 11 {
            expected(&mut late, &phi[8..10], y[4], true);
        }
    }
    assert_eq!(fleet.get(4).to_bytes(), late.to_bytes());
}

#[test]
fn of_more_parameters_a_stream_has_an_initial_covariance() {
    let follower = follower::<f64>("exponential", 11);
    assert!(matches!(Fleet::of(follower.clone()), Err(Error::Unsupported { .. })));
    let mut fleet = fleet::<f64>("exponential", 11, 0.95);
    let before = fleet.get(0).to_bytes();
    assert!(matches!(fleet.put(0, follower), Err(Error::Unsupported { .. })));
    assert_eq!(fleet.get(0).to_bytes(), before);
}
