//! A record in one call is its samples one by one, or nothing at all.

mod signals;

use forgetting_runtime::{
    Array, Choice, CoreError, Elements, Error, Estimator, Kind, Missing, NumberType, Run, Settings,
    View,
};
use signals::numbers;

const SAMPLES: usize = 150;

fn settings(n: usize, rows: usize, targets: usize) -> Settings<'static> {
    let gate = Choice::named("dead_zone").with("width", 0.5);
    Settings { rows, targets, gate: Some(gate), ..Settings::new(n) }
}

fn view<'a>(numbers: &'a [f64], shape: &'a [usize]) -> View<'a> {
    View::new("numbers", numbers, shape).unwrap()
}

fn doubles(array: &Array) -> &[f64] {
    match &array.elements {
        Elements::F64(elements) => elements,
        other => panic!("{other:?}"),
    }
}

/// One row of an array.
fn row(array: &Array, sample: usize) -> &[f64] {
    let width: usize = array.shape[1..].iter().product();
    &doubles(array)[sample * width..(sample + 1) * width]
}

#[test]
fn a_run_is_its_updates() {
    for (n, p, m) in [(3, 1, 1), (3, 2, 1), (2, 1, 2), (3, 2, 2)] {
        for settings in [settings(n, p, m), Settings { gate: None, ..settings(n, p, m) }] {
            let (phi, y) = (numbers(1, SAMPLES * p * n), numbers(2, SAMPLES * p * m));
            let (mut one, mut other) =
                (Estimator::new(&settings).unwrap(), Estimator::new(&settings).unwrap());
            let shapes = ([SAMPLES, p, n], [SAMPLES, p, m]);
            let record = (view(&phi, &shapes.0), view(&y, &shapes.1), None);
            let mut run = one.run(record, Missing::Error, Some(&Run::OUTPUTS)).unwrap();
            let outputs = Run::OUTPUTS.map(|name| run.take(name).unwrap());
            let [theta, error, leverage, factor, rank, skipped, gate, windup, whitened, ..] =
                &outputs;
            let mut used = 0;
            for k in 0..SAMPLES {
                let phi = &phi[k * p * n..(k + 1) * p * n];
                let y = &y[k * p * m..(k + 1) * p * m];
                let sample = (view(phi, &shapes.0[1..]), view(y, &shapes.1[1..]));
                let update = other.update(sample.0, sample.1, None).unwrap();
                assert_eq!(row(error, k), doubles(&update.error.array()));
                assert_eq!(row(whitened, k), doubles(&update.whitened_innovation.array()));
                assert_eq!(row(theta, k), doubles(&other.theta()));
                assert_eq!(row(&outputs[10], k), doubles(&other.covariance().unwrap()));
                assert_eq!(doubles(leverage)[k], update.leverage);
                assert_eq!(doubles(factor)[k], update.forgetting_factor);
                let code = update.skipped.map_or(0.0, |reason| f64::from(reason.code()));
                let expected = [update.rank as f64, code, f64::from(update.gate.code())];
                assert_eq!([rank, skipped, gate].map(|x| x.elements.to_f64()[k]), expected);
                assert_eq!(windup.elements.to_f64()[k], f64::from(u8::from(update.windup)));
                used += usize::from(update.skipped.is_none());
            }
            assert_eq!((run.samples, run.used), (SAMPLES, used));
            assert_eq!(settings.gate.is_some(), used < SAMPLES);
            assert_eq!(one.to_bytes().unwrap(), other.to_bytes().unwrap());
        }
    }
}

#[test]
fn a_record_may_have_its_own_noise_for_each_sample() {
    let (n, p) = (2, 2);
    let (phi, y) = (numbers(3, SAMPLES * p * n), numbers(4, SAMPLES * p));
    let gamma: Vec<f64> = (1..=SAMPLES).flat_map(|k| [1.0 + k as f64, 0.5, 0.5, 1.0]).collect();
    let settings = settings(n, p, 1);
    let (mut one, mut other) =
        (Estimator::new(&settings).unwrap(), Estimator::new(&settings).unwrap());
    let shapes = ([SAMPLES, p, n], [SAMPLES, p], [SAMPLES, p, p]);
    let gammas = Some(view(&gamma, &shapes.2));
    let record = (view(&phi, &shapes.0), view(&y, &shapes.1), gammas);
    one.run(record, Missing::Error, None).unwrap();
    for k in 0..SAMPLES {
        let gamma = view(&gamma[k * p * p..(k + 1) * p * p], &shapes.2[1..]);
        let phi = view(&phi[k * p * n..(k + 1) * p * n], &shapes.0[1..]);
        other.update(phi, y[k * p..(k + 1) * p].into(), Some(gamma)).unwrap();
    }
    assert_eq!(one.to_bytes().unwrap(), other.to_bytes().unwrap());
}

