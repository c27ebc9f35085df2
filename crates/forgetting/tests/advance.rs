//! Many samples in one go, on plain numbers.

mod advance_against_updates;

use advance_against_updates::{check, sizes};

#[test]
fn together_or_one_by_one_it_is_the_same() {
    for n in sizes() {
        check::<f64>(n);
        check::<f32>(n);
    }
}
