//! Bounds that a header states as a formula.

use crate::inputs::Input;
use crate::run::{Passed, Setting, N};
use crate::settings::usual;
use crate::subjects::{Given, Item};

/// Relative rounding of the bounds.
const ROUNDING: f64 = 1e-9;

/// The extreme eigenvalues of R over a run.
fn information(name: &str, setting: &Setting, samples: usize) -> (f64, f64) {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    setting.run(name, samples, |Passed { after, .. }| {
        let values = after.eigenvalues();
        least = least.min(1.0 / values[N - 1]);
        most = most.max(1.0 / values[0]);
        false
    });
    (least, most)
}

/// The largest ‖φ‖² of an input, row by row within the cube.
fn beta(input: Input) -> f64 {
    (N * input.rows()) as f64
}

#[test]
fn skipping_what_is_too_small_bounds_the_information_on_both_sides() {
    let threshold = 0.2;
    for (name, inputs) in [
        (
            "subspace",
            &[Input::Exciting(1), Input::Exciting(2), Input::Fixed, Input::Scaled(0.1)][..],
        ),
        ("directional", &[Input::Exciting(1), Input::Fixed, Input::Scaled(0.1)]),
    ] {
        for &input in inputs {
            for (factor, variance) in [(0.95, 10.0), (0.5, 0.01), (0.8, 1e4)] {
                let given = Given::one("threshold", Item::Real(threshold));
                let setting = Setting { given, factor, variance, ..usual(input) };
                let (least, most) = information(name, &setting, 3000);
                let low = (threshold * threshold / (1.0 - factor)).min(1.0 / variance);
                let high = (beta(input) / (1.0 - factor)).max(1.0 / variance);
                assert!(least > low * (1.0 - ROUNDING), "{name} {setting:?}: {least} < {low}");
                assert!(most < high * (1.0 + ROUNDING), "{name} {setting:?}: {most} > {high}");
            }
        }
    }
}

#[test]
fn resetting_returns_to_the_information_given() {
    for name in ["exponential_resetting", "cyclic_resetting"] {
        let mut last = None;
        usual(Input::Silent).run(name, 50 + 300 * N, |passed| {
            last = Some(passed.after);
            false
        });
        let p = last.unwrap();
        for i in 0..N {
            // at the end of a cycle exactly, within it by a factor λ⁻ⁿ at most
            let ratio = p.at(i, i) / 100.0;
            assert!(ratio < 1.0 + 1e-9 && ratio > 0.95f64.powi(N as i32), "{name}: {p:?}");
        }
    }
}

#[test]
fn exponential_resetting_keeps_more_than_it_resets_to() {
    let setting = usual(Input::Fixed);
    setting.run("exponential_resetting", 2000, |Passed { k, after, .. }| {
        let kept = 0.95f64.powi(k as i32 + 1);
        let bound = kept * 0.1 + (1.0 - kept) * 0.01;
        assert!(1.0 / after.eigenvalues()[N - 1] > bound * (1.0 - ROUNDING));
        false
    });
}

#[test]
fn data_dependent_information_is_at_most_the_regressors_or_the_start() {
    for variance in [10.0, 0.01] {
        for error in [1.0, 100.0] {
            let setting = Setting { variance, error, ..usual(Input::Exciting(1)) };
            let (_, most) = information("data_dependent", &setting, 3000);
            assert!(most < f64::max(3.0, 1.0 / variance) * (1.0 + ROUNDING));
        }
    }
}

#[test]
fn covariance_resetting_keeps_the_smallest_eigenvalue() {
    let given = vec![
        ("criterion", Item::Word("smallest_eigenvalue")),
        ("threshold", Item::Real(0.01)),
        ("covariance", Item::Real(5.0)),
    ];
    let setting = Setting { given: Given(given), ..usual(Input::Exciting(1)) };
    let mut resets = 0;
    setting.run("covariance_resetting", 3000, |Passed { before, forgotten, after, .. }| {
        resets += usize::from(forgotten.at(0, 0) == 5.0 && before.at(0, 0) != 5.0);
        // before the data at least the threshold, after it that and one regressor
        assert!(1.0 / after.eigenvalues()[0] < 100.0 + 3.0 + 1e-6);
        false
    });
    assert!(resets > 5);
}
