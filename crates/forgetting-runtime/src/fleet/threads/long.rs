//! An update that may take long: part by part, and between them it asks whether to go on.
//!
//! If not, what is done is undone: of each part that was taken there is a copy. The copies would cost a
//! fast update a good part of its time. So once some parts, from all over the fleet, have shown that little
//! time is left, the others are taken without, and nothing is asked any more.

use super::{take, Task};
use crate::estimator::GoOn;
use crate::fleet::part::Part;
use crate::number::Number;
use forgetting::Error;
use std::time::{Duration, Instant};

/// Time between two questions.
const INTERVAL: Duration = Duration::from_millis(50);
/// So much time may pass at the end without a question.
const QUIET: Duration = Duration::from_millis(200);
/// So many parts tell how long the others will take.
const SAMPLE: usize = 4;

/// Takes the samples of all parts, in so many shares at the same time; returns how many streams used
/// theirs.
///
/// # Errors
/// That of `go_on`; the streams are as they were, bit for bit.
pub fn update<T: Number, P: Part<T>>(
    mut tasks: Vec<Task<'_, T, P>>,
    shares: usize,
    go_on: GoOn<'_>,
) -> Result<usize, Error> {
    spread(&mut tasks);
    let (start, all) = (Instant::now(), tasks.len());
    let (mut done, mut used) = (0, 0);
    while done < all {
        let (taken, rest) = tasks.split_at_mut(done);
        if let Err(error) = go_on() {
            take(taken, shares, Task::undo);
            return Err(error);
        }
        let each = start.elapsed() / done.max(1) as u32;
        let little = done >= SAMPLE && each * rest.len() as u32 <= QUIET;
        if little || taken.iter().any(|task| task.before.is_none()) {
            return Ok(used + take(rest, shares, Task::take));
        }
        let next = next(done, each).max(shares).min(rest.len());
        used += take(&mut rest[..next], shares, Task::take_with_copy);
        done += next;
    }
    Ok(used)
}

/// Puts the parts into an order in which any first few of them are from all over the fleet.
fn spread<K>(tasks: &mut Vec<K>) {
    let mut numbered: Vec<_> = std::mem::take(tasks).into_iter().enumerate().collect();
    numbered.sort_by_key(|(place, _)| place.reverse_bits());
    tasks.extend(numbered.into_iter().map(|(_, task)| task));
}

/// How many parts to take before the next question: at most as many as are done.
fn next(done: usize, each: Duration) -> usize {
    let fit = INTERVAL.as_nanos() / each.as_nanos().max(1);
    done.min(usize::try_from(fit).unwrap_or(done))
}

impl<T: Number, P: Part<T>> Task<'_, T, P> {
    /// The same as [`Task::take`], with a copy of what was before, where there is memory for one.
    fn take_with_copy(&mut self) -> usize {
        self.before = self.part.before().ok();
        self.take()
    }

    /// Makes the streams what they were; none of them then has used its sample.
    fn undo(&mut self) -> usize {
        if let Some(before) = &self.before {
            self.part.put_back(before);
        }
        0
    }
}
