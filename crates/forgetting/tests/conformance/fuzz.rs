//! Whole estimators on arbitrary input: never a panic, never an unsound P, never a half-done sample.

use crate::subjects::{subjects, update, Subject};
use forgetting::{Error, Kernels, Noise};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Numbers of every size, and now and then none.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -10.0..10.0,
        2 => (-320.0..308.0, any::<bool>()).prop_map(|(e, sign): (f64, bool)| {
            let size = 10f64.powf(e);
            if sign { size } else { -size }
        }),
        1 => Just(0.0),
        1 => -1e-3..1e-3,
        1 => prop_oneof![
            Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY), Just(5e-324), Just(f64::MAX)
        ],
    ]
}

/// Numbers that are mostly ordinary, so that most samples are accepted.
fn mild() -> impl Strategy<Value = f64> {
    prop_oneof![40 => -3.0..3.0, 4 => Just(0.0), 1 => number()]
}

#[derive(Clone, Debug)]
struct Trial {
    subject: usize,
    sizes: (usize, usize, usize),
    variance: f64,
    forgetting_factor: f64,
    /// φ, y and a number for Γ, as many numbers as the largest sizes need
    samples: Vec<(Vec<f64>, Vec<f64>, f64)>,
}

fn trial() -> impl Strategy<Value = Trial> {
    let factor = prop_oneof![
        4 => 0.5..1.0f64,
        1 => Just(1.0),
        1 => 1e-12..0.5f64,
        1 => (-300.0..-10.0f64).prop_map(|e| 10f64.powf(e)),
    ];
    let samples = |any: bool| {
        let numbers = move |count| {
            if any {
                prop::collection::vec(number(), count).boxed()
            } else {
                prop::collection::vec(mild(), count).boxed()
            }
        };
        prop::collection::vec((numbers(12), numbers(9), prop_oneof![Just(1.0), number()]), 1..60)
    };
    let variance = (-30.0..30.0f64).prop_map(|e| 10f64.powf(e / 2.0));
    let samples = prop_oneof![samples(true), samples(false)];
    (any::<prop::sample::Index>(), 1..=4usize, 1..=3usize, 1..=3usize, variance, factor, samples)
        .prop_map(|(index, n, p, m, variance, forgetting_factor, samples)| Trial {
            subject: index.index(subjects().len()),
            sizes: (n, p, m),
            variance,
            forgetting_factor,
            samples,
        })
}

fn check<T: Kernels>(subject: &Subject, trial: &Trial) {
    let (n, p, m) = trial.sizes;
    let factor =
        if T::BYTES == 4 { trial.forgetting_factor.max(1e-30) } else { trial.forgetting_factor };
    let Some(mut estimator) = subject.estimator::<T>(trial.sizes, factor, trial.variance) else {
        return;
    };
    let real = |values: &[f64]| -> Vec<T> { values.iter().map(|&x| T::from_f64(x)).collect() };
    for (k, (phi, y, gamma)) in trial.samples.iter().enumerate() {
        let (phi, y) = (real(&phi[..p * n]), real(&y[..p * m]));
        let mut full = vec![T::ZERO; p * p];
        (0..p).for_each(|i| full[i * p + i] = T::from_f64(*gamma));
        full[p * p - 1] += T::ONE;
        let noise = match k % 3 {
            0 => Noise::Unit,
            1 => Noise::Scalar(T::from_f64(*gamma)),
            _ => Noise::Full(&full),
        };
        let before = estimator.to_bytes().unwrap();
        match update(&mut estimator, &phi, &y, noise) {
            Ok(update) => {
                assert!(update.leverage.is_finite(), "{subject:?}, sample {k}: {update:?}");
                assert!(update.error.iter().all(|e| e.is_finite()), "{subject:?}");
                assert!(estimator.is_sound(), "{subject:?}, sample {k}: {estimator:?}");
            }
            Err(Error::State { reason }) => panic!("{subject:?}: {reason}"),
            Err(_) => assert!(estimator.to_bytes().unwrap() == before, "{subject:?}, sample {k}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn no_input_breaks_an_estimator(trial in trial()) {
        let subject = &subjects()[trial.subject];
        check::<f64>(subject, &trial);
        check::<f32>(subject, &trial);
    }
}
