//! Bounds of P by a formula.

use crate::claims::{lines, usual};
use crate::inputs::rows;
use crate::run::{run, subject, Passed, N};
use forgetting::choice::{Bounds, Constants, Guarantees, Input, Setting, Value};
use forgetting::rules::Forgetting;
use forgetting::Dynamic;

/// Relative rounding of the bounds.
const ROUNDING: f64 = 1e-9;

/// The extreme eigenvalues of P over a run, and the largest ‖φ‖², which no squared singular value
/// exceeds.
fn found(name: &str, setting: &Setting, samples: usize) -> (f64, f64, f64) {
    let (mut least, mut most, mut beta) = (f64::INFINITY, 0.0f64, 0.0f64);
    run(name, setting, samples, |Passed { phi_squared, after, information, .. }| {
        least = least.min(1.0 / information.eigenvalues()[N - 1]);
        most = most.max(after.eigenvalues()[N - 1]);
        beta = beta.max(phi_squared);
        most > 1e10 * least
    });
    (least, most, beta)
}

/// The bounds that the rule states for this setting.
fn stated(name: &str, setting: &Setting, regressor_bound: f64) -> Bounds {
    let memory = Dynamic::<f64>::new(N, rows(setting.input), 1).unwrap();
    let initial = (setting.variance, setting.variance);
    let constants = Constants {
        parameters: N,
        initial,
        forgetting_factors: (setting.forgetting_factor, setting.forgetting_factor),
        regressor_bound,
    };
    subject(name, setting).rule(memory).unwrap().bounds(&constants).with_initial(initial)
}

/// Every setting that a rule names, and the usual ones with other starts and factors.
fn settings() -> Vec<(&'static str, Setting)> {
    let mut all = Vec::new();
    for (about, Guarantees { proper, bounded_above, bounded_below }) in lines() {
        for guarantee in [proper, bounded_above, bounded_below] {
            let named = guarantee.holds.into_iter().chain(guarantee.fails);
            all.extend(named.map(|setting| (about.name, setting)));
        }
        for setting in usual(about) {
            let variants = [(0.95, 10.0), (0.5, 0.01), (0.8, 1e4)];
            all.extend(variants.map(|(forgetting_factor, variance)| {
                (about.name, Setting { forgetting_factor, variance, ..setting })
            }));
        }
    }
    all
}

#[test]
fn p_stays_between_the_bounds_of_its_rule() {
    let (mut below, mut above) = (0, 0);
    for (name, setting) in settings() {
        let (least, most, beta) = found(name, &setting, 1000);
        let bounds = stated(name, &setting, beta);
        if let Some(bound) = bounds.below {
            below += 1;
            assert!(least > bound * (1.0 - ROUNDING), "{name} {setting:?}: {least} < {bound}");
        }
        if let Some(bound) = bounds.above {
            above += 1;
            assert!(most < bound * (1.0 + ROUNDING), "{name} {setting:?}: {most} > {bound}");
        }
    }
    assert!(below > 100 && above > 100, "{below} and {above} runs had bounds");
}

#[test]
fn resetting_returns_to_the_information_given() {
    for name in ["exponential_resetting", "cyclic_resetting"] {
        let mut last = None;
        // whole cycles
        run(name, &Setting::usual(Input::Silent), 400 * N, |passed| {
            last = Some(passed.after);
            false
        });
        let p = last.unwrap();
        for i in 0..N {
            assert!((p.at(i, i) / 100.0 - 1.0).abs() < 1e-9, "{name}: {p:?}");
        }
    }
}

#[test]
fn exponential_resetting_keeps_more_than_it_resets_to() {
    run(
        "exponential_resetting",
        &Setting::usual(Input::Fixed),
        2000,
        |Passed { k, after, .. }| {
            let kept = 0.95f64.powi(k as i32 + 1);
            let bound = kept * 0.1 + (1.0 - kept) * 0.01;
            assert!(1.0 / after.eigenvalues()[N - 1] > bound * (1.0 - ROUNDING));
            false
        },
    );
}

#[test]
fn covariance_resetting_keeps_the_smallest_eigenvalue() {
    let setting = Setting::usual(Input::Exciting(1)).with(&[
        ("criterion", Value::Word("smallest_eigenvalue")),
        ("threshold", Value::Real(0.01)),
        ("covariance", Value::Real(5.0)),
    ]);
    let mut resets = 0;
    run("covariance_resetting", &setting, 3000, |Passed { before, forgotten, after, .. }| {
        resets += usize::from(forgotten.at(0, 0) == 5.0 && before.at(0, 0) != 5.0);
        // before the data at least the threshold, after it that and one regressor
        assert!(1.0 / after.eigenvalues()[0] < 100.0 + 3.0 + 1e-6);
        false
    });
    assert!(resets > 5);
}
