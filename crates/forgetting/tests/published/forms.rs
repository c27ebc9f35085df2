//! Records and runs for tests that compare a rule with its published form.
//!
//! Nothing here uses the crate's own linear algebra.
#![allow(dead_code, reason = "each test file uses its share")]

pub use crate::dense::Dense;
use forgetting::rules::Forgetting;
use forgetting::{Constant, Dynamic, Equal, Estimator, Kernels, Memory, Prior};

/// How the regressors of a record behave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// every direction, all the time
    Exciting,
    /// exciting, with long stretches of zeros
    Silent,
    /// within half of the space
    Deficient,
}

pub const INPUTS: [Input; 3] = [Input::Exciting, Input::Silent, Input::Deficient];

/// Whitened samples (φ, y) with one target.
pub fn record(input: Input, samples: usize, n: usize, p: usize) -> Vec<(Dense, Dense)> {
    let mut seed = 88_172_645_463_325_252u64 ^ (n * 8 + p) as u64;
    let mut random = move || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mixing: Vec<f64> = (0..n * n).map(|_| random()).collect();
    let sample = |k: usize| {
        let quiet = input == Input::Silent && (k / 25) % 2 == 1;
        let width = if input == Input::Deficient { n.div_ceil(2) } else { n };
        let mut phi = vec![0.0; p * n];
        for row in phi.chunks_exact_mut(n) {
            let source: Vec<f64> = (0..width).map(|_| random()).collect();
            for (i, x) in row.iter_mut().enumerate() {
                let mixed: f64 =
                    source.iter().enumerate().map(|(j, s)| s * mixing[j * n + i]).sum();
                *x = if quiet {
                    0.0
                } else if input == Input::Exciting {
                    source[i]
                } else {
                    mixed
                };
            }
        }
        let phi = Dense::new(p, &phi);
        let y: Vec<f64> = (0..p)
            .map(|r| (0..n).map(|i| phi.at(r, i) * (1.0 + i as f64)).sum::<f64>() + 0.1 * random())
            .collect();
        (phi, Dense::new(p, &y))
    };
    (0..samples).map(sample).collect()
}

/// θ and P of a published form.
pub struct Published {
    pub theta: Dense,
    pub covariance: Dense,
}

impl Published {
    pub fn new(n: usize, variance: f64) -> Self {
        Self { theta: Dense::zero(n, 1), covariance: Dense::scaled_identity(n, variance) }
    }

    /// Measures with P̄ = `covariance` (Γ = I) and corrects.
    pub fn measure(&mut self, widened: &Dense, phi: &Dense, y: &Dense) {
        let gain = gain(widened, phi, 1.0);
        let error = y.plus(-1.0, &phi.times(&self.theta));
        self.theta = self.theta.plus(1.0, &gain.times(&error));
        self.covariance = widened.plus(-1.0, &gain.times(&phi.times(widened))).symmetric();
    }
}

/// K = P φᵀ (c·I + φPφᵀ)⁻¹
pub fn gain(covariance: &Dense, phi: &Dense, c: f64) -> Dense {
    let cross = covariance.times(&phi.transpose());
    let spread = Dense::scaled_identity(phi.rows, c).plus(1.0, &phi.times(&cross));
    cross.times(&spread.inverse())
}

/// An estimator with a constant rate, all samples trusted alike.
pub type Plain<F, T> = Estimator<F, Constant<Dynamic<T>>, Equal<Dynamic<T>>, Dynamic<T>>;

/// An estimator with θ₀ = 0 and P₀ = `variance`·I and the constant factor `lambda`.
pub fn estimator<T: Kernels, F: Forgetting<Dynamic<T>>>(
    rule: F,
    lambda: f64,
    memory: Dynamic<T>,
    variance: f64,
) -> Plain<F, T> {
    let rate = Constant::new(T::from_f64(lambda)).unwrap();
    let prior = Prior::scalar(memory, T::from_f64(variance)).unwrap();
    Estimator::new(rule, rate, Equal::new(), prior)
}

/// Takes a sample.
pub fn update<T: Kernels, F: Forgetting<Dynamic<T>>>(
    estimator: &mut Plain<F, T>,
    phi: &Dense,
    y: &Dense,
) -> usize {
    let convert = |x: &Dense| x.elements.iter().map(|&x| T::from_f64(x)).collect::<Vec<T>>();
    let rank = estimator.update(&convert(phi), &convert(y)).unwrap().rank;
    assert!(estimator.is_sound());
    rank
}

/// θ and P of an estimator.
pub fn result<T: Kernels, F: Forgetting<Dynamic<T>>>(estimator: &Plain<F, T>) -> (Dense, Dense) {
    let n = estimator.prior().memory().parameters();
    let mut covariance = vec![T::ZERO; n * n];
    estimator.factor().reconstruct(&mut covariance);
    let convert = |x: &[T]| x.iter().map(|x| x.to_f64()).collect::<Vec<f64>>();
    (Dense::new(n, &convert(estimator.theta())), Dense::new(n, &convert(&covariance)))
}

/// The largest distance of θ and P from a published form, which `step` advances by a sample.
pub fn worst<T: Kernels, F: Forgetting<Dynamic<T>>>(
    rule: F,
    lambda: f64,
    variance: f64,
    samples: &[(Dense, Dense)],
    mut step: impl FnMut(&mut Published, &Dense, &Dense),
) -> f64 {
    let (p, n) = (samples[0].0.rows, samples[0].0.columns);
    let memory = Dynamic::<T>::new(n, p, 1).unwrap();
    let mut ours = estimator(rule, lambda, memory, variance);
    let mut theirs = Published::new(n, variance);
    let mut worst = 0.0f64;
    for (phi, y) in samples {
        update(&mut ours, phi, y);
        step(&mut theirs, phi, y);
        let (theta, covariance) = result(&ours);
        worst = worst.max(theta.distance(&theirs.theta));
        worst = worst.max(covariance.distance(&theirs.covariance));
    }
    worst
}

/// All inputs, with n in {1, 2, 4, 8} and p up to `rows`.
pub fn records(rows: usize, samples: usize) -> Vec<(Input, Vec<(Dense, Dense)>)> {
    let mut all = Vec::new();
    for input in INPUTS {
        for n in [1, 2, 4, 8] {
            for p in 1..=rows {
                all.push((input, record(input, samples, n, p)));
            }
        }
    }
    all
}
