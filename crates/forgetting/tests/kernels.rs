//! The kernels on plain numbers.

mod kernels_against_dense;

use kernels_against_dense::{check, sizes};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn double(seed in any::<u64>()) {
        for n in sizes() {
            check::<f64>(n, seed);
        }
    }

    #[test]
    fn single(seed in any::<u64>()) {
        for n in sizes() {
            check::<f32>(n, seed);
        }
    }
}
