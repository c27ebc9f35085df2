//! What must not change a bit: a refused sample, a saved state, where the numbers are kept.

use crate::subjects::{factors, make, sample, saved_rates, take, with};
use forgetting::choice::Defaults;
use forgetting::rates::{AnyRate, RATES};
use forgetting::rules::Rule;
use forgetting::saved::AnyEstimator;
use forgetting::weightings::{AnyWeighting, WEIGHTINGS};
use forgetting::{Dynamic, Error, Estimator, Fixed, Kernels, Memory, Noise, Prior, Real, Subspace};

fn saves_in_the_middle<T: Kernels>(rate: &str, weighting: &str) {
    let memory = Dynamic::<T>::new(3, 2, 2).unwrap();
    let mut whole = make(memory, ["subspace", rate, weighting]);
    for stop in [0, 1, 137] {
        let mut restored = AnyEstimator::<T>::from_bytes(&whole.to_bytes().unwrap()).unwrap();
        let next = stop.max(1) * 2;
        let expected = factors(&mut whole.clone(), stop, next);
        assert_eq!(factors(&mut restored, stop, next), expected, "{rate}, {weighting}");
        factors(&mut whole, stop, next);
        assert_eq!(restored.to_bytes().unwrap(), whole.to_bytes().unwrap());
        if stop == 1 {
            factors(&mut whole, next, 137);
        }
    }
}

#[test]
fn saving_in_the_middle_changes_no_bit() {
    for rate in saved_rates() {
        for weighting in WEIGHTINGS {
            saves_in_the_middle::<f64>(rate, weighting.name);
            saves_in_the_middle::<f32>(rate, weighting.name);
        }
    }
}

#[test]
fn a_refused_sample_changes_no_bit() {
    for rate in saved_rates() {
        for weighting in WEIGHTINGS {
            let memory = Dynamic::<f64>::new(3, 2, 1).unwrap();
            let mut estimator = make(memory, ["exponential", rate, weighting.name]);
            factors(&mut estimator, 0, 120);
            let before = estimator.to_bytes().unwrap();
            let (phi, y) = sample(memory, 120);
            let mut bad_phi = phi.clone();
            bad_phi[4] = f64::INFINITY;
            let indefinite = [1.0, 2.0, 2.0, 1.0];
            let mut refuses =
                |phi: &[f64], y: &[f64], noise| take(&mut estimator, phi, y, noise).is_err();
            let refused = [
                refuses(&phi, &[1.0, f64::NAN], Noise::Unit),
                refuses(&bad_phi, &y, Noise::Unit),
                refuses(&phi[1..], &y, Noise::Unit),
                refuses(&phi, &[1e300, 1.0], Noise::Unit),
                refuses(&phi, &y, Noise::Full(&indefinite)),
            ];
            assert_eq!(refused, [true; 5]);
            assert_eq!(estimator.to_bytes().unwrap(), before, "{rate}, {}", weighting.name);
        }
    }
}

/// A rule that must refuse a sample, because P would overflow, does so after the rate has been
/// asked; the rate has not learned from the sample.
#[test]
fn a_sample_that_the_rule_refuses_changes_no_bit() {
    let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
    for rate in saved_rates() {
        let mut estimator = Estimator::new(
            Rule::named("exponential", &Defaults, memory).unwrap(),
            AnyRate::named(rate, &Defaults, memory).unwrap(),
            AnyWeighting::named("equal", &Defaults, memory).unwrap(),
            Prior::scalar(memory, 1e150).unwrap(),
        );
        for k in 0..100_000 {
            let before = estimator.to_bytes().unwrap();
            match take(&mut estimator, &[0.0, 0.0], &[(k % 50) as f64], Noise::Unit) {
                Ok(_) => {}
                Err(error) => {
                    assert!(matches!(error, Error::Range { .. }), "{error}");
                    assert_eq!(estimator.to_bytes().unwrap(), before, "{rate}");
                    break;
                }
            }
        }
    }
}

/// λ of a record with the rule `subspace`.
fn with_subspace<M: Memory>(memory: M, names: [&str; 2]) -> Vec<u64> {
    let rule = Subspace::new(M::Real::from_f64(1e-3)).unwrap();
    factors(&mut with(rule, memory, names, &[]), 0, 400)
}

#[test]
fn fixed_and_dynamic_sizes_give_the_same_bits() {
    for rate in RATES {
        for weighting in WEIGHTINGS {
            let names = [rate.name, weighting.name];
            let fixed = with_subspace(Fixed::<f64, 3, 2, 2, 512>::new(), names);
            let dynamic = with_subspace(Dynamic::<f64>::new(3, 2, 2).unwrap(), names);
            assert_eq!(fixed, dynamic, "{names:?}");
            let fixed = with_subspace(Fixed::<f32, 2, 1, 1, 101>::new(), names);
            let dynamic = with_subspace(Dynamic::<f32>::new(2, 1, 1).unwrap(), names);
            assert_eq!(fixed, dynamic, "{names:?}");
        }
    }
}
