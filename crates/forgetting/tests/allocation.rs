//! An update allocates nothing, whatever the rule.

use forgetting::choice::{Defaults, Kind, Value, Values};
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
    /// bytes in use now, and the most so far
    static BYTES: Cell<(isize, isize)> = const { Cell::new((0, 0)) };
}

fn note(bytes: isize) {
    let (now, most) = BYTES.with(Cell::get);
    BYTES.with(|cell| cell.set((now + bytes, most.max(now + bytes))));
}

// SAFETY: every call is the system allocator's; counting changes nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        note(layout.size() as isize);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        note(-(layout.size() as isize));
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

/// The most bytes that are in use at once while `work` makes something.
fn peak<X>(work: impl FnOnce() -> X) -> isize {
    BYTES.with(|cell| cell.set((0, 0)));
    let made = work();
    let (_, most) = BYTES.with(Cell::get);
    drop(made);
    most
}

/// What is asked for before an estimator is made, so that there is an error and no abort, is what
/// making it takes: not less, and not many times as much.
#[test]
fn the_room_that_is_asked_for_is_the_room_that_is_taken() {
    const N: usize = 300;
    let square = (N * N * 8) as isize;
    let inner = |name: &str| RULES.iter().find(|about| about.name == name).unwrap().squares;
    for about in RULES {
        for around in ["none", "matrix_forgetting"] {
            let is_around = about.parameters.iter().any(|p| p.kind == Kind::Rule);
            if !is_around && around != "none" {
                continue;
            }
            struct Around<'a>(&'a str, bool);
            impl Values for Around<'_> {
                fn get(&self, name: &str) -> Option<Value<'_>> {
                    (self.1 && name == "rule").then_some(Value::Word(self.0))
                }
            }
            let memory = Dynamic::<f64>::new(N, 1, 1).unwrap();
            let given = Around(around, is_around);
            let most = peak(|| {
                let rule = Rule::named(about.name, &given, memory).ok()?;
                let rate = AnyRate::named("constant", &Defaults, memory).unwrap();
                Some(Estimator::new(rule, rate, Equal::new(), Prior::scalar(memory, 10.0).unwrap()))
            });
            let squares = about.squares + if is_around { inner(around) } else { 0 };
            let asked = (squares + 1) as isize * square;
            let name = about.name;
            assert!(most < asked, "{name}: {most} bytes of {asked}");
            if most > square / 2 {
                assert!(3 * most > asked, "{name}: {most} bytes of {asked}");
            }
        }
    }
}
