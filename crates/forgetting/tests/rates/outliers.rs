//! What an outlier can do: to θ under a weighting, and to λ.

use crate::subjects::{factors, make, sample, take};
use forgetting::rates::RATES;
use forgetting::saved::AnyEstimator;
use forgetting::weightings::{Weighting, WEIGHTINGS};
use forgetting::{Dynamic, Noise};

/// ‖(Pφ̄ᵀ)_i‖ for each i, with P before the sample and φ̄ whitened by Γ = diag(gamma).
fn reach(estimator: &AnyEstimator<f64>, phi: &[f64], gamma: &[f64]) -> Vec<f64> {
    let n = estimator.factor().parameters();
    let mut squares = vec![0.0; n];
    for (row, gamma) in phi.chunks_exact(n).zip(gamma) {
        let row: Vec<f64> = row.iter().map(|x| x / gamma.sqrt()).collect();
        let mut x = vec![0.0; n];
        estimator.factor().multiply(&row, &mut x);
        squares.iter_mut().zip(x).for_each(|(sum, x)| *sum += x * x);
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// One outlier moves no parameter of any target by more than c ‖(P̄φ̄ᵀ)_i‖.
#[test]
fn an_outlier_has_bounded_influence() {
    let memory = Dynamic::<f64>::new(3, 2, 2).unwrap();
    let gamma = [4.0, 0.25];
    let full = [gamma[0], 0.0, 0.0, gamma[1]];
    let mut bounded = 0;
    for weighting in WEIGHTINGS {
        let mut estimator = make(memory, ["none", "constant", weighting.name]);
        let Some(c) = estimator.weighting().influence(2) else { continue };
        bounded += 1;
        for k in 0..100 {
            let (phi, y) = sample(memory, k);
            // with `none` P̄ is P
            let limits = reach(&estimator, &phi, &gamma);
            for size in [1.0, 2.0, 1e6, -1e9, 1e60] {
                let mut shot = estimator.clone();
                let y = [y[0] + size, y[1], y[2] - size, y[3] + 2.0 * size];
                take(&mut shot, &phi, &y, Noise::Full(&full)).unwrap();
                for (target, before) in estimator.theta().chunks_exact(3).enumerate() {
                    for i in 0..3 {
                        let moved = (shot.theta()[target * 3 + i] - before[i]).abs();
                        let rounding = 1e-12 * before[i].abs();
                        assert!(moved <= c * limits[i] * (1.0 + 1e-9) + rounding, "{size:e}");
                    }
                }
            }
            take(&mut estimator, &phi, &y, Noise::Full(&full)).unwrap();
        }
        // the bound is reached, or nearly
        let (phi, y) = sample(memory, 100);
        let limits = reach(&estimator, &phi, &gamma);
        let most = (0..60).map(|k| {
            let mut shot = estimator.clone();
            let y = [y[0] + f64::from(k - 10).exp(), y[1], y[2], y[3]];
            take(&mut shot, &phi, &y, Noise::Full(&full)).unwrap();
            (shot.theta()[0] - estimator.theta()[0]).abs() / (c * limits[0])
        });
        assert!(most.fold(0.0, f64::max) > 0.05, "{}", weighting.name);
    }
    assert_eq!(bounded, WEIGHTINGS.len() - 1, "only equal weights are not bounded");
}

/// However large the outlier, a rate sees no more than the clipped error.
#[test]
fn no_rate_forgets_more_for_a_larger_outlier() {
    let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
    for about in RATES {
        let mut estimator = make(memory, ["exponential", about.name, "huber"]);
        factors(&mut estimator, 0, 149);
        let (phi, y) = sample(memory, 149);
        let after = |size: f64| {
            let mut shot = estimator.clone();
            let mut next = |y: &[f64]| take(&mut shot, &phi, y, Noise::Unit).unwrap();
            [next(&[y[0] + size]), next(&y)]
        };
        for (large, larger) in after(1e6).into_iter().zip(after(1e60)) {
            assert!((large - larger).abs() < 1e-4, "{}: {large}, {larger}", about.name);
        }
    }
}
