//! A1 to A3 for every line of the registry.

use crate::dense::Dense;
use crate::inputs::rows;
use crate::run::{run, subject, Passed, N};
use crate::subjects::rules;
use forgetting::choice::{About, Claim, Constants, Guarantee, Guarantees, Input, Setting};
use forgetting::rules::Forgetting;
use forgetting::Dynamic;

/// Rounding of F's smallest eigenvalue relative to R, in units of eps times the condition of P.
/// Measured 2.7.
const ROUNDING: f64 = 30.0;

/// What P̄ may grow by without excitation and still count as bounded. Bounds that are stated as
/// formulas are tested in `bounds`.
const GROWTH: f64 = 1e3;

/// What each rule guarantees, but for a rule that is a function of the user's: what that
/// guarantees is the user's.
pub fn lines() -> impl Iterator<Item = (&'static About, Guarantees)> {
    rules().map(|subject| (subject.about, subject.about.guarantees.expect("what it guarantees")))
}

/// The setting in which what is not always guaranteed fails.
fn fails(about: &About, guarantee: Guarantee) -> Setting {
    guarantee.fails.unwrap_or_else(|| panic!("{}: a setting in which it fails", about.name))
}

fn extremes(matrix: &Dense) -> (f64, f64) {
    let values = matrix.eigenvalues();
    (values[0], values[values.len() - 1])
}

/// The smallest eigenvalue of F = R − R̄ relative to R over a run, and the same in units of its
/// rounding: that of Lᵀ F L = I − Lᵀ R̄ L, P = L Lᵀ.
fn least_forgotten(name: &str, setting: &Setting, samples: usize) -> (f64, f64) {
    let (mut least, mut rounding) = (f64::INFINITY, f64::INFINITY);
    run(name, setting, samples, |Passed { before, forgotten, .. }| {
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

/// The settings in which `guarantee` is to hold: those that its rule names, or the usual ones.
pub fn runs(about: &About, guarantee: Guarantee) -> Vec<Setting> {
    guarantee.holds.map_or_else(|| usual(about).collect(), |setting| vec![setting])
}

/// The default parameters with every input that fits.
pub fn usual(about: &About) -> impl Iterator<Item = Setting> + '_ {
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
    let fits = |input: &Input| about.largest_rows.is_none_or(|largest| rows(*input) <= largest);
    all.into_iter().filter(fits).map(Setting::usual)
}

#[test]
fn proper_rules_only_take_information() {
    for (about, Guarantees { proper, .. }) in lines() {
        if proper.claim == Claim::No {
            continue;
        }
        for setting in runs(about, proper) {
            let (_, rounding) = least_forgotten(about.name, &setting, 400);
            assert!(rounding > -ROUNDING, "{}: {rounding} {setting:?}", about.name);
        }
    }
}

#[test]
fn rules_that_are_not_always_proper_can_add_information() {
    for (about, Guarantees { proper, .. }) in lines() {
        if proper.claim == Claim::Always {
            continue;
        }
        let setting = fails(about, proper);
        let (least, _) = least_forgotten(about.name, &setting, 400);
        assert!(least < -1e-3, "{}: {least} {setting:?}", about.name);
    }
}

/// The largest eigenvalue of P̄ after 50 samples and from there to the end, over P₀.
fn growth(name: &str, setting: &Setting, samples: usize) -> f64 {
    let mut largest: f64 = 0.0;
    run(name, setting, samples, |Passed { forgotten, .. }| {
        largest = largest.max(extremes(&forgotten).1 / setting.variance);
        largest > 1e3 * GROWTH
    });
    largest
}

#[test]
fn without_excitation_what_is_claimed_to_be_bounded_is() {
    for (about, Guarantees { bounded_above, .. }) in lines() {
        if bounded_above.claim == Claim::No {
            continue;
        }
        for input in [Input::Silent, Input::Fixed] {
            let largest = growth(about.name, &Setting::usual(input), 4000);
            assert!(largest < GROWTH, "{}: {largest} {input:?}", about.name);
        }
    }
}

/// P̄ grows without bound, or beyond 1000 P₀ and further with a more extreme input.
#[test]
fn without_excitation_the_others_wind_up() {
    for (about, Guarantees { bounded_above, .. }) in lines() {
        if bounded_above.claim == Claim::Always {
            continue;
        }
        let setting = fails(about, bounded_above);
        let largest = growth(about.name, &setting, 4000);
        assert!(largest > GROWTH, "{}: {largest} {setting:?}", about.name);
    }
}

/// The smallest eigenvalue of P after `samples` over that after a tenth of them, and over P₀.
fn shrinkage(name: &str, setting: &Setting, samples: usize) -> (f64, f64) {
    let (mut early, mut late) = (f64::INFINITY, f64::INFINITY);
    run(name, setting, samples, |Passed { k, information, .. }| {
        let smallest = 1.0 / extremes(&information).1;
        if k < samples / 10 {
            early = early.min(smallest);
        } else {
            late = late.min(smallest);
        }
        false
    });
    (late / early, late.min(early) / setting.variance)
}

#[test]
fn with_bounded_regressors_what_is_claimed_to_stay_does() {
    for (about, Guarantees { bounded_below, .. }) in lines() {
        if bounded_below.claim == Claim::No {
            continue;
        }
        for setting in runs(about, bounded_below) {
            let (ratio, _) = shrinkage(about.name, &setting, 4000);
            assert!(ratio > 0.5, "{}: {ratio} {setting:?}", about.name);
        }
    }
}

/// P falls without bound, or regressors as large as can be take all of it.
#[test]
fn with_bounded_regressors_the_others_vanish() {
    for (about, Guarantees { bounded_below, .. }) in lines() {
        if bounded_below.claim == Claim::Always {
            continue;
        }
        let setting = fails(about, bounded_below);
        let (ratio, left) = shrinkage(about.name, &setting, 4000);
        assert!(ratio < 0.2 || left < 1e-9, "{}: {ratio}, {left} {setting:?}", about.name);
    }
}

#[test]
fn what_a_rule_says_of_itself_is_what_the_registry_says() {
    let constants = Constants {
        parameters: N,
        initial: (10.0, 10.0),
        forgetting_factors: (0.9, 0.99),
        regressor_bound: 3.0,
    };
    for (about, guarantees) in lines() {
        let Guarantees { proper, bounded_above, bounded_below } = guarantees;
        let named = [proper, bounded_above, bounded_below].map(|one| [one.holds, one.fails]);
        for setting in named.into_iter().flatten().flatten().chain(usual(about)) {
            let memory = Dynamic::<f64>::new(N, rows(setting.input), 1).unwrap();
            let rule = subject(about.name, &setting).rule(memory).unwrap();
            let (bounded, bounds) = (rule.is_bounded(), rule.bounds(&constants));
            match bounded_above.claim {
                Claim::Always => assert!(bounded, "{} {setting:?}", about.name),
                Claim::If(_) => {}
                Claim::No => assert!(!bounded, "{} {setting:?}", about.name),
            }
            assert!(bounds.above.is_none() || bounded, "{} {setting:?}", about.name);
            let vanishes = bounded_below.claim == Claim::No;
            assert!(bounds.below.is_none() || !vanishes, "{} {setting:?}", about.name);
        }
    }
}
