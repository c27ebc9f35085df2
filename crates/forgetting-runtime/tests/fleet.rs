//! A fleet is as many estimators, each with what it has of its own.

mod signals;

use forgetting_runtime::{
    Choice, Elements, Estimator, Fleet, FleetUpdate, ForgettingFactor, Kind, NumberType, Settings,
    View,
};
use signals::numbers;

const COUNT: usize = 13;
const N: usize = 3;
const STEPS: usize = 25;

fn view<'a>(numbers: &'a [f64], shape: &'a [usize]) -> View<'a> {
    View::new("numbers", numbers, shape).unwrap()
}

fn codes(update: &FleetUpdate) -> &[u8] {
    match &update.skipped.as_ref().unwrap().elements {
        Elements::U8(codes) => codes,
        other => panic!("{other:?}"),
    }
}

/// Rules that a fleet keeps in vectors, and one of which it keeps estimators.
fn rules() -> [Choice; 3] {
    ["exponential", "subspace", "oblique_projection"].map(Choice::named)
}

#[test]
fn streams_differ_in_factor_and_prior_as_estimators_do() {
    let factors: Vec<f64> = (0..COUNT).map(|i| 0.9 + 0.007 * i as f64).collect();
    let variances: Vec<f64> = (0..COUNT * N).map(|k| 1.0 + k as f64).collect();
    let thetas = numbers(1, COUNT * N);
    for rule in rules() {
        for number_type in [NumberType::F64, NumberType::F32] {
            let settings = Settings {
                number_type,
                rule: Some(rule.clone()),
                initial_covariance: Some(view(&variances, &[COUNT, N])),
                initial_theta: Some(view(&thetas, &[COUNT, N])),
                ..Settings::new(N)
            };
            let mut fleet = Fleet::new(COUNT as i64, &settings, Some(view(&factors, &[COUNT])));
            let fleet = fleet.as_mut().unwrap();
            let mut each: Vec<_> = (0..COUNT)
                .map(|i| {
                    Estimator::new(&Settings {
                        forgetting_factor: ForgettingFactor::constant(factors[i]),
                        initial_covariance: Some(view(&variances[i * N..(i + 1) * N], &[N])),
                        initial_theta: Some(view(&thetas[i * N..(i + 1) * N], &[N])),
                        ..settings.clone()
                    })
                    .unwrap()
                })
                .collect();
            for step in 0..STEPS as u64 {
                let (phi, y) = (numbers(2 + step, COUNT * N), numbers(100 + step, COUNT));
                let sample = (view(&phi, &[COUNT, N]), view(&y, &[COUNT]), None);
                let update = fleet.update(sample, Some(&FleetUpdate::OUTPUTS)).unwrap();
                assert_eq!(update.used, COUNT);
                let (error, leverage) = (update.error.unwrap(), update.leverage.unwrap());
                for (i, estimator) in each.iter_mut().enumerate() {
                    let phi = phi[i * N..(i + 1) * N].into();
                    let alone = estimator.update(phi, y[i..=i].into(), None).unwrap();
                    assert_eq!(
                        error.elements.to_f64()[i],
                        alone.error.array().elements.to_f64()[0]
                    );
                    assert_eq!(leverage.elements.to_f64()[i], alone.leverage);
                }
            }
            for (i, estimator) in each.iter().enumerate() {
                assert_eq!(fleet.state(i as i64).unwrap(), estimator.to_bytes().unwrap());
                let own = fleet.get(i as i64 - COUNT as i64).unwrap();
                assert_eq!(own.to_bytes().unwrap(), estimator.to_bytes().unwrap());
                assert_eq!(fleet.covariance(i as i64).unwrap(), estimator.covariance().unwrap());
            }
            let health = fleet.health(&mut || Ok(())).unwrap();
            let largest: Vec<_> = each.iter().map(|estimator| estimator.extremes().0).collect();
            assert_eq!(health.largest.elements.to_f64(), largest);
            assert_eq!(health.samples, fleet.samples(&mut || Ok(())).unwrap());
            assert_eq!(health.samples.elements, Elements::I64(vec![STEPS as i64; COUNT]));
        }
    }
}

#[test]
fn what_a_stream_cannot_use_leaves_it_as_it_was() {
    for rule in rules() {
        let settings = Settings { rule: Some(rule), ..Settings::new(N) };
        let mut fleet = Fleet::new(COUNT as i64, &settings, None).unwrap();
        let (mut phi, mut y) = (numbers(3, COUNT * N), numbers(4, COUNT));
        phi[N] = f64::NAN;
        y[2] = f64::INFINITY;
        let mask: Vec<bool> = (0..COUNT).map(|i| i != 5).collect();
        let before: Vec<_> = (0..COUNT as i64).map(|i| fleet.state(i).unwrap()).collect();
        let sample = (view(&phi, &[COUNT, N]), view(&y, &[COUNT]), Some(&mask[..]));
        let update = fleet.update(sample, None).unwrap();
        assert_eq!((update.used, update.leverage.is_none()), (COUNT - 3, true));
        for (i, &code) in codes(&update).iter().enumerate() {
            let unused = [1, 2, 5].contains(&i);
            assert_eq!(fleet.state(i as i64).unwrap() == before[i], unused);
            assert_eq!((code != 0, code == FleetUpdate::REFUSED), (unused, i == 2));
        }
        let sample = (view(&phi[N..], &[COUNT - 1, N]), view(&y, &[COUNT]), None);
        let error = fleet.update(sample, None).unwrap_err();
        assert_eq!(error.to_string(), "phi has shape (12, 3), expected (13, 3)");
        let error = fleet.reset(Some(&mask[1..]), &mut || Ok(())).unwrap_err();
        assert_eq!(error.to_string(), "mask has shape (12,), expected (13,)");
        fleet.reset(Some(&mask), &mut || Ok(())).unwrap();
        assert_eq!(fleet.state(0).unwrap(), before[0]);
    }
}

