//! Streams that take their samples one after the other.

use crate::number::Number;
use forgetting::fleet::{Outputs, Samples};
use forgetting::Skip;

/// Error, leverage and code of a sample.
pub type Outcome<T> = (T, T, u8);

/// Lets each stream `take` its number, φ and y, unless the mask says that it has none, and writes what
/// came of them; returns how many used theirs. See [`Part::update`](forgetting::fleet::Part::update).
pub fn one_by_one<T: Number>(
    samples: Samples<'_, T>,
    outputs: &mut Outputs<'_, T>,
    mut take: impl FnMut(usize, &[T], &[T]) -> Outcome<T>,
) -> usize {
    let n = samples.phi.len() / samples.y.len().max(1);
    let mut used = 0;
    for (i, y) in samples.y.iter().enumerate() {
        let (error, leverage, code) = match samples.mask.is_none_or(|mask| mask[i]) {
            true => take(i, &samples.phi[i * n..(i + 1) * n], std::slice::from_ref(y)),
            false => nothing(Skip::Missing.code()),
        };
        used += usize::from(code == 0);
        put(&mut outputs.error, i, error);
        put(&mut outputs.leverage, i, leverage);
        put(&mut outputs.skipped, i, code);
    }
    used
}

/// Of a sample that was taken, or left out for a reason of the rule's or the gate's.
pub fn outcome<T: Number>(error: &[T], leverage: T, skipped: Option<Skip>) -> Outcome<T> {
    (error[0], leverage, skipped.map_or(0, Skip::code))
}

/// Of no sample, or one that was refused.
pub fn nothing<T: Number>(code: u8) -> Outcome<T> {
    let nan = T::from_f64(f64::NAN);
    (nan, nan, code)
}

fn put<T>(numbers: &mut Option<&mut [T]>, index: usize, number: T) {
    if let Some(numbers) = numbers {
        numbers[index] = number;
    }
}
