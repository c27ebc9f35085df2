//! A1 to A3 for every line of the registry.

use crate::dense::Dense;
use crate::inputs::Input;
use crate::run::{Passed, Setting, N};
use crate::settings::{growing, improper, proper, usual, vanishing};
use crate::subjects::rules;
use forgetting::rules::{About, Claim};

/// Rounding of F's smallest eigenvalue relative to R, in units of eps times the condition of P.
/// Measured 2.7.
const ROUNDING: f64 = 30.0;

/// What P̄ may grow by without excitation and still count as bounded. Bounds that are stated as
/// formulas are tested in `bounds`.
const GROWTH: f64 = 1e3;

/// The lines of the registry, but for a rule that the user gives as a function: what that
/// guarantees is the user's.
fn lines() -> impl Iterator<Item = &'static About> {
    rules().map(|subject| subject.about)
}

fn extremes(matrix: &Dense) -> (f64, f64) {
    let values = matrix.eigenvalues();
    (values[0], values[values.len() - 1])
}

/// The smallest eigenvalue of F = R − R̄ relative to R over a run, and the same in units of its
/// rounding: that of Lᵀ F L = I − Lᵀ R̄ L, P = L Lᵀ.
fn least_forgotten(name: &str, setting: &Setting, samples: usize) -> (f64, f64) {
    let (mut least, mut rounding) = (f64::INFINITY, f64::INFINITY);
    setting.run(name, samples, |Passed { before, forgotten, .. }| {
        let (small, large) = extremes(&before);
        let l = before.cholesky();
        let left = l.transpose() * forgotten.inverse() * l;
        let f = extremes(&(Dense::identity(N) - left)).0;
        least = least.min(f);
        rounding = rounding.min(f / (f64::EPSILON * large / small));
        large > 1e10 * small
    });
    (least, rounding)
}

fn runs(about: &About) -> impl Iterator<Item = Setting> + '_ {
    let all = [
        Input::Exciting(1),
        Input::Silent,
        Input::Fixed,
        Input::Scaled(1e-3),
        Input::Exciting(2),
        Input::Exciting(3),
        Input::Dependent,
        Input::Uneven(1e-2),
    ];
    let fits = |input: &Input| about.largest_rows.is_none_or(|largest| input.rows() <= largest);
    all.into_iter().filter(fits).map(usual)
}

#[test]
fn proper_rules_only_take_information() {
    for about in lines().filter(|about| about.proper != Claim::No) {
        for setting in runs(about).map(|setting| proper(about.name, setting)) {
            let (_, rounding) = least_forgotten(about.name, &setting, 400);
            assert!(rounding > -ROUNDING, "{}: {rounding} {setting:?}", about.name);
        }
    }
}

#[test]
fn rules_that_are_not_always_proper_can_add_information() {
    for about in lines().filter(|about| about.proper != Claim::Always) {
        let setting = improper(about.name).expect("a counterexample in `improper`");
        let (least, _) = least_forgotten(about.name, &setting, 400);
        assert!(least < -1e-3, "{}: {least} {setting:?}", about.name);
    }
}

/// The largest eigenvalue of P̄ after 50 samples and from there to the end, over P₀.
fn growth(name: &str, setting: &Setting, samples: usize) -> f64 {
    let mut largest: f64 = 0.0;
    setting.run(name, samples, |Passed { forgotten, .. }| {
        largest = largest.max(extremes(&forgotten).1 / setting.variance);
        largest > 1e3 * GROWTH
    });
    largest
}

#[test]
fn without_excitation_what_is_claimed_to_be_bounded_is() {
    for about in lines().filter(|about| about.bounded_above != Claim::No) {
        for input in [Input::Silent, Input::Fixed] {
            let largest = growth(about.name, &usual(input), 4000);
            assert!(largest < GROWTH, "{}: {largest} {input:?}", about.name);
        }
    }
}

#[test]
fn without_excitation_the_others_wind_up() {
    for about in lines().filter(|about| about.bounded_above != Claim::Always) {
        let setting = growing(about.name).expect("a counterexample in `growing`");
        let largest = growth(about.name, &setting, 4000);
        assert!(largest > GROWTH, "{}: {largest} {setting:?}", about.name);
    }
}

/// The smallest eigenvalue of P after `samples` over that after a tenth of them.
fn shrinkage(name: &str, setting: &Setting, samples: usize) -> f64 {
    let (mut early, mut late) = (f64::INFINITY, f64::INFINITY);
    setting.run(name, samples, |Passed { k, information, .. }| {
        let smallest = 1.0 / extremes(&information).1;
        if k < samples / 10 {
            early = early.min(smallest);
        } else {
            late = late.min(smallest);
        }
        false
    });
    late / early
}

#[test]
fn with_bounded_regressors_what_is_claimed_to_stay_does() {
    for about in lines().filter(|about| about.bounded_below != Claim::No) {
        for setting in runs(about) {
            let ratio = shrinkage(about.name, &setting, 4000);
            assert!(ratio > 0.5, "{}: {ratio} {setting:?}", about.name);
        }
    }
}

#[test]
fn with_bounded_regressors_the_others_vanish() {
    for about in lines().filter(|about| about.bounded_below != Claim::Always) {
        let setting = vanishing(about.name).expect("a counterexample in `vanishing`");
        let small = match about.bounded_below {
            // not for want of a condition on the rule: unbounded regressors take all of P
            Claim::If("regressors bounded") => {
                let mut smallest = f64::INFINITY;
                setting.run(about.name, 50, |Passed { after, .. }| {
                    smallest = smallest.min(extremes(&after).0 / setting.variance);
                    false
                });
                smallest < 1e-9
            }
            _ => shrinkage(about.name, &setting, 4000) < 0.2,
        };
        assert!(small, "{} {setting:?}", about.name);
    }
}
