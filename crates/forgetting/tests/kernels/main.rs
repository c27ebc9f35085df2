//! The kernels on plain numbers: one by one, and as many samples in one go use them.

mod advance;
mod against_dense;
mod long;

use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn double(seed in any::<u64>()) {
        for n in against_dense::sizes() {
            against_dense::check::<f64>(n, seed);
        }
    }

    #[test]
    fn single(seed in any::<u64>()) {
        for n in against_dense::sizes() {
            against_dense::check::<f32>(n, seed);
        }
    }
}

#[test]
fn together_or_one_by_one_it_is_the_same() {
    for n in advance::sizes() {
        advance::check::<f64>(n);
        advance::check::<f32>(n);
    }
}
