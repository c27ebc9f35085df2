//! What is deferred, beside dense covariances.

use super::{Deferred, Factor};
use crate::memory::Dynamic;
use alloc::vec;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// Numbers in (−1, 1), the same each time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// P as dense numbers of 64 bits: P ← c P + diag(q), then P ← P − g gᵀ/(1 + f g) with g = P fᵀ.
struct Dense(Vec<f64>, usize);

impl Dense {
    fn step(&mut self, c: f64, q: &[f64], f: &[f64]) {
        let n = self.1;
        self.0.iter_mut().for_each(|p| *p *= c);
        (0..n).for_each(|i| self.0[i * n + i] += q[i]);
        let g: Vec<f64> = self.0.chunks(n).map(|row| sum(row, f)).collect();
        let variance = 1.0 + sum(&g, f);
        for (k, p) in self.0.iter_mut().enumerate() {
            *p -= g[k / n] * g[k % n] / variance;
        }
    }
}

fn sum(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn deferring<T: Kernels>(n: usize) -> Factor<Dynamic<T>> {
    let mut factor = Factor::scalar(Dynamic::new(n, 1, 1).unwrap(), T::ONE).unwrap();
    factor.deferred = Deferred::zeros(factor.memory);
    factor
}

/// The largest difference of P from `dense`, each element over the standard deviations of its two
/// parameters.
fn distance<T: Kernels>(factor: &Factor<Dynamic<T>>, dense: &Dense) -> f64 {
    let n = dense.1;
    let mut own = vec![T::ZERO; n * n];
    factor.reconstruct(&mut own);
    let variance = |i: usize| dense.0[i * n + i];
    (0..n * n).fold(0.0, |most, k| {
        let scale = (variance(k / n) * variance(k % n)).sqrt();
        most.max((own[k].to_f64() - dense.0[k]).abs() / scale)
    })
}

/// 300 samples of which some are silent, with parameters in units that are `ratio` times one another at most.
fn is_exact<T: Kernels>(n: usize, ratio: f64, tolerance: f64) {
    let mut random = Random(n as u64);
    let unit: Vec<f64> = (0..n).map(|i| ratio.powf(i as f64 / n as f64 - 0.5)).collect();
    let q: Vec<f64> = unit.iter().map(|s| 0.01 * s * s).collect();
    let (mut factor, mut dense) = (deferring::<T>(n), Dense(vec![0.0; n * n], n));
    let scale: Vec<T> = unit.iter().map(|&s| T::from_f64(s)).collect();
    factor.scale_each(&scale);
    (0..n).for_each(|i| dense.0[i * n + i] = unit[i] * unit[i]);
    let (mut work, mut gain) = (vec![T::ZERO; n], vec![T::ZERO; n]);
    for k in 0..300 {
        let silent = (100..100 + 6 * n).contains(&k) || k % 7 == 0;
        let f: Vec<f64> = unit
            .iter()
            .map(|s| if silent { 0.0 } else { T::from_f64(random.next() / s).to_f64() })
            .collect();
        // once a long gap
        let steps = if k == 200 { 1e4 } else { 1.0 };
        let added: Vec<f64> = q.iter().map(|q| T::from_f64(q * steps).to_f64()).collect();
        let kept = T::from_f64(if k % 9 == 5 { 0.8 } else { 1.0 - 1e-3 });
        factor.shrink(kept);
        factor.reserve(T::ONE, T::from_f64(added.iter().sum())).unwrap();
        factor.defer_diagonal(|i| T::from_f64(added[i]), &mut work);
        let own: Vec<T> = f.iter().map(|&f| T::from_f64(f)).collect();
        factor.add_information(&own, &mut gain);
        dense.step(kept.to_f64(), &added, &f);
        let far = distance(&factor, &dense);
        assert!(far < tolerance, "{n} {ratio} {k}: {far}");
        assert!(factor.is_sound(), "{n} {ratio} {k}");
        let most = q.iter().enumerate().map(|(i, q)| factor.deferred.variance(i, n).to_f64() / q);
        let most = most.fold(0.0, f64::max);
        assert!(k >= 200 || most <= 5.0 * n as f64 + 1.0, "{n} {k}: {most}");
    }
    let settled = factor.settled();
    assert!(!settled.is_deferring() && distance(&settled, &dense) < tolerance);
}

#[test]
fn what_is_deferred_is_added_exactly() {
    for n in [2, 3, 8, 11, 16, 17, 24] {
        for ratio in [1.0, 1e6, 1e12] {
            is_exact::<f64>(n, ratio, 1e-11);
            is_exact::<f32>(n, ratio, 1e-3);
        }
    }
}

#[test]
fn nothing_along_what_was_exposed_is_left() {
    let n = 12;
    let (mut factor, mut random) = (deferring::<f64>(n), Random(1));
    let (mut work, mut a) = (vec![0.0; n], vec![0.0; n]);
    factor.defer_diagonal(|i| 1.0 + i as f64, &mut work);
    let before = factor.settled();
    for _ in 0..2 * n {
        let f: Vec<f64> = (0..n).map(|_| random.next()).collect();
        factor.expose(&f, &mut a);
        assert!(factor.deferred.leverage(&f).abs() < 1e-13);
        // again, and along it: nothing is left to move
        factor.expose(&f, &mut a);
    }
    let (mut own, mut expected) = (vec![0.0; n * n], vec![0.0; n * n]);
    factor.reconstruct(&mut own);
    before.reconstruct(&mut expected);
    assert!(own.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12));
    assert!(factor.is_sound() && factor.deferred.trace(n) < 1e-11);
}
