//! Models whose regressor needs what they have made of earlier samples.

use forgetting_runtime::{
    Bank, BankSettings, Choice, Error, Estimator, InputOrders, Learner, Model, Orders, Settings,
    View,
};

/// u and y of y(k) = 0.8 y(k−1) + u(k−1) + e(k) + 0.5 e(k−1).
fn record(samples: usize) -> (Vec<f64>, Vec<f64>) {
    let mut state = 1u64;
    let mut noise = || {
        // a linear congruential generator, in (−1, 1)
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let (mut u, mut y, mut past) = (vec![0.0; samples], vec![0.0; samples], 0.0);
    for k in 0..samples {
        (u[k], y[k]) = (noise(), noise());
        let e = y[k];
        if k > 0 {
            y[k] += 0.8 * y[k - 1] + u[k - 1] + 0.5 * past;
        }
        past = e;
    }
    (u, y)
}

fn armax() -> Orders {
    let input = InputOrders { nb: 1, nf: 0, nk: 1 };
    Orders { na: 1, nc: 1, nd: 0, inputs: vec![input], constant: true }
}

fn learn(model: &mut Model, estimator: &mut Estimator, (u, y): (&[f64], &[f64])) -> Vec<f64> {
    let shape = [y.len(), 1];
    let inputs = View::new("u", u, &shape).expect("of this shape");
    let learner = Learner::Estimator(estimator);
    let run = model.learn(learner, (inputs, y.into()), (&["error"], None), &mut || Ok(()));
    run.expect("a sound record").take("error").expect("asked for").elements.to_f64()
}

#[test]
fn it_goes_on_from_its_bytes_as_if_nothing_had_happened() {
    let (u, y) = record(2000);
    let settings = Settings { rule: Some(Choice::named("none")), ..Settings::new(4) };
    let mut estimator = Estimator::new(&settings).expect("sound");
    let mut model = Model::new(armax(), "prediction_error").expect("sound");
    learn(&mut model, &mut estimator, (&u[..150], &y[..150]));
    let mut again = Model::from_bytes(&model.to_bytes()).expect("just saved");
    let mut copy = estimator.copy().expect("enough memory");
    let one = learn(&mut model, &mut estimator, (&u[150..], &y[150..]));
    let other = learn(&mut again, &mut copy, (&u[150..], &y[150..]));
    assert_eq!(one, other);
    assert_eq!(model.theta(), again.theta());
    let theta = model.theta().elements.to_f64();
    for (found, true_value) in theta.iter().zip([0.8, 1.0, 0.5]) {
        assert!((found - true_value).abs() < 0.1, "{theta:?}");
    }
}

#[test]
fn altered_bytes_are_refused() {
    let model = Model::new(armax(), "extended_least_squares").expect("sound");
    let bytes = model.to_bytes();
    for k in 0..bytes.len() {
        let mut altered = bytes.clone();
        altered[k] ^= 1;
        assert!(Model::from_bytes(&altered).is_err(), "byte {k}");
        assert!(Model::from_bytes(&bytes[..k]).is_err(), "{k} bytes");
    }
}

#[test]
fn a_refused_sample_leaves_all_as_it_was() {
    let (u, mut y) = record(100);
    let common = Settings::new(4);
    let mut bank = Bank::new(&BankSettings { common, members: None, mixer: None }).expect("sound");
    let mut model = Model::new(armax(), "prediction_error").expect("sound");
    let before = (bank.to_bytes().expect("data"), model.to_bytes());
    y[60] = f64::INFINITY;
    let shape = [100, 1];
    let inputs = View::new("u", &u[..], &shape).expect("of this shape");
    let refused =
        model.learn(Learner::Bank(&mut bank), (inputs, y[..].into()), (&[], None), &mut || Ok(()));
    assert!(matches!(refused, Err(Error::Sample { sample: 60, .. })), "{refused:?}");
    assert_eq!(before, (bank.to_bytes().expect("data"), model.to_bytes()));
}

#[test]
fn orders_and_estimators_that_do_not_fit_are_named() {
    let none = Orders::default();
    let error = Model::new(none, "prediction_error").expect_err("no parameter");
    assert!(error.to_string().contains("all orders are 0"));
    let mut model = Model::new(armax(), "prediction_error").expect("sound");
    let mut estimator = Estimator::new(&Settings::new(3)).expect("sound");
    let learner = Learner::Estimator(&mut estimator);
    let shape = [1, 1];
    let inputs = View::new("u", &[0.0][..], &shape).expect("of this shape");
    let error = model.learn(learner, (inputs, [0.0][..].into()), (&[], None), &mut || Ok(()));
    assert!(error.expect_err("three for four").to_string().contains("4 parameters"));
}
