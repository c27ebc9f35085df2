//! The bound of P's trace, from which overflow is foreseen, bounds it after every sample.

use crate::subjects::{pairs, subjects, update, Given, Item, Subject};
use forgetting::memory::state::Visitor;
use forgetting::rules::RULES;
use forgetting::Factor;
use forgetting::Outcome;
use forgetting::{Dynamic, Kernels, Noise, Real};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::ops::RangeInclusive;

/// 0, ordinary numbers, and numbers of every size of which the square is accepted.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => Just(0.0),
        3 => -10.0..10.0,
        6 => (-1.0..1.0f64, any::<bool>()).prop_map(|(size, positive)| {
            if positive { 10f64.powf(75.0 * size) } else { -10f64.powf(75.0 * size) }
        }),
    ]
}

#[derive(Clone, Debug)]
struct Trial {
    /// n and p
    sizes: (usize, usize),
    /// the logarithm of the first variance, in parts of that of the largest
    variance: f64,
    forgetting_factor: f64,
    /// as many numbers as the largest sizes need
    regressors: Vec<Vec<f64>>,
}

fn trial(
    parameters: RangeInclusive<usize>,
    rows: RangeInclusive<usize>,
) -> impl Strategy<Value = Trial> {
    let numbers = prop::collection::vec(number(), parameters.end() * rows.end());
    let factor = prop_oneof![0.5..1.0f64, 1e-12..0.5f64, Just(1e-30)];
    let regressors = prop::collection::vec(numbers, 1..40);
    let variance = prop_oneof![-0.1..0.1f64, -0.95..0.95f64];
    (parameters, rows, variance, factor, regressors).prop_map(
        |(n, p, variance, forgetting_factor, regressors)| Trial {
            sizes: (n, p),
            variance,
            forgetting_factor,
            regressors,
        },
    )
}

/// The last number of a factor's state.
struct Bound<T>(T);

impl<T: Kernels> Visitor<T> for Bound<T> {
    fn reals(&mut self, values: &mut [T]) {
        self.0 = values.last().copied().unwrap_or(self.0);
    }

    fn whole(&mut self, _: &mut u64) {}
}

fn check_bound<T: Kernels>(factor: &Factor<Dynamic<T>>, of: &str) {
    let mut bound = Bound(T::ZERO);
    factor.clone().visit(&mut bound);
    let (bound, trace) = (bound.0.to_f64(), factor.trace().to_f64());
    assert!(factor.is_sound(), "{of}: {factor:?}");
    // half of it, for rounding
    assert!(bound >= 0.5 * trace, "{of}: a trace of {trace:e} is not below {bound:e}: {factor:?}");
}

/// Takes samples one by one, or several in one go where the estimator can.
fn check<T: Kernels>(subject: &Subject, trial: &Trial, in_one_go: usize) {
    let ((n, p), ceiling) = (trial.sizes, T::CEILING.to_f64());
    let variance = ceiling.powf(trial.variance);
    let estimator = subject.estimator::<T>((n, p, 1), trial.forgetting_factor, variance);
    let Some(mut estimator) = estimator else {
        return;
    };
    // of as many sizes in any number type
    let scale = ceiling.log10() / f64::CEILING.log10();
    let real = |x: &f64| T::from_f64(x.signum() * x.abs().powf(scale));
    let samples = trial.regressors.iter().flat_map(|row| &row[..p * n]);
    let phi: Vec<T> = samples.map(real).collect();
    let (y, mut k) = (vec![T::ONE; in_one_go.max(p)], 0);
    while k < trial.regressors.len() {
        let most = in_one_go.min(trial.regressors.len() - k);
        let mut told = vec![Outcome::default(); most];
        let taken = estimator.update_many(&phi[k * p * n..], &y[..most], &mut told, &mut []);
        if taken == 0 {
            // a sample may be refused, but not break anything
            let sample = &phi[k * p * n..][..p * n];
            let _ = update(&mut estimator, sample, &y[..p], Noise::Unit);
        }
        k += taken.max(1);
        check_bound(estimator.factor(), &format!("{subject:?}, before sample {k}"));
    }
}

/// Blocks of very different sizes and factors, which the plain subjects do not have.
fn unlike_blocks() -> Vec<Subject> {
    let given = |factors: [f64; 2]| {
        let blocks = ("blocks", Item::matrix(1, &[1.0, 5.0]));
        Given(vec![blocks, ("factors", Item::matrix(1, &factors))])
    };
    let of_blocks = |name| RULES.iter().find(|about| about.name == name).unwrap();
    ["multiple", "component"]
        .into_iter()
        .flat_map(|name| [[1e-6, 1e-6], [0.9, 1e-9], [1e-3, 1.0]].map(|factors| (name, factors)))
        .map(|(name, factors)| Subject { about: of_blocks(name), given: given(factors) })
        .collect()
}

/// Regressors along one direction, of every size that can be used: what rounding leaves of P is
/// then far from what a rule with a memory of its own keeps.
fn one_direction() -> impl Strategy<Value = Trial> {
    let sizes = prop::collection::vec(-140.0..70.0f64, 1..120);
    let base = prop::collection::vec(-1.0..1.0f64, 6);
    (base, sizes, -0.1..0.1f64).prop_map(|(base, sizes, variance)| Trial {
        sizes: (6, 1),
        variance,
        forgetting_factor: 1e-6,
        regressors: sizes
            .iter()
            .map(|&size| base.iter().map(|x| x * 10f64.powf(size)).collect())
            .collect(),
    })
}

#[test]
fn there_are_pairs_with_every_state() {
    let names: Vec<_> = pairs().iter().map(|pair| format!("{pair:?}")).collect();
    for inner in ["multiple []", "\"power\", 3", "\"choice\", 2", "variable_direction []"] {
        assert!(names.iter().any(|name| name.contains(inner)), "{inner}: {names:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn the_trace_stays_below_its_bound(trial in trial(2..=10, 1..=3)) {
        for subject in subjects() {
            check::<f64>(&subject, &trial, 0);
            check::<f32>(&subject, &trial, 0);
        }
    }

    #[test]
    fn the_trace_of_pairs_stays_below_its_bound(trial in trial(2..=10, 1..=3)) {
        for pair in pairs() {
            check::<f64>(&pair, &trial, 0);
            check::<f32>(&pair, &trial, 0);
        }
    }

    #[test]
    fn the_trace_of_unlike_blocks_stays_below_its_bound(trial in trial(6..=6, 1..=2)) {
        for subject in unlike_blocks() {
            check::<f64>(&subject, &trial, 0);
            check::<f32>(&subject, &trial, 0);
        }
    }

    #[test]
    fn the_trace_along_one_direction_stays_below_its_bound(trial in one_direction()) {
        for subject in unlike_blocks().iter().chain(&subjects()) {
            check::<f64>(subject, &trial, 0);
            check::<f32>(subject, &trial, 0);
        }
    }

    #[test]
    fn the_trace_of_many_parameters_stays_below_its_bound(trial in trial(11..=20, 1..=3)) {
        for subject in subjects() {
            check::<f64>(&subject, &trial, 0);
            check::<f32>(&subject, &trial, 0);
        }
    }

    #[test]
    fn the_trace_stays_below_its_bound_in_one_go(trial in trial(11..=20, 1..=1)) {
        for subject in subjects() {
            check::<f64>(&subject, &trial, 8);
            check::<f32>(&subject, &trial, 8);
        }
    }
}
