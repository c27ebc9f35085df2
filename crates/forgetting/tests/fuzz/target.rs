//! A fuzz target: cases without end, until one fails or the time is over.
#![allow(dead_code, reason = "each crate uses its share")]

use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed, TestRunner};
use std::time::{Duration, Instant};

/// Cases between two looks at the clock.
const BATCH: u32 = 64;

/// Checks cases of `strategy`: `cases` of them, always the same, or for as many seconds as
/// `FUZZ_SECONDS` says, with the seeds from `FUZZ_SEED` on. Prints a summary; a failure is shrunk,
/// printed, and kept in `proptest-regressions` for every later run.
pub fn fuzz<S: Strategy>(
    (name, source): (&str, &'static str),
    cases: u32,
    strategy: impl Fn() -> S,
    check: impl Fn(S::Value) + Copy,
) {
    let number = |name| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let limit = number("FUZZ_SECONDS").map(Duration::from_secs);
    let (start, first) = (Instant::now(), number("FUZZ_SEED").unwrap_or(1));
    let (mut seed, mut done) = (first, 0u64);
    loop {
        let batch = limit.map_or(cases, |_| BATCH);
        let config = ProptestConfig {
            cases: batch,
            rng_seed: RngSeed::Fixed(seed),
            source_file: Some(source),
            failure_persistence: Some(Box::new(FileFailurePersistence::SourceParallel(
                "proptest-regressions",
            ))),
            ..ProptestConfig::default()
        };
        let outcome = TestRunner::new(config).run(&strategy(), |case| {
            check(case);
            Ok(())
        });
        done += u64::from(batch);
        if let Err(failure) = outcome {
            panic!("fuzz {name}: 1 failure after {done} cases, seed {seed}\n{failure}");
        }
        if limit.is_none_or(|limit| start.elapsed() >= limit) {
            break;
        }
        seed += 1;
    }
    let seconds = start.elapsed().as_secs_f64();
    println!("fuzz {name}: 0 failures in {done} cases, {seconds:.0} s, seeds {first} to {seed}");
}

/// Numbers of every size, and now and then none.
pub fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -10.0..10.0,
        3 => sized(-320.0..308.0),
        4 => sized(-75.0..75.0),
        1 => Just(0.0),
        1 => -1e-3..1e-3,
        1 => prop_oneof![
            Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY), Just(5e-324), Just(f64::MAX)
        ],
    ]
}

/// ±10^x for x in `exponents`.
fn sized(exponents: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    (exponents, any::<bool>()).prop_map(|(exponent, positive)| {
        let size = 10f64.powf(exponent);
        if positive {
            size
        } else {
            -size
        }
    })
}
