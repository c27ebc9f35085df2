//! Limits at which every rule does the same.

use crate::record::{record, Datum};
use crate::subjects::{rules, subjects, update};
use forgetting::saved::AnyEstimator;
use forgetting::{Kernels, Noise};

fn numbers<T: Kernels>(estimator: &AnyEstimator<T>) -> Vec<u64> {
    let factor = estimator.factor();
    let parts = [estimator.theta(), factor.packed_columns(), factor.diagonal_elements()];
    parts.iter().flat_map(|part| part.iter().map(|x| x.to_f64().to_bits())).collect()
}

fn factor_one_is_none<T: Kernels>(sizes: (usize, usize, usize)) {
    // only what excites: what is too small to inform, some rules skip
    let data: Vec<Datum<T>> = record(sizes, 600).into_iter().take(100).collect();
    let none = rules().find(|subject| subject.about.name == "none").unwrap();
    for subject in rules().filter(|subject| subject.about.forgetting_factor) {
        let mut one = subject.estimator::<T>(sizes, 1.0, 100.0).unwrap();
        let mut other = none.estimator::<T>(sizes, 1.0, 100.0).unwrap();
        for Datum { phi, y, gamma } in &data {
            let rank = update(&mut one, phi, y, Noise::Full(gamma)).unwrap().rank;
            assert_eq!(rank, 0, "{subject:?}");
            update(&mut other, phi, y, Noise::Full(gamma)).unwrap();
            assert_eq!(numbers(&one), numbers(&other), "{subject:?}");
        }
    }
}

#[test]
fn with_factor_one_every_rule_is_none() {
    factor_one_is_none::<f64>((4, 1, 2));
    factor_one_is_none::<f32>((3, 1, 1));
}

/// One that rotates the rows before it measures them is `none` to rounding.
#[test]
fn with_factor_one_and_several_rows_every_rule_is_none() {
    let sizes = (4, 3, 2);
    let data: Vec<Datum<f64>> = record(sizes, 600).into_iter().take(100).collect();
    let none = rules().find(|subject| subject.about.name == "none").unwrap();
    for subject in rules().filter(|subject| subject.about.forgetting_factor) {
        let Some(mut one) = subject.estimator::<f64>(sizes, 1.0, 100.0) else { continue };
        let mut other = none.estimator::<f64>(sizes, 1.0, 100.0).unwrap();
        for Datum { phi, y, gamma } in &data {
            update(&mut one, phi, y, Noise::Full(gamma)).unwrap();
            update(&mut other, phi, y, Noise::Full(gamma)).unwrap();
            if subject.about.name != "subspace" {
                assert_eq!(numbers(&one), numbers(&other), "{subject:?}");
                continue;
            }
            for (x, y) in one.theta().iter().zip(other.theta()) {
                assert!((x - y).abs() < 1e-11, "{subject:?}: {x} {y}");
            }
        }
    }
}

fn silence_is_harmless<T: Kernels>(sizes: (usize, usize, usize)) {
    let (n, p, m) = sizes;
    let data: Vec<Datum<T>> = record(sizes, 300);
    for subject in subjects() {
        let Some(mut estimator) = subject.estimator::<T>(sizes, 0.99, 10.0) else { continue };
        for Datum { phi, y, .. } in &data[..40] {
            update(&mut estimator, phi, y, Noise::Unit).unwrap();
        }
        let before: Vec<T> = estimator.theta().to_vec();
        for k in 0..200 {
            let y: Vec<T> = (0..p * m).map(|i| T::from_f64(((i + k) % 5) as f64 - 2.0)).collect();
            let silence = vec![T::ZERO; p * n];
            let update = update(&mut estimator, &silence, &y, Noise::Unit).unwrap();
            assert_eq!(update.leverage, 0.0, "{subject:?}");
            assert!(estimator.is_sound(), "{subject:?}");
            assert!(estimator.theta() == before, "{subject:?}");
        }
    }
}

