//! λ stays within its limits, in any units, in silence and in either number type.

use crate::subjects::{factors, make, sample, take, with, RULES};
use forgetting::choice::{Defaults, Value};
use forgetting::rates::{AnyRate, Rate, RATES};
use forgetting::rules::Rule;
use forgetting::{Dynamic, Error, Estimator, Kernels, Memory, Noise, Prior};

/// The number that the rate has for this parameter.
fn number<M: Memory>(rate: &AnyRate<M>, name: &str) -> Option<f64> {
    let mut found = None;
    rate.describe(&mut |known, value| {
        if let (true, Value::Real(x)) = (known == name, value) {
            found = Some(x);
        }
    });
    found
}

fn stays_within_its_limits<T: Kernels>(rate: &str, sizes: (usize, usize, usize)) {
    let memory = Dynamic::<T>::new(sizes.0, sizes.1, sizes.2).unwrap();
    let narrow = [("smallest", Value::Real(0.95)), ("largest", Value::Real(0.98))];
    for values in [&[][..], &narrow] {
        for rule in RULES {
            let rule_of_name = Rule::named(rule, &Defaults, memory).unwrap();
            let mut estimator = with(rule_of_name, memory, [rate, "equal"], values);
            let limit = |name, default| number(estimator.rate(), name).unwrap_or(default);
            let (smallest, largest) = (limit("smallest", f64::MIN_POSITIVE), limit("largest", 1.0));
            let found = factors(&mut estimator, 0, 400);
            for lambda in found.iter().map(|&bits| f64::from_bits(bits)) {
                assert!(smallest <= lambda && lambda <= largest, "{rate}, {rule}: {lambda}");
            }
            let adapts = number(estimator.rate(), "smallest").is_some();
            assert!(!adapts || found.iter().any(|bits| *bits != found[0]), "{rate} does not move");
        }
    }
}

#[test]
fn every_factor_is_within_its_limits() {
    for about in RATES {
        for sizes in [(1, 1, 1), (3, 1, 1), (3, 2, 1), (2, 1, 3), (3, 3, 2)] {
            stays_within_its_limits::<f64>(about.name, sizes);
            stays_within_its_limits::<f32>(about.name, sizes);
        }
    }
}

/// y and √Γ in units 2⁸ times as small: the same whitened errors, bit for bit, the same λ.
#[test]
fn no_factor_depends_on_the_units_of_the_output() {
    let unit = 256.0;
    for about in RATES {
        for (n, p, m) in [(3, 1, 1), (2, 2, 2)] {
            let memory = Dynamic::<f64>::new(n, p, m).unwrap();
            let names = ["exponential", about.name, "huber"];
            let mut plain = make(memory, names);
            let mut scaled = Estimator::new(
                plain.rule().clone(),
                plain.rate().clone(),
                plain.weighting().clone(),
                Prior::scalar(memory, 100.0 * unit * unit).unwrap(),
            );
            for k in 0..250 {
                let (phi, mut y) = sample(memory, k);
                let expected = take(&mut plain, &phi, &y, Noise::Unit).unwrap();
                y.iter_mut().for_each(|y| *y *= unit);
                let gamma = Noise::Scalar(unit * unit);
                let found = take(&mut scaled, &phi, &y, gamma).unwrap();
                assert_eq!(found.to_bits(), expected.to_bits(), "{}, sample {k}", about.name);
            }
        }
    }
}

/// 10⁵ samples with nothing in them, then noise without a regressor, then one direction.
fn survives_silence<T: Kernels>(rate: &str, rule: &str) {
    let memory = Dynamic::<T>::new(3, 1, 1).unwrap();
    let mut estimator = make(memory, [rule, rate, "student_t"]);
    factors(&mut estimator, 0, 120);
    let (zero, one) = (T::ZERO, T::ONE);
    for k in 0..100_000 {
        let phi = if k < 66_000 { [zero; 3] } else { [one, -one, one + one] };
        let y = if k < 33_000 { zero } else { T::from_f64((k % 7) as f64 - 3.0) };
        match take(&mut estimator, &phi, &[y], Noise::Unit) {
            Ok(lambda) => assert!(lambda > T::ZERO),
            Err(error) => {
                // windup is refused before it overflows
                assert!(matches!(error, Error::Range { .. }), "{rate}, {rule}: {error}");
                break;
            }
        }
    }
    assert!(estimator.is_sound(), "{rate}, {rule}");
}

#[test]
fn every_rate_survives_silence() {
    for (k, about) in RATES.iter().enumerate() {
        // a rule that winds up, and another one
        for rule in ["exponential", ["none", "exponential_resetting", "subspace"][k % 3]] {
            survives_silence::<f64>(about.name, rule);
            survives_silence::<f32>(about.name, rule);
        }
    }
}
