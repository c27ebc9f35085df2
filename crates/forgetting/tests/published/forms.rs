//! Dense matrices, records and runs for tests that compare a rule with its published form.
//!
//! Nothing here uses the crate's own linear algebra.
#![allow(dead_code, reason = "each test file uses its share")]

use forgetting::rules::Forgetting;
use forgetting::{Constant, Dynamic, Equal, Estimator, Memory, Prior, Real};

/// A dense matrix, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Dense {
    pub rows: usize,
    pub columns: usize,
    pub at: Vec<f64>,
}

impl Dense {
    pub fn new(rows: usize, columns: usize, at: Vec<f64>) -> Self {
        assert_eq!(at.len(), rows * columns);
        Self { rows, columns, at }
    }

    pub fn scaled_identity(n: usize, c: f64) -> Self {
        Self::diagonal(&vec![c; n])
    }

    pub fn diagonal(elements: &[f64]) -> Self {
        let n = elements.len();
        let at = (0..n * n).map(|k| if k / n == k % n { elements[k / n] } else { 0.0 }).collect();
        Self::new(n, n, at)
    }

    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.at[i * self.columns + j]
    }

    pub fn transpose(&self) -> Self {
        let (r, c) = (self.rows, self.columns);
        Self::new(c, r, (0..r * c).map(|k| self.get(k % r, k / r)).collect())
    }

    pub fn times(&self, other: &Self) -> Self {
        assert_eq!(self.columns, other.rows);
        let (r, c) = (self.rows, other.columns);
        let element = |i: usize, j: usize| -> f64 {
            (0..self.columns).map(|k| self.get(i, k) * other.get(k, j)).sum()
        };
        Self::new(r, c, (0..r * c).map(|k| element(k / c, k % c)).collect())
    }

    /// self + c·other
    pub fn plus(&self, c: f64, other: &Self) -> Self {
        assert_eq!((self.rows, self.columns), (other.rows, other.columns));
        let at = self.at.iter().zip(&other.at).map(|(x, y)| x + c * y).collect();
        Self::new(self.rows, self.columns, at)
    }

    pub fn scaled(&self, c: f64) -> Self {
        Self::new(self.rows, self.columns, self.at.iter().map(|x| c * x).collect())
    }

    pub fn symmetric(&self) -> Self {
        self.plus(1.0, &self.transpose()).scaled(0.5)
    }

    pub fn trace(&self) -> f64 {
        (0..self.rows).map(|i| self.get(i, i)).sum()
    }

    /// By Gauss and Jordan with row pivots.
    pub fn inverse(&self) -> Self {
        let n = self.rows;
        let mut a = self.at.clone();
        let mut b = Self::scaled_identity(n, 1.0).at;
        for k in 0..n {
            let pivot = (k..n).max_by(|&i, &j| a[i * n + k].abs().total_cmp(&a[j * n + k].abs()));
            let pivot = pivot.unwrap();
            for j in 0..n {
                a.swap(k * n + j, pivot * n + j);
                b.swap(k * n + j, pivot * n + j);
            }
            let scale = 1.0 / a[k * n + k];
            for j in 0..n {
                a[k * n + j] *= scale;
                b[k * n + j] *= scale;
            }
            for i in (0..n).filter(|&i| i != k) {
                let c = a[i * n + k];
                for j in 0..n {
                    a[i * n + j] -= c * a[k * n + j];
                    b[i * n + j] -= c * b[k * n + j];
                }
            }
        }
        Self::new(n, n, b)
    }

    /// Eigenvalues, ascending, and eigenvectors as columns, by Jacobi's rotations.
    pub fn eigen(&self) -> (Vec<f64>, Self) {
        let n = self.rows;
        let (mut a, mut v) = (self.symmetric(), Self::scaled_identity(n, 1.0));
        for _ in 0..12 {
            for p in 0..n {
                for q in p + 1..n {
                    let off = a.get(p, q);
                    if off.abs() <= 1e-18 * (a.get(p, p) * a.get(q, q)).abs().sqrt() {
                        continue;
                    }
                    let zeta = (a.get(q, q) - a.get(p, p)) / (2.0 * off);
                    let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
                    let t = if zeta == 0.0 { 1.0 } else { t };
                    let (c, t) = (1.0 / t.hypot(1.0), t / t.hypot(1.0));
                    let turn = |m: &mut Vec<f64>, x: usize, y: usize| {
                        (m[x], m[y]) = (c * m[x] - t * m[y], t * m[x] + c * m[y]);
                    };
                    for k in 0..n {
                        turn(&mut a.at, p * n + k, q * n + k);
                    }
                    for k in 0..n {
                        turn(&mut a.at, k * n + p, k * n + q);
                        turn(&mut v.at, k * n + p, k * n + q);
                    }
                }
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| a.get(i, i).total_cmp(&a.get(j, j)));
        let values = order.iter().map(|&i| a.get(i, i)).collect();
        let vectors = (0..n * n).map(|k| v.get(k / n, order[k % n])).collect();
        (values, Self::new(n, n, vectors))
    }

    /// The largest element of self − other over the largest of `other`.
    pub fn distance(&self, other: &Self) -> f64 {
        let largest = |a: &Self| a.at.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        largest(&self.plus(-1.0, other)) / largest(other).max(1e-300)
    }
}

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
        let phi = Dense::new(p, n, phi);
        let y = (0..p)
            .map(|r| (0..n).map(|i| phi.get(r, i) * (1.0 + i as f64)).sum::<f64>() + 0.1 * random())
            .collect();
        (phi, Dense::new(p, 1, y))
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
        let theta = Dense::new(n, 1, vec![0.0; n]);
        Self { theta, covariance: Dense::scaled_identity(n, variance) }
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
pub fn estimator<T: Real, F: Forgetting<Dynamic<T>>>(
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
pub fn update<T: Real, F: Forgetting<Dynamic<T>>>(
    estimator: &mut Plain<F, T>,
    phi: &Dense,
    y: &Dense,
) -> usize {
    let convert = |x: &Dense| x.at.iter().map(|&x| T::from_f64(x)).collect::<Vec<T>>();
    let rank = estimator.update(&convert(phi), &convert(y)).unwrap().rank;
    assert!(estimator.is_sound());
    rank
}

/// θ and P of an estimator.
pub fn result<T: Real, F: Forgetting<Dynamic<T>>>(estimator: &Plain<F, T>) -> (Dense, Dense) {
    let n = estimator.prior().memory().parameters();
    let mut covariance = vec![T::ZERO; n * n];
    estimator.factor().reconstruct(&mut covariance);
    let convert = |x: &[T]| x.iter().map(|x| x.to_f64()).collect::<Vec<f64>>();
    (Dense::new(n, 1, convert(estimator.theta())), Dense::new(n, n, convert(&covariance)))
}

/// The largest distance of θ and P from a published form, which `step` advances by a sample.
pub fn worst<T: Real, F: Forgetting<Dynamic<T>>>(
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
