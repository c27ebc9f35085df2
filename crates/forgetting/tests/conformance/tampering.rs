//! Saved states with a right check and wrong numbers: what no sample can have led to is refused,
//! and what is read goes on soundly.

use crate::record::{record, Datum};
use crate::subjects::{subjects, update, Given, Subject};
use forgetting::memory::state::Visitor;
use forgetting::rates::{AnyRate, RATES};
use forgetting::saved::AnyEstimator;
use forgetting::weightings::AnyWeighting;
use forgetting::{Dynamic, Estimator, Noise, Prior};

type Sizes = (usize, usize, usize);

/// Which of the numbers of a state are counts.
#[derive(Default)]
struct Counts(Vec<bool>);

impl Visitor<f64> for Counts {
    fn reals(&mut self, values: &mut [f64]) {
        self.0.extend(values.iter().map(|_| false));
    }
    fn whole(&mut self, _: &mut u64) {
        self.0.push(true);
    }
}

/// The cyclic redundancy check of IEEE 802.3.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 {
                (crc >> 1) ^ 0xEDB8_8320
            } else {
                crc >> 1
            }
        })
    })
}

fn checked(mut body: Vec<u8>) -> Vec<u8> {
    let check = crc32(&body);
    body.extend_from_slice(&check.to_le_bytes());
    body
}

/// Everything that can be saved: each rule with a constant rate, each rate with one rule.
fn estimators(sizes: Sizes) -> Vec<(String, AnyEstimator<f64>)> {
    let mut all: Vec<_> = subjects()
        .into_iter()
        .filter_map(|s: Subject| Some((format!("{s:?}"), s.estimator::<f64>(sizes, 0.97, 10.0)?)))
        .collect();
    let memory = Dynamic::<f64>::new(sizes.0, sizes.1, sizes.2).unwrap();
    let exponential = subjects().into_iter().find(|s| s.about.name == "exponential").unwrap();
    for about in RATES {
        let none = Given::default();
        let rate = none.with(|values| AnyRate::named(about.name, values, memory));
        let Ok(rate) = rate else { continue };
        let weighting = none.with(|values| AnyWeighting::named("huber", values, memory)).unwrap();
        let prior = Prior::scalar(memory, 10.0).unwrap();
        let rule = exponential.rule(memory).unwrap();
        all.push((about.name.into(), Estimator::new(rule, rate, weighting, prior)));
    }
    all
}

#[test]
fn numbers_that_no_sample_leads_to_are_refused_or_do_no_harm() {
    tamper((3, 1, 1));
    tamper((2, 2, 2));
}

fn tamper(sizes: Sizes) {
    let data = record::<f64>(sizes, 240);
    for (name, mut estimator) in estimators(sizes) {
        estimator.enable_monitor();
        for Datum { phi, y, .. } in &data[..30] {
            update(&mut estimator, phi, y, Noise::Unit).unwrap();
        }
        let mut counts = Counts::default();
        estimator.visit(&mut counts);
        let bytes = estimator.to_bytes().unwrap();
        let body = &bytes[..bytes.len() - 4];
        let start = body.len() - 8 * counts.0.len();
        for (k, &count) in counts.0.iter().enumerate() {
            for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e200, 5e-324] {
                let mut altered = body.to_vec();
                let place = start + 8 * k;
                altered[place..place + 8].copy_from_slice(&value.to_le_bytes());
                let read = AnyEstimator::<f64>::from_bytes(&checked(altered));
                let finite = count || value.is_finite();
                let Ok(mut read) = read else { continue };
                assert!(finite, "{name}: number {k} = {value:e}");
                assert!(read.is_sound(), "{name}: number {k} = {value:e}");
                for Datum { phi, y, .. } in &data[30..40] {
                    let _ = update(&mut read, phi, y, Noise::Unit);
                    assert!(read.is_sound(), "{name}: number {k} = {value:e}");
                    let health = read.health().unwrap();
                    assert!(health.growth >= 0.0, "{name}: number {k} = {value:e}, {health:?}");
                }
            }
        }
        let again = checked(body.to_vec());
        assert!(AnyEstimator::<f64>::from_bytes(&again).unwrap().to_bytes().unwrap() == bytes);
    }
}

/// Version 1 had no gate: its bytes are those of version 2 without the gate's name and its count
/// of parameters. Its monitor had fewer numbers.
#[test]
fn the_version_before_is_read_with_an_open_gate_and_a_new_watch() {
    for watched in [false, true] {
        let mut estimator = estimators((3, 1, 1)).remove(0).1;
        for Datum { phi, y, .. } in &record::<f64>((3, 1, 1), 240)[..30] {
            update(&mut estimator, phi, y, Noise::Unit).unwrap();
        }
        let plain = estimator.to_bytes().unwrap();
        if watched {
            estimator.enable_monitor();
        }
        let bytes = estimator.to_bytes().unwrap();
        let mut old = bytes[..bytes.len() - 4].to_vec();
        let gate = [4, 0, b'o', b'p', b'e', b'n', 0];
        let place = old.windows(gate.len()).position(|window| window == gate).unwrap();
        old.drain(place..place + gate.len());
        if watched {
            // six vectors and ten numbers now, three and nine then
            old.truncate(old.len() - (3 * 3 + 1) * 8);
        }
        old[5] = 1;
        let read = AnyEstimator::<f64>::from_bytes(&checked(old.clone())).unwrap();
        assert_eq!(read.gate().about().name, "open");
        assert_eq!(read.health().is_some(), watched);
        let mut plainly = AnyEstimator::<f64>::from_bytes(&plain).unwrap();
        if watched {
            plainly.enable_monitor();
        }
        assert!(read.to_bytes().unwrap() == plainly.to_bytes().unwrap());
        old.push(0);
        assert!(AnyEstimator::<f64>::from_bytes(&checked(old)).is_err());
    }
}
