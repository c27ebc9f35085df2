//! The walk beside dense covariances.

use super::*;
use crate::choice::Defaults;
use crate::testing::{covariance, forget, memory, Dense};

#[test]
fn adds_the_covariance_of_a_step() {
    let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
    let rule = RandomWalk::configure(&Defaults, memory(&phi, 1)).unwrap();
    let outcome = forget(&rule, &mut None, &p, &phi, 0.5);
    let expected = p + 1e-4 * Dense::identity(3);
    assert!(outcome.covariance.distance(&expected) < 1e-15);
}

#[test]
fn a_bound_draws_the_covariance_towards_it() {
    let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
    let rule = RandomWalk::bounded(0.5, 4.0, memory(&phi, 1)).unwrap();
    let outcome = forget(&rule, &mut None, &p, &phi, 0.5);
    let expected = 0.875 * p + 0.5 * Dense::identity(3);
    assert!(outcome.covariance.distance(&expected) < 1e-14);
}

/// A cycle without data is as many samples of the other schedule: of all of P without a bound, of
/// the variances with one.
#[test]
fn a_cycle_in_silence_is_as_many_samples() {
    let (start, silence) = (covariance(), Dense::new(1, &[0.0; 3]));
    let m = memory(&silence, 1);
    let noise = Root::scalar(&PROCESS_NOISE, 0.3, m).unwrap();
    for all in [RandomWalk::new(noise), RandomWalk::bounded(0.3, 9.0, m).unwrap()] {
        let turns = all.clone().cyclic().unwrap();
        let (mut p, mut expected, mut cycle) = (start.clone(), start.clone(), turns.start(m));
        for _ in 0..3 {
            p = forget(&turns, &mut cycle, &p, &silence, 0.5).covariance;
            expected = forget(&all, &mut None, &expected, &silence, 0.5).covariance;
        }
        for k in (0..9).filter(|k| all.bound.is_none() || k % 4 == 0) {
            assert!((p.elements[k] - expected.elements[k]).abs() < 1e-14, "{k}");
        }
    }
}

#[test]
fn cycles_of_a_full_matrix_have_no_bound() {
    let m = memory(&Dense::new(1, &[0.0; 2]), 1);
    let full = Dense::new(2, &[2.0, 1.0, 1.0, 2.0]);
    let elements = |k: usize| full.elements[k];
    struct Full<'a>(&'a dyn Fn(usize) -> f64);
    impl Values for Full<'_> {
        fn get(&self, name: &str) -> Option<Value<'_>> {
            match name {
                "process_noise" => {
                    Some(Value::Matrix { rows: 2, columns: 2, elements: self.0 })
                }
                "bound" => Some(Value::Real(9.0)),
                "schedule" => Some(Value::Word("cyclic")),
                _ => None,
            }
        }
    }
    let refused = RandomWalk::configure(&Full(&elements), m).unwrap_err();
    assert!(matches!(refused, Error::Value { parameter: "bound", .. }));
}

#[test]
fn a_bound_is_above_the_noise() {
    let memory = memory(&Dense::new(1, &[1.0]), 1);
    let refused = RandomWalk::bounded(0.5, 0.5, memory).unwrap_err();
    assert!(matches!(refused, Error::Value { parameter: "bound", .. }));
}
