//! `constant_trace` against its published form, computed with dense matrices.

use crate::forms::{records, worst, Dense, Published};
use forgetting::rules::ConstantTrace;
use forgetting::{Dynamic, Kernels};

/// The published recursion; its P_k+1 is kept, its P₊ is what is compared.
fn step(
    level: f64,
    floor: f64,
    n: usize,
    variance: f64,
) -> impl FnMut(&mut Published, &Dense, &Dense) {
    let mut own = Dense::scaled_identity(n, variance);
    move |theirs, phi, y| {
        theirs.measure(&own, phi, y);
        let after = &theirs.covariance;
        let c1 = n as f64 * (level - floor);
        own = after.scaled(c1 / after.trace()).plus(floor, &Dense::scaled_identity(n, 1.0));
    }
}

fn rule<T: Kernels>(level: f64, floor: f64, n: usize, p: usize) -> ConstantTrace<Dynamic<T>> {
    let memory = Dynamic::<T>::new(n, p, 1).unwrap();
    ConstantTrace::new(T::from_f64(level), T::from_f64(floor), memory).unwrap()
}

/// Measured: 7e-12 in f64 and 5e-5 in f32, where P is ill-conditioned (level 10, floor 1e-4): the dense form's own.
const CLOSE: f64 = 1e-10;
const CLOSE_SINGLE: f64 = 1e-3;

#[test]
fn equals_the_published_form() {
    for (input, samples) in records(3, 200) {
        let (p, n) = (samples[0].0.rows, samples[0].0.columns);
        for (level, floor) in [(100.0, 0.01), (1.0, 0.5), (10.0, 1e-4)] {
            let found = worst(
                rule::<f64>(level, floor, n, p),
                1.0,
                5.0,
                &samples,
                step(level, floor, n, 5.0),
            );
            assert!(found < CLOSE, "{input:?} {n} {p} {level} {floor}: {found:e}");
            let found = worst(
                rule::<f32>(level, floor, n, p),
                1.0,
                5.0,
                &samples,
                step(level, floor, n, 5.0),
            );
            assert!(found < CLOSE_SINGLE, "{input:?} {n} {p} {level} {floor}: {found:e}");
        }
    }
}