#[test]
fn threads_change_nothing() {
    for rule in rules() {
        let settings = Settings { rule: Some(rule), ..Settings::new(N) };
        let mut one = Fleet::new(COUNT as i64, &settings, None).unwrap();
        let mut other = one.clone();
        one.set_threads(Some(1));
        other.set_threads(Some(3));
        let (phi, y) = (numbers(5, COUNT * N), numbers(6, COUNT));
        let update = |fleet: &mut Fleet| {
            let sample = (view(&phi, &[COUNT, N]), view(&y, &[COUNT]), None);
            fleet.update(sample, Some(&FleetUpdate::OUTPUTS)).unwrap()
        };
        assert_eq!(update(&mut one), update(&mut other));
        let read = |fleet: &Fleet| {
            [fleet.theta(&mut || Ok(())).unwrap(), fleet.variance(&mut || Ok(())).unwrap()]
        };
        assert_eq!(read(&one), read(&other));
        assert_eq!((other.threads(), one.count()), (Some(3), COUNT));
    }
}

#[test]
fn streams_are_put_and_added_if_they_are_of_its_kind() {
    let settings = Settings::new(N);
    let mut fleet = Fleet::new(4, &settings, None).unwrap();
    let mut estimator = Estimator::new(&settings).unwrap();
    estimator.update([1.0, 2.0, 3.0][..].into(), [1.0][..].into(), None).unwrap();
    fleet.put(-1, estimator.clone()).unwrap();
    assert_eq!(fleet.state(3).unwrap(), estimator.to_bytes().unwrap());
    let other = fleet.clone();
    fleet.append(&other).unwrap();
    assert_eq!((fleet.count(), fleet.state(7).unwrap()), (8, estimator.to_bytes().unwrap()));

    let error = fleet.put(8, estimator.clone()).unwrap_err();
    assert_eq!(
        (error.kind(), error.to_string().as_str()),
        (Kind::Index, "stream 8 of a fleet of 8")
    );
    let single = Settings { number_type: NumberType::F32, ..settings.clone() };
    let error = fleet.put(0, Estimator::new(&single).unwrap()).unwrap_err();
    assert_eq!(error.to_string(), "a stream has the dtype of its fleet");
    let error = fleet.append(&Fleet::new(2, &single, None).unwrap()).unwrap_err();
    assert_eq!(error.to_string(), "a stream has the dtype of its fleet");
    let rule = Settings { rule: Some(Choice::named("none")), ..settings };
    let error = fleet.append(&Fleet::new(2, &rule, None).unwrap()).unwrap_err();
    assert!(error.to_string().contains("the rule of its fleet"));
    assert_eq!(fleet.count(), 8);
    assert_eq!(fleet.grow(1 << 60).unwrap_err().kind(), Kind::Memory);
}

#[test]
fn what_a_fleet_cannot_be_is_refused() {
    let refused = |count, settings: &Settings<'_>, factor| {
        Fleet::new(count, settings, factor).err().unwrap().to_string()
    };
    let settings = Settings::new(N);
    assert_eq!(refused(-1, &settings, None), "count = -1, allowed: whole numbers from 0");
    let bad = [0.9, 1.1, 0.9, 0.9];
    let factor = Some(view(&bad, &[4]));
    assert_eq!(refused(4, &settings, factor), "stream 1: forgetting_factor = 1.1, allowed: (0, 1]");
    let text = "forgetting_factor has shape (4,), expected () or (5,)";
    assert_eq!(refused(5, &settings, factor), text);
    let none = Settings { rule: Some(Choice::named("none")), ..settings.clone() };
    let text = "forgetting_factor is given, but the rule none uses none";
    assert_eq!(refused(4, &none, Some(view(&bad[..1], &[]))), text);
    let rate = ForgettingFactor::Rate(Choice::named("fortescue"));
    let twice = Settings { forgetting_factor: rate, ..settings.clone() };
    let text = "forgetting_factor is given twice: the rule has the rate fortescue";
    assert_eq!(refused(4, &twice, Some(view(&bad[..1], &[]))), text);
    let rows = Settings { rows: 2, ..settings.clone() };
    assert_eq!(refused(4, &rows, None), "a stream has one row and one target");
    let monitor = Settings { monitor: true, ..settings };
    assert_eq!(refused(4, &monitor, None), "a stream of a fleet is not monitored");
}
