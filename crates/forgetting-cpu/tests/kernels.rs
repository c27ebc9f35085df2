//! The kernels with fused multiply-add: right, and the same bits on every level.

#[path = "../../forgetting/tests/kernels/advance.rs"]
mod advance;
#[path = "../../forgetting/tests/kernels/against_dense.rs"]
mod against_dense;

use against_dense::{check, sizes};
use forgetting::Kernels;
use forgetting_cpu::{fused_numbers, level, Fused, Level, VARIABLE};
use forgetting_kernels::kernel::Portable;
use std::process::Command;

fused_numbers! {
    /// Fused numbers without vector instructions: what the others must agree with.
    pub Soft, with Portable
}

/// A hash of all results (FNV-1a), after they were compared with dense ones and with those of
/// samples one by one.
fn bits<Double: Kernels, Single: Kernels>() -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for n in advance::sizes() {
        let states = [advance::check::<Double>(n), advance::check::<Single>(n)];
        for x in states.concat() {
            hash = (hash ^ x).wrapping_mul(0x0100_0000_01b3);
        }
    }
    for seed in 0..4 {
        for n in sizes() {
            for x in check::<Double>(n, seed).into_iter().chain(check::<Single>(n, seed)) {
                hash = (hash ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
    hash
}

/// Comes before the result in the output, and in no name of a test: the result may follow that on one
/// line.
const MARK: &str = "with the instructions of ";

#[test]
fn this_level() {
    println!("{MARK}{:?} bits {:016x}", level(), bits::<Fused<f64>, Fused<f32>>());
}

#[test]
fn every_level_gives_the_same_bits() {
    let here = std::env::current_exe().unwrap();
    let run = |name: &str| {
        let mut test = Command::new(&here);
        let test = test.args(["this_level", "--exact", "--nocapture"]).env(VARIABLE, name);
        let output = test.output().unwrap();
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).unwrap();
        let line = text.lines().find_map(|line| line.split_once(MARK)).unwrap().1;
        line.split_once(" bits ").map(|(level, bits)| (level.to_owned(), bits.to_owned())).unwrap()
    };
    let (best, bits) = run("");
    assert_eq!(format!("{:016x}", self::bits::<Soft<f64>, Soft<f32>>()), bits, "{best}");
    for (name, level) in [("avx2", Level::Fused), ("avx512", Level::Wide)] {
        let (ran, got) = run(name);
        println!("{name}: {ran} {got}");
        assert_eq!(got, bits, "{name} beside {best}");
        assert!(ran == format!("{level:?}") || ran == best);
    }
}
