//! P̄ and the whitened innovation against dense matrices: L Lᵀ = Γ + φP̄φᵀ, v = L⁻¹e.

use crate::record::{record, Datum};
use crate::subjects::{subjects, Subject};
use forgetting::gates::Answer;
use forgetting::gates::{AnyGate, DeadZone, MinimumInformation};
use forgetting::weightings::{AnyWeighting, Huber};
use forgetting::Outcome;
use forgetting::{Dynamic, Error, Estimator, Noise, Prior};

/// Largest error of v relative to 1 + |v| over all rules: measured 7e-15.
const TOLERANCE: f64 = 1e-13;

/// L⁻¹e of the p x p matrix S and p x m numbers e, by Cholesky's factorization of S.
fn whiten(s: &[f64], e: &[f64], p: usize) -> Vec<f64> {
    let m = e.len() / p;
    let mut l = vec![0.0; p * p];
    for i in 0..p {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| l[i * p + k] * l[j * p + k]).sum();
            let left = s[i * p + j] - sum;
            l[i * p + j] = if i == j { left.sqrt() } else { left / l[j * p + j] };
        }
    }
    let mut v = e.to_vec();
    for i in 0..p {
        for t in 0..m {
            let sum: f64 = (0..i).map(|k| l[i * p + k] * v[k * m + t]).sum();
            v[i * m + t] = (v[i * m + t] - sum) / l[i * p + i];
        }
    }
    v
}

/// Γ/w + φP̄φᵀ
fn spread(phi: &[f64], prior: &[f64], gamma: &[f64], (n, p): (usize, usize)) -> Vec<f64> {
    let product = |i: usize, j: usize| -> f64 {
        let pairs = (0..n).flat_map(|a| (0..n).map(move |b| (a, b)));
        pairs.map(|(a, b)| phi[i * n + a] * prior[a * n + b] * phi[j * n + b]).sum()
    };
    (0..p * p).map(|k| gamma[k] + product(k / p, k % p)).collect()
}

fn check(subject: &Subject, sizes: (usize, usize, usize), gate: &AnyGate<Dynamic<f64>>) {
    let (n, p, m) = sizes;
    let Some(estimator) = subject.estimator::<f64>(sizes, 0.97, 10.0) else { return };
    let mut estimator = estimator.with_gate(gate.clone());
    estimator.keep_prior(true);
    estimator.keep_innovations(true);
    let mut unasked = estimator.clone();
    unasked.keep_prior(false);
    let (mut prior, mut v) = (vec![0.0; n * n], vec![0.0; p * m]);
    for (k, Datum { phi, y, gamma }) in record(sizes, 240).iter().enumerate() {
        let unit: Vec<f64> = (0..p * p).map(|k| f64::from(k % (p + 1) == 0)).collect();
        let (noise, gamma) = match k % 2 {
            0 => (Noise::Unit, &unit),
            _ => (Noise::Full(gamma), gamma),
        };
        let update = estimator.update_with_noise(phi, y, noise).unwrap();
        update.whiten(&mut v).unwrap();
        let (error, leverage) = (update.error.to_vec(), update.leverage);
        estimator.prior_factor().unwrap().reconstruct(&mut prior);
        let s = spread(phi, &prior, gamma, (n, p));
        for (found, expected) in v.iter().zip(whiten(&s, &error, p)) {
            let off = (found - expected).abs() / (1.0 + expected.abs());
            assert!(off < TOLERANCE, "{subject:?}, sample {k}: {found} {expected} {leverage}");
        }
        let told = unasked.update_with_noise(phi, y, noise).unwrap();
        assert_eq!(told.leverage.to_bits(), leverage.to_bits(), "{subject:?}: asking changes it");
    }
    assert_eq!(estimator.theta(), unasked.theta(), "{subject:?}");
}