#[test]
fn a_refused_record_leaves_all_as_it_was() {
    let mut estimator = Estimator::new(&Settings::new(2)).unwrap();
    estimator.update([1.0, 2.0][..].into(), [3.0][..].into(), None).unwrap();
    let before = estimator.to_bytes().unwrap();
    let (phi, mut y) = (numbers(5, SAMPLES * 2), numbers(6, SAMPLES));
    y[33] = f64::INFINITY;
    let good = numbers(7, SAMPLES);
    let shape = [SAMPLES, 2];
    let mut refused = |y: &[f64], count, outputs: &[&str]| {
        let record = (view(&phi, &shape), View::new("y", y, count).unwrap(), None);
        let refused = estimator.run(record, Missing::Skip, Some(outputs)).unwrap_err();
        assert_eq!(estimator.to_bytes().unwrap(), before);
        refused
    };
    let error = refused(&y, &[SAMPLES], &["theta"]);
    assert!(matches!(error, Error::Sample { sample: 33, error: CoreError::Value { .. } }));
    assert_eq!(error.to_string(), "sample 33: y[0] = inf, allowed: finite numbers");
    assert_eq!(error.kind(), Kind::Invalid);
    y[33] = 1e300;
    let error = refused(&y, &[SAMPLES], &["covariance", "prior_covariance"]);
    assert!(matches!(error, Error::Sample { sample: 33, error: CoreError::Range { .. } }));
    assert_eq!(error.kind(), Kind::Range);
    let error = refused(&good[1..], &[SAMPLES - 1], &["theta"]);
    let text = format!("y has shape ({},), expected ({SAMPLES},), ", SAMPLES - 1);
    assert!(error.to_string().starts_with(&text), "{error}");
    let error = refused(&good, &[SAMPLES], &["theta", "thetas"]);
    assert!(error.to_string().starts_with("outputs has \"thetas\", allowed: theta, error, "));
}

#[test]
fn a_missing_sample_is_left_out_or_refused() {
    let (phi, mut y) = (numbers(8, SAMPLES * 2), numbers(9, SAMPLES));
    y[40] = f64::NAN;
    let record = || (view(&phi, &[SAMPLES, 2]), view(&y, &[SAMPLES]), None);
    let mut estimator = Estimator::new(&Settings::new(2)).unwrap();
    let error = estimator.run(record(), Missing::Error, None).unwrap_err();
    assert_eq!(error.to_string(), "sample 40: y[0] = NaN, allowed: finite numbers");
    let mut run = estimator.run(record(), Missing::Skip, None).unwrap();
    assert_eq!((run.used, estimator.samples()), (SAMPLES - 1, SAMPLES as u64 - 1));
    assert!(doubles(&run.take("error").unwrap())[40].is_nan());
    let theta = run.take("theta").unwrap();
    assert_eq!(row(&theta, 40), row(&theta, 39));
    assert!(run.take("gate").is_none(), "not asked for");
    assert!(matches!(Missing::named("skip"), Ok(Missing::Skip)));
    let error = Missing::named("leave").unwrap_err();
    assert_eq!(error.to_string(), "missing = \"leave\", allowed: \"error\", \"skip\"");
}

#[test]
fn numbers_of_the_other_type_are_converted() {
    let (phi, y) = (numbers(10, SAMPLES * 2), numbers(11, SAMPLES));
    let single = |numbers: &[f64]| numbers.iter().map(|&x| x as f32).collect::<Vec<_>>();
    let (phi_32, y_32) = (single(&phi), single(&y));
    let settings = Settings { number_type: NumberType::F32, ..Settings::new(2) };
    let (mut one, mut other) =
        (Estimator::new(&settings).unwrap(), Estimator::new(&settings).unwrap());
    one.run((view(&phi, &[SAMPLES, 2]), view(&y, &[SAMPLES]), None), Missing::Error, None).unwrap();
    for (phi, y) in phi_32.chunks(2).zip(y_32.chunks(1)) {
        other.update(phi.into(), y.into(), None).unwrap();
    }
    assert_eq!(one.to_bytes().unwrap(), other.to_bytes().unwrap());
    assert!(matches!(one.theta().elements, Elements::F32(_)));
}

#[test]
fn a_prediction_has_the_shape_of_its_regressors() {
    let mut estimator = Estimator::new(&Settings { targets: 2, ..Settings::new(2) }).unwrap();
    estimator.update([1.0, 2.0][..].into(), [3.0, -1.0][..].into(), None).unwrap();
    let phi = numbers(12, 6);
    let predicted = estimator.predict(view(&phi, &[3, 2])).unwrap();
    assert_eq!(predicted.shape, [3, 2]);
    let theta = doubles(&estimator.theta()).to_vec();
    for (phi, y) in phi.chunks(2).zip(doubles(&predicted).chunks(2)) {
        for t in 0..2 {
            assert!((y[t] - (phi[0] * theta[t] + phi[1] * theta[2 + t])).abs() < 1e-14);
        }
    }
    assert_eq!(estimator.predict(view(&phi[..2], &[2])).unwrap().shape, [2]);
    let error = estimator.predict(view(&phi, &[2, 3])).unwrap_err();
    assert_eq!(error.to_string(), "phi has shape (2, 3), expected (..., 2)");
    let error = View::new("phi", &phi[..], &[2, 2]).unwrap_err();
    assert_eq!(error.to_string(), "phi has 6 elements, expected 4");
}
