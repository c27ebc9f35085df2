//! `multiple` against its published form, computed with dense matrices.

use crate::forms::{estimator, record, records, result, update, worst, Dense, Input, Published};
use forgetting::rules::Multiple;
use forgetting::{Constant, Dynamic, Equal, Estimator, Kernels, Prior};

/// R̄ = blkdiag(λ_b R_bb)
fn forget(information: &Dense, factors: &[f64], blocks: &[usize]) -> Dense {
    let n = information.rows;
    let mut block_of = Vec::new();
    for (b, &size) in blocks.iter().enumerate() {
        block_of.extend(vec![b; size]);
    }
    let element = |i: usize, j: usize| {
        let kept = if block_of[i] == block_of[j] { factors[block_of[i]] } else { 0.0 };
        kept * information.at(i, j)
    };
    Dense::new(n, &(0..n * n).map(|k| element(k / n, k % n)).collect::<Vec<f64>>())
}

fn step(factors: Vec<f64>, blocks: Vec<usize>) -> impl FnMut(&mut Published, &Dense, &Dense) {
    move |theirs, phi, y| {
        let kept = forget(&theirs.covariance.inverse(), &factors, &blocks);
        theirs.measure(&kept.inverse(), phi, y);
    }
}

fn rule<T: Kernels>(factors: &[f64], blocks: &[usize], p: usize) -> Multiple<Dynamic<T>> {
    let memory = Dynamic::<T>::new(blocks.iter().sum(), p, 1).unwrap();
    let factors: Vec<T> = factors.iter().map(|&x| T::from_f64(x)).collect();
    Multiple::new(&factors, blocks, memory).unwrap()
}

/// Measured: 8e-12 in f64 and 7e-6 in f32, of which most is the dense form's inverse.
const CLOSE: f64 = 1e-10;
const CLOSE_SINGLE: f64 = 1e-4;

fn partitions(n: usize) -> Vec<Vec<usize>> {
    let mut all = vec![vec![1; n], vec![n]];
    if n > 2 {
        all.push(vec![n - 3, 3]);
        all.push(vec![1, n - 2, 1]);
    }
    all
}

#[test]
fn equals_the_published_form() {
    for (input, samples) in records(3, 200) {
        let (p, n) = (samples[0].0.rows, samples[0].0.columns);
        for blocks in partitions(n) {
            let factors: Vec<f64> = (0..blocks.len()).map(|b| 0.99 - 0.01 * b as f64).collect();
            let found = worst(
                rule::<f64>(&factors, &blocks, p),
                1.0,
                5.0,
                &samples,
                step(factors.clone(), blocks.clone()),
            );
            assert!(found < CLOSE, "{input:?} {n} {p} {blocks:?}: {found:e}");
            let found = worst(
                rule::<f32>(&factors, &blocks, p),
                1.0,
                5.0,
                &samples,
                step(factors.clone(), blocks.clone()),
            );
            assert!(found < CLOSE_SINGLE, "{input:?} {n} {p} {blocks:?}: {found:e}");
        }
    }
}

/// (75)–(78) as printed, for two parameters and one row.
#[test]
fn equals_the_printed_equations_for_two_parameters() {
    let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
    let mut ours = estimator(rule::<f64>(&[0.9, 0.97], &[1, 1], 1), 1.0, memory, 4.0);
    let (mut r, mut theta) = ([0.25, 0.25], [0.0, 0.0]);
    for (phi, y) in record(Input::Exciting, 100, 2, 1) {
        update(&mut ours, &phi, &y);
        let (f, lambda) = (&phi.elements, [0.9, 0.97]);
        let error = y.elements[0] - f[0] * theta[0] - f[1] * theta[1];
        let share = [f[0] / (lambda[0] * r[0]), f[1] / (lambda[1] * r[1])];
        let total = 1.0 + f[0] * share[0] + f[1] * share[1];
        for i in 0..2 {
            theta[i] += share[i] / total * error;
            r[i] = lambda[i] * r[i] + f[i] * f[i];
        }
        assert!(result(&ours).0.distance(&Dense::new(2, &theta)) < 1e-13);
    }
}

/// A prior with correlations: R₀'s blocks are kept, not P₀'s.
#[test]
fn starts_from_the_blocks_of_the_information() {
    let prior = Dense::new(3, &[2.0, 0.9, 0.3, 0.9, 1.0, -0.2, 0.3, -0.2, 0.7]);
    let memory = Dynamic::<f64>::new(3, 1, 1).unwrap();
    for blocks in [vec![1, 1, 1], vec![1, 2], vec![2, 1], vec![3]] {
        let factors = vec![0.95; blocks.len()];
        let start = Prior::dense(memory, &prior.elements).unwrap();
        let rule = rule::<f64>(&factors, &blocks, 1);
        let mut ours = Estimator::new(rule, Constant::new(1.0).unwrap(), Equal::new(), start);
        let mut theirs = Published::new(3, 1.0);
        theirs.covariance = prior.clone();
        let mut step = step(factors, blocks);
        for (phi, y) in record(Input::Exciting, 20, 3, 1) {
            update(&mut ours, &phi, &y);
            step(&mut theirs, &phi, &y);
            assert!(result(&ours).1.distance(&theirs.covariance) < 1e-13);
        }
    }
}
