use super::*;
use crate::testing::{forget, memory, Dense};

#[test]
fn silence_leads_to_the_bound_that_is_stated() {
    let (a, b, d, lambda) = (0.5, 0.02, 0.01, 0.95f64);
    let rule = Efra::new(a, b, d).unwrap();
    let phi = Dense::new(1, &[0.0, 0.0]);
    let mut state = rule.start(memory(&phi, 1));
    let mut p = Dense::new(2, &[1.0, 0.3, 0.3, 2.0]);
    for _ in 0..1000 {
        p = forget(&rule, &mut state, &p, &phi, lambda).covariance;
    }
    let g = (1.0 - lambda) / lambda;
    let bound = g / (2.0 * d) * (1.0 + (1.0 + 4.0 * b * d / (g * g)).sqrt());
    assert!(p.distance(&Dense::new(2, &[bound, 0.0, 0.0, bound])) < 1e-12);
}

#[test]
fn the_sample_is_measured_with_its_own_noise() {
    let rule = Efra::new(0.5, 0.0, 0.01).unwrap();
    let phi = Dense::new(1, &[2.0, 0.0]);
    let p = Dense::new(2, &[3.0, 0.0, 0.0, 1.0]);
    let found = forget(&rule, &mut rule.start(memory(&phi, 1)), &p, &phi, 0.9);
    // Γ = 1/a + s (1/a − 1) = 2 + 12
    let expected = Dense::new(1, &[2.0 / 14f64.sqrt(), 0.0]);
    assert!(found.regressors.distance(&expected) < 1e-15);
    let plain = forget(&rule, &mut rule.start(memory(&phi, 1)), &p, &phi, 1.0);
    assert_eq!(plain.regressors.elements, phi.elements);
}
