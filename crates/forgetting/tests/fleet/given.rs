//! Fleets, and samples for them.

use forgetting::choice::{Defaults, Value, Values};
use forgetting::fleet::Fleet;
use forgetting::rates::AnyRate;
use forgetting::rules::Rule;
use forgetting::saved::AnyEstimator;
use forgetting::weightings::AnyWeighting;
use forgetting::{Dynamic, Estimator, Kernels, Prior};

/// not a whole number of blocks
pub const COUNT: usize = 37;

pub struct Factor(pub f64);

impl Values for Factor {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        (name == "forgetting_factor").then_some(Value::Real(self.0))
    }
}

pub fn estimator<T: Kernels>(rule: &str, n: usize, factor: f64) -> AnyEstimator<T> {
    let memory = Dynamic::<T>::new(n, 1, 1).unwrap();
    Estimator::new(
        Rule::named(rule, &Defaults, memory).unwrap(),
        AnyRate::named("constant", &Factor(factor), memory).unwrap(),
        AnyWeighting::named("equal", &Defaults, memory).unwrap(),
        Prior::scalar(memory, T::from_f64(10.0)).unwrap(),
    )
}

pub fn fleet<T: Kernels>(rule: &str, n: usize, factor: f64) -> Fleet<T> {
    let mut fleet = Fleet::of(estimator(rule, n, factor)).unwrap();
    fleet.grow(COUNT).unwrap();
    fleet
}

/// Numbers that look random, in (−1, 1).
pub fn noise(k: usize) -> f64 {
    let x = (k as f64 * 12.9898).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

pub struct Given<T> {
    pub phi: Vec<T>,
    pub y: Vec<T>,
    pub mask: Vec<bool>,
}

/// A sample for each stream; some are silent, masked, missing, infinite or too large.
pub fn given<T: Kernels>(step: usize, n: usize) -> Given<T> {
    let at = |i: usize| T::from_f64(noise(step * 7919 + i));
    let mut phi: Vec<T> = (0..COUNT * n).map(at).collect();
    let mut y: Vec<T> = (0..COUNT).map(|i| at(i + 5000)).collect();
    for (stream, y) in y.iter_mut().enumerate() {
        let first = stream * n;
        match (step + 3 * stream) % 29 {
            0 => phi[first..first + n].fill(T::ZERO),
            1 => *y = T::from_f64(f64::NAN),
            2 => phi[first] = T::from_f64(f64::NAN),
            3 => phi[first + n - 1] = T::from_f64(f64::INFINITY),
            4 => *y = T::from_f64(f64::NEG_INFINITY),
            5 => phi[first] = T::CEILING,
            _ => {}
        }
    }
    Given { phi, y, mask: (0..COUNT).map(|stream| !(step + stream).is_multiple_of(11)).collect() }
}