#[test]
fn the_whitened_innovation_is_that_of_the_dense_covariance() {
    let information = MinimumInformation::new(0.05, Answer::Hold).unwrap();
    let zone = DeadZone::new(0.1, Answer::Freeze).unwrap();
    let gates = [
        AnyGate::Open(forgetting::gates::Open::new()),
        AnyGate::MinimumInformation(information),
        AnyGate::DeadZone(zone),
    ];
    for subject in subjects() {
        for gate in &gates {
            for sizes in [(3, 1, 1), (3, 1, 2), (4, 3, 2)] {
                check(&subject, sizes, gate);
            }
        }
    }
}

/// e = 12, Γ = 9: ē = 4, w = 1/2; Γ/w = 18, φPφ = 9.
#[test]
fn the_weight_divides_the_noise_covariance() {
    let memory = Dynamic::<f64>::new(1, 1, 1).unwrap();
    let rule = subjects().into_iter().find(|subject| subject.about.name == "none").unwrap();
    let mut estimator = Estimator::new(
        rule.rule(memory).unwrap(),
        forgetting::Constant::new(1.0).unwrap(),
        AnyWeighting::Huber(Huber::new(2.0).unwrap()),
        Prior::scalar(memory, 1.0).unwrap(),
    );
    let update = estimator.update_with_noise(&[3.0], &[12.0], Noise::Scalar(9.0)).unwrap();
    let mut v = [0.0];
    update.whiten(&mut v).unwrap();
    assert!((v[0] - 12.0 / 27f64.sqrt()).abs() < 1e-15);
    assert!(matches!(update.whiten(&mut [0.0; 2]), Err(Error::Length { .. })));
}

#[test]
fn several_rows_must_be_asked_for() {
    let subject = subjects().into_iter().find(|subject| subject.about.name == "none").unwrap();
    let mut estimator = subject.estimator::<f64>((2, 2, 1), 1.0, 1.0).unwrap();
    let update = estimator.update(&[1.0, 0.0, 0.0, 1.0], &[1.0, 2.0]).unwrap();
    assert!(matches!(update.whiten(&mut [0.0; 2]), Err(Error::Unsupported { .. })));
}

/// With P̄ kept, every step is taken one by one; without, some are one pass, for many samples in one
/// go. The monitor must see the same.
#[test]
fn the_watch_sees_the_same_whichever_way_the_sample_takes() {
    let sizes = (3, 1, 1);
    let data = record::<f64>(sizes, 240);
    let phi: Vec<f64> = data.iter().flat_map(|datum| datum.phi.clone()).collect();
    let y: Vec<f64> = data.iter().flat_map(|datum| datum.y.clone()).collect();
    let mut many = 0;
    for subject in subjects() {
        let mut quick = subject.estimator::<f64>(sizes, 0.8, 10.0).unwrap();
        quick.enable_monitor();
        let (mut slow, mut at_once) = (quick.clone(), quick.clone());
        slow.keep_prior(true);
        let (mut told, mut k) = (vec![Outcome::default(); data.len()], 0);
        while k < data.len() {
            let taken = at_once.update_many(&phi[3 * k..], &y[k..], &mut told[k..], &mut []);
            many += usize::from(taken > 1);
            if taken == 0 {
                at_once.update(&phi[3 * k..3 * k + 3], &y[k..=k]).unwrap();
            }
            k += taken.max(1);
        }
        for (k, Datum { phi, y, .. }) in data.iter().enumerate() {
            let update = quick.update(phi, y).unwrap();
            let told_one = (update.leverage.to_bits(), update.windup, update.skipped);
            let other = slow.update(phi, y).unwrap();
            assert_eq!(told_one, (other.leverage.to_bits(), other.windup, other.skipped));
            if told[k].used {
                let other = at_once.report(&told[k]);
                assert_eq!(told_one, (other.leverage.to_bits(), other.windup, other.skipped));
            }
        }
        let bytes = slow.to_bytes().unwrap();
        assert!(quick.to_bytes().unwrap() == bytes, "{subject:?}");
        assert!(at_once.to_bytes().unwrap() == bytes, "{subject:?}");
    }
    assert!(many > 50, "{many} goes of more than one sample");
}
