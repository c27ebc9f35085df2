//! Streams on several cores, all at once or, where that takes long, part by part.

#[cfg_attr(target_arch = "wasm32", path = "no_cores.rs")]
mod cores;
mod long;

use super::part::Part;
use crate::estimator::GoOn;
use crate::number::Number;
use forgetting::fleet::{Outputs, Samples};
use forgetting::Error;

/// Numbers of the state from which on a second core gains more than it costs to wake it.
const LARGE: usize = 1 << 19;
/// Shares for each core, so that one that is held up does not hold up the others.
const SHARES: usize = 4;
/// Numbers of the state from which on an update may take long enough, some 30 ms, to be asked
/// whether it goes on.
const LONG: usize = 1 << 24;
/// The same where a first sample costs a stream some fifty times as much as a later one.
const LONG_AT_FIRST: usize = 1 << 22;
/// Numbers of a part of such an update, and the most parts that there are.
const PART: usize = 1 << 16;
const MOST: usize = 512;

/// How an update is to be carried out.
pub struct Wishes<'a> {
    /// the threads; none for what suits the machine
    pub threads: Option<usize>,
    /// whether it goes on, where somebody can be asked
    pub go_on: Option<GoOn<'a>>,
}

/// How an update will be carried out.
pub struct Plan<'a> {
    /// how many parts of the streams
    pub parts: usize,
    /// in how many shares at the same time
    shares: usize,
    go_on: Option<GoOn<'a>>,
}

/// A part of the streams, its samples, where the results go, and what the streams were before.
struct Task<'a, T: Number, P: Part<T>> {
    part: P,
    samples: Samples<'a, T>,
    outputs: Outputs<'a, T>,
    before: Option<P::Before>,
}

impl<'a> Wishes<'a> {
    /// What is done with streams with so many numbers in all.
    pub fn plan(self, numbers: usize) -> Plan<'a> {
        self.plan_from(LONG, numbers)
    }

    /// The same where a first sample costs a stream some fifty times as much as a later one.
    pub fn plan_of_followers(self, numbers: usize) -> Plan<'a> {
        self.plan_from(LONG_AT_FIRST, numbers)
    }

    fn plan_from(self, long: usize, numbers: usize) -> Plan<'a> {
        let shares = shares(self.threads, numbers);
        match self.go_on.filter(|_| numbers >= long) {
            None => Plan { parts: shares, shares, go_on: None },
            go_on => Plan { parts: shares.max(MOST.min(numbers / PART)), shares, go_on },
        }
    }
}

impl Plan<'_> {
    /// Gives each part, of streams of n parameters, what is its own of samples and results; returns how
    /// many streams used their sample.
    ///
    /// # Errors
    /// That which ends it; the streams are as they were, bit for bit.
    pub fn update<'a, T: Number, P: Part<T>>(
        self,
        parts: impl Iterator<Item = P>,
        n: usize,
        (mut samples, mut outputs): (Samples<'a, T>, Outputs<'a, T>),
    ) -> Result<usize, Error> {
        let mut tasks = Vec::new();
        for part in parts {
            let (own_samples, own_outputs);
            (own_samples, samples) = samples.split_at(part.count(), n);
            (own_outputs, outputs) = outputs.split_at(part.count());
            tasks.push(Task { part, samples: own_samples, outputs: own_outputs, before: None });
        }
        match self.go_on {
            Some(go_on) => long::update(tasks, self.shares, go_on),
            None => Ok(take(&mut tasks, self.shares, Task::take)),
        }
    }
}

impl<T: Number, P: Part<T>> Task<'_, T, P> {
    /// Each stream takes its sample.
    fn take(&mut self) -> usize {
        self.part.update(self.samples, &mut self.outputs)
    }
}

/// The sum of what `work` returns for each task, in so many shares at the same time.
fn take<K: Send>(tasks: &mut [K], shares: usize, work: impl Fn(&mut K) -> usize + Sync) -> usize {
    let share = tasks.len().div_ceil(shares).max(1);
    if share >= tasks.len() {
        return tasks.iter_mut().map(work).sum();
    }
    cores::sum(tasks.chunks_mut(share).collect(), |tasks: &mut [K]| {
        tasks.iter_mut().map(&work).sum()
    })
}

/// Whether a sample for streams with so many numbers in all may take long.
pub fn is_long(numbers: usize) -> bool {
    numbers >= LONG
}

/// In how many shares streams with so many numbers in all are updated: in `threads` if that is
/// given, else in what suits the machine.
fn shares(threads: Option<usize>, numbers: usize) -> usize {
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
