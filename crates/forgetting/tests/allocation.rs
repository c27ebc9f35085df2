//! An update allocates nothing, whatever the rule.

use forgetting::choice::Defaults;
use forgetting::gates::{AnyGate, GATES};
use forgetting::rates::{AnyRate, RATES};
use forgetting::rules::{Rule, RULES};
use forgetting::weightings::{AnyWeighting, WEIGHTINGS};
use forgetting::{Dynamic, Equal, Estimator, Exponential, Noise, Prior};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call is the system allocator's; counting changes nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.with(Cell::get);
    work();
    ALLOCATIONS.with(Cell::get) - before
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(|| drop(std::hint::black_box(Box::new(1)))), 1);
}

#[test]
fn an_update_allocates_nothing() {
    for about in RULES {
        let rows = about.largest_rows.unwrap_or(2).min(2);
        let memory = Dynamic::<f64>::new(4, rows, 3).unwrap();
        let Ok(rule) = Rule::named(about.name, &Defaults, memory) else {
            continue; // a rule that is made from a function of the user's
        };
        let rate = AnyRate::named("constant", &Defaults, memory).unwrap();
        let prior = Prior::scalar(memory, 10.0).unwrap();
        let mut estimator = Estimator::new(rule, rate, Equal::new(), prior);
        let gamma = [2.0, 0.5, 0.5, 1.0];
        let noise = if rows == 2 { Noise::Full(&gamma) } else { Noise::Scalar(2.0) };
        let count = allocations(|| {
            for k in 0..50 {
                let phi: [f64; 8] = std::array::from_fn(|i| ((k * 8 + i) as f64).sin());
                let y = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
                let (phi, y) = (&phi[..rows * 4], &y[..rows * 3]);
                estimator.update_with_noise(phi, y, noise).unwrap();
            }
        });
        assert_eq!(count, 0, "{}", about.name);
    }
}

#[test]
fn no_rate_and_no_weighting_allocates() {
    let memory = Dynamic::<f64>::new(4, 2, 3).unwrap();
    for rate in RATES {
        let Ok(rate) = AnyRate::named(rate.name, &Defaults, memory) else {
            continue; // one that is made from a function of the user's
        };
        for weighting in WEIGHTINGS {
            let weighting = AnyWeighting::named(weighting.name, &Defaults, memory).unwrap();
            let prior = Prior::scalar(memory, 10.0).unwrap();
            let rate = rate.clone();
            let mut estimator = Estimator::new(Exponential::new(), rate, weighting, prior);
            let count = allocations(|| {
                for k in 0..150 {
                    let phi: [f64; 8] = std::array::from_fn(|i| ((k * 8 + i) as f64).sin());
                    estimator.update(&phi, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).unwrap();
                }
            });
            assert_eq!(count, 0, "{:?}", estimator.rate());
        }
    }
}

#[test]
fn no_gate_and_nothing_that_is_kept_allocates() {
    let memory = Dynamic::<f64>::new(4, 2, 3).unwrap();
    for about in GATES {
        let Ok(gate) = AnyGate::named(about.name, &Defaults, memory) else {
            continue; // one that is made from a function of the user's
        };
        let rule = Rule::named("subspace", &Defaults, memory).unwrap();
        let rate = AnyRate::named("constant", &Defaults, memory).unwrap();
        let prior = Prior::scalar(memory, 10.0).unwrap();
        let mut estimator = Estimator::new(rule, rate, Equal::new(), prior).with_gate(gate);
        estimator.enable_monitor();
        estimator.keep_prior(true);
        estimator.keep_innovations(true);
        let mut whitened = [0.0; 6];
        let count = allocations(|| {
            for k in 0..150 {
                let phi: [f64; 8] = std::array::from_fn(|i| ((k * 8 + i) as f64).sin());
                let update = estimator.update(&phi, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).unwrap();
                update.whiten(&mut whitened).unwrap();
            }
        });
        assert_eq!(count, 0, "{}", about.name);
    }
}
