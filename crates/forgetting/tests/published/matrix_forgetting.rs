//! `matrix_forgetting` against (S1)–(S3), computed with dense matrices.

use crate::forms::{records, worst, Dense, Published};
use forgetting::rules::MatrixForgetting;
use forgetting::Dynamic;

const LAMBDA: f64 = 0.9;
const ALPHA: f64 = 0.2;

/// P̄⁻¹ = (I + M P) P⁻¹ with M = −(1 − λ)·product·P⁻¹, as printed.
fn forget(covariance: &Dense, power: i32, shift: Option<f64>) -> Dense {
    let one = Dense::scaled_identity(covariance.rows, 1.0);
    let information = covariance.inverse();
    let base = match shift {
        None => one.plus(-ALPHA, covariance),
        Some(shift) => {
            information.plus(-ALPHA, &one).times(&information.plus(shift, &one).inverse())
        }
    };
    let product = (0..power).fold(one, |product, _| product.times(&base));
    information.plus(LAMBDA - 1.0, &product.times(&information)).symmetric().inverse()
}

fn step(power: i32, shift: Option<f64>) -> impl FnMut(&mut Published, &Dense, &Dense) {
    move |theirs, phi, y| {
        let widened = forget(&theirs.covariance, power, shift);
        theirs.measure(&widened, phi, y);
    }
}

fn rule<T: forgetting::Kernels>(
    n: usize,
    p: usize,
    power: i32,
    shift: Option<f64>,
) -> MatrixForgetting<Dynamic<T>> {
    let memory = Dynamic::<T>::new(n, p, 1).unwrap();
    let rule = MatrixForgetting::new(T::from_f64(ALPHA), power as usize, memory).unwrap();
    match shift {
        None => rule,
        Some(shift) => rule.with_shift(T::from_f64(shift)).unwrap(),
    }
}

/// Measured: 6e-14 in f64 and 4e-6 in f32.
const CLOSE: f64 = 1e-12;
const CLOSE_SINGLE: f64 = 1e-4;

const FORMS: [(i32, Option<f64>); 5] =
    [(1, None), (3, None), (1, Some(0.5)), (3, Some(0.5)), (5, Some(0.0))];

#[test]
fn equals_the_published_form() {
    for (input, samples) in records(3, 200) {
        let (p, n) = (samples[0].0.rows, samples[0].0.columns);
        for (power, shift) in FORMS {
            let found =
                worst(rule::<f64>(n, p, power, shift), LAMBDA, 2.0, &samples, step(power, shift));
            assert!(found < CLOSE, "{input:?} {n} {p} {power} {shift:?}: {found:e}");
            let found =
                worst(rule::<f32>(n, p, power, shift), LAMBDA, 2.0, &samples, step(power, shift));
            assert!(found < CLOSE_SINGLE, "{input:?} {n} {p} {power} {shift:?}: {found:e}");
        }
    }
}
