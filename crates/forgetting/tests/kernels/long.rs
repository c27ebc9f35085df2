//! A long run is taken in one go. The bound of P's trace grows with every sample, until it can no longer
//! rule out that D comes to its floor; the kernel then computes the trace itself and goes on.

use forgetting::{Constant, Dynamic, Equal, Estimator, Exponential, Kernels, Outcome, Prior};

const SAMPLES: usize = 20_000;
const FACTOR: f64 = 0.9;

/// How often samples of n parameters are not taken in one go.
fn stops<T: Kernels>(n: usize) -> usize {
    let memory = Dynamic::<T>::new(n, 1, 1).unwrap();
    let rate = Constant::new(T::from_f64(FACTOR)).unwrap();
    let prior = Prior::scalar(memory, T::ONE).unwrap();
    let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
    let number = |k: usize| {
        let x = (k as f64 * 12.9898).sin() * 43758.5453;
        T::from_f64(2.0 * (x - x.floor()) - 1.0)
    };
    let phi: Vec<T> = (0..n * SAMPLES).map(number).collect();
    let y: Vec<T> = (0..SAMPLES).map(|k| number(k + 7)).collect();
    let (mut outcomes, mut k, mut stops) = ([Outcome::default(); 64], 0, 0);
    while k < SAMPLES {
        let taken = estimator.update_many(&phi[k * n..], &y[k..], &mut outcomes, &mut []);
        if taken == 0 {
            estimator.update(&phi[k * n..(k + 1) * n], &y[k..=k]).unwrap();
        }
        stops += usize::from(taken == 0);
        k += taken.max(1);
    }
    stops
}

/// It stops where the bound is to be replaced by the trace: once for each time that 1/λ goes into the
/// largest P.
fn stops_where_there_is_no_room<T: Kernels>() {
    let often = SAMPLES as f64 * -FACTOR.ln() / (T::CEILING.to_f64() * 1e-4).ln();
    for n in (1..=10).chain([12]) {
        let stops = stops::<T>(n);
        assert!(stops <= often.ceil() as usize, "n = {n}: {stops} times beside {often}");
    }
}

#[test]
fn a_long_run_stops_only_where_there_is_no_room() {
    stops_where_there_is_no_room::<f64>();
    stops_where_there_is_no_room::<f32>();
}
