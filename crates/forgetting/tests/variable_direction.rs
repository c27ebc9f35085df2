//! `variable_direction` against the published form, computed with dense matrices.

mod dense_forms;

use dense_forms::{estimator, record, result, update, Dense, Input, Published, INPUTS};
use forgetting::rules::VariableDirection;
use forgetting::{Dynamic, Real};

const LAMBDA: f64 = 0.95;
const VARIANCE: f64 = 10.0;

/// (64)–(71) of the tutorial with the transposes of (70) restored, P̄ by an explicit
/// eigen-decomposition of R; inside clusters by the singular vectors of φU_c.
fn forget(covariance: &Dense, phi: &Dense, threshold: f64, lambda: f64, epsilon: f64) -> Dense {
    let n = covariance.rows;
    let (values, vectors) = covariance.inverse().eigen();
    let mut widened = covariance.clone();
    let mut start = 0;
    while start < n {
        let mut end = start + 1;
        while end < n && values[end] - values[end - 1] <= epsilon.sqrt() * values[end] {
            end += 1;
        }
        let basis = columns(&vectors, start..end);
        let psi = phi.times(&basis);
        let (squares, turn) = psi.transpose().times(&psi).eigen();
        for (j, square) in squares.iter().enumerate() {
            if square.max(0.0).sqrt() > threshold {
                let q = basis.times(&columns(&turn, j..j + 1));
                let variance = q.transpose().times(&covariance.times(&q)).get(0, 0);
                let weight = variance * (1.0 - lambda) / lambda;
                widened = widened.plus(weight, &q.times(&q.transpose()));
            }
        }
        start = end;
    }
    widened
}

fn columns(a: &Dense, range: std::ops::Range<usize>) -> Dense {
    let width = range.len();
    let at = (0..a.rows * width).map(|k| a.get(k / width, range.start + k % width)).collect();
    Dense::new(a.rows, width, at)
}

/// The largest distance of θ and P from the published form over a record.
fn compare<T: Real>(input: Input, n: usize, p: usize, threshold: f64, samples: usize) -> f64 {
    let memory = Dynamic::<T>::new(n, p, 1).unwrap();
    let rule = VariableDirection::new(T::from_f64(threshold)).unwrap();
    let mut ours = estimator(rule, LAMBDA, memory, VARIANCE);
    let mut theirs = Published::new(n, VARIANCE);
    let mut worst = 0.0f64;
    for (phi, y) in record(input, samples, n, p) {
        update(&mut ours, &phi, &y);
        let epsilon = T::EPSILON.to_f64();
        let widened = forget(&theirs.covariance, &phi, threshold, LAMBDA, epsilon);
        theirs.measure(&widened, &phi, &y);
        let (theta, covariance) = result(&ours);
        worst = worst.max(theta.distance(&theirs.theta));
        worst = worst.max(covariance.distance(&theirs.covariance));
    }
    worst
}

#[test]
fn equals_the_published_form() {
    for input in INPUTS {
        for n in [1, 2, 4, 8] {
            for p in [1, 2, 3] {
                for threshold in [1e-3, 0.3] {
                    let found = compare::<f64>(input, n, p, threshold, 300);
                    println!("{input:?} {n} {p} {threshold} {found:e}");
                }
            }
        }
    }
}