#[test]
fn a_silent_regressor_moves_no_parameter() {
    silence_is_harmless::<f64>((3, 1, 1));
    silence_is_harmless::<f64>((4, 3, 2));
    silence_is_harmless::<f32>((3, 2, 1));
}

/// `forget` cannot reach θ; what could move it is a sample that a rule has rotated or scaled
/// without its error.
fn no_error_no_move<T: Kernels>(sizes: (usize, usize, usize)) {
    let (_, p, m) = sizes;
    let data: Vec<Datum<T>> = record(sizes, 300);
    for subject in subjects() {
        let Some(mut estimator) = subject.estimator::<T>(sizes, 0.9, 10.0) else { continue };
        for Datum { phi, y, .. } in &data[..40] {
            update(&mut estimator, phi, y, Noise::Unit).unwrap();
        }
        let before: Vec<T> = estimator.theta().to_vec();
        for Datum { phi, gamma, .. } in &data {
            let mut y = vec![T::ZERO; p * m];
            estimator.predict(phi, &mut y).unwrap();
            update(&mut estimator, phi, &y, Noise::Full(gamma)).unwrap();
            assert!(estimator.theta() == before, "{subject:?}");
        }
    }
}

#[test]
fn a_sample_without_error_moves_no_parameter() {
    no_error_no_move::<f64>((3, 1, 1));
    no_error_no_move::<f64>((4, 3, 2));
    no_error_no_move::<f32>((5, 2, 1));
}

/// φ, y and Γ, of which something is wrong.
type Bad<T> = (Vec<T>, Vec<T>, Option<Vec<T>>);

fn refused_samples_change_nothing<T: Kernels>(sizes: (usize, usize, usize)) {
    let (n, p, m) = sizes;
    let data: Vec<Datum<T>> = record(sizes, 60);
    let (nan, infinite) = (T::from_f64(f64::NAN), T::from_f64(f64::INFINITY));
    let huge = T::CEILING * T::from_f64(16.0);
    let with = |length: usize, value: T| {
        let mut all = vec![T::ONE; length];
        all[length - 1] = value;
        all
    };
    let fine = (vec![T::ONE; p * n], vec![T::ONE; p * m]);
    let mut bad: Vec<Bad<T>> = Vec::new();
    for value in [nan, infinite, -infinite, huge] {
        bad.push((with(p * n, value), fine.1.clone(), None));
        bad.push((fine.0.clone(), with(p * m, value), None));
        bad.push((fine.0.clone(), fine.1.clone(), Some(with(p * p, nan))));
    }
    bad.push((vec![T::ONE; p * n + 1], fine.1.clone(), None));
    bad.push((vec![T::ONE; p * n - 1], fine.1.clone(), None));
    bad.push((fine.0.clone(), vec![T::ONE; p * m + 1], None));
    bad.push((fine.0.clone(), fine.1.clone(), Some(vec![T::ONE; p * p + 1])));
    bad.push((fine.0.clone(), fine.1.clone(), Some(vec![-T::ONE; p * p])));
    for subject in subjects() {
        let Some(mut estimator) = subject.estimator::<T>(sizes, 0.9, 10.0) else { continue };
        for Datum { phi, y, .. } in &data {
            update(&mut estimator, phi, y, Noise::Unit).unwrap();
            let before = estimator.to_bytes().unwrap();
            for (phi, y, gamma) in &bad {
                let noise = gamma.as_ref().map_or(Noise::Unit, |gamma| Noise::Full(gamma));
                let refused = update(&mut estimator, phi, y, noise).is_err();
                assert!(refused, "{subject:?}: {phi:?}, {y:?}, {gamma:?}");
                assert!(estimator.to_bytes().unwrap() == before, "{subject:?}");
            }
        }
    }
}

#[test]
fn a_refused_sample_changes_no_bit() {
    refused_samples_change_nothing::<f64>((3, 1, 1));
    refused_samples_change_nothing::<f64>((2, 2, 2));
    refused_samples_change_nothing::<f32>((3, 1, 2));
}
