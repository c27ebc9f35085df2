//! Streams on several cores.

#[cfg_attr(target_arch = "wasm32", path = "no_cores.rs")]
mod cores;

use forgetting::fleet::{Outputs, Samples};
use forgetting::Real;

/// Numbers of the state from which on a second core gains more than it costs to wake it.
const LARGE: usize = 1 << 19;
/// Parts for each core, so that one that is held up does not hold up the others.
const SHARES: usize = 4;

/// In how many parts streams with so many numbers in all are updated: in `threads` if that is
/// given, else in what suits the machine.
pub fn parts(threads: Option<usize>, numbers: usize) -> usize {
    match threads {
        Some(1) => 1,
        _ if !cores::are_there() => 1,
        Some(threads) => threads,
        None if numbers < LARGE => 1,
        None => match cores::count() {
            1 => 1,
            count => SHARES * count,
        },
    }
}

/// Gives each part, of so many streams of n parameters, what is its own of samples and results;
/// returns the sum of what `work` returns.
pub fn sum<'a, T: Real, P: Send>(
    parts: impl Iterator<Item = (usize, P)>,
    n: usize,
    (mut samples, mut outputs): (Samples<'a, T>, Outputs<'a, T>),
    work: impl Fn(P, Samples<'a, T>, Outputs<'a, T>) -> usize + Sync + Send,
) -> usize {
    let mut tasks = Vec::new();
    for (count, part) in parts {
        let (own_samples, own_outputs);
        (own_samples, samples) = samples.split_at(count, n);
        (own_outputs, outputs) = outputs.split_at(count);
        tasks.push((part, own_samples, own_outputs));
    }
    let work = |(part, samples, outputs)| work(part, samples, outputs);
    match tasks.len() {
        0 | 1 => tasks.into_iter().map(work).sum(),
        _ => cores::sum(tasks, work),
    }
}
