//! What every kind of streams can do with a sample each.

use super::estimators;
use super::streams::Streams;
use super::threads::{is_long, Wishes};
use crate::configure::check_copies;
use crate::estimator::record::{GoOn, Pause};
use crate::number::Number;
use forgetting::fleet::{Outputs, Samples};
use forgetting::Error;

/// Many streams.
pub trait Many<T: Number> {
    /// (count, n)
    fn shape(&self) -> [usize; 2];

    /// Takes a sample for each stream, `elapsed` after the last of each, or 1; returns how many streams
    /// used it.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for so many threads, and that with which the update ends; none
    /// that a stream's own sample causes. Nothing has changed.
    fn update(
        &mut self,
        elapsed: Option<&[T]>,
        samples: Samples<'_, T>,
        outputs: Outputs<'_, T>,
        wishes: Wishes<'_>,
    ) -> Result<usize, Error>;

    /// φθ of each stream.
    ///
    /// # Errors
    /// Those of [`Estimator::predict`](forgetting::Estimator::predict), and that of `go_on`.
    fn predict(&self, phi: &[T], prediction: &mut [T], go_on: GoOn<'_>) -> Result<(), Error>;
}

impl<T: Number> Many<T> for Streams<T> {
    fn shape(&self) -> [usize; 2] {
        [self.count(), self.parameters()]
    }

    fn update(
        &mut self,
        elapsed: Option<&[T]>,
        samples: Samples<'_, T>,
        outputs: Outputs<'_, T>,
        wishes: Wishes<'_>,
    ) -> Result<usize, Error> {
        let [count, n] = self.shape();
        if let Some(elapsed) = elapsed {
            return update_after(self, elapsed, samples, outputs, wishes);
        }
        match self {
            Self::Blocks(fleet) => {
                let numbers = count * n * (n + 3) / 2;
                let plan = match fleet.follows_data() {
                    true => wishes.plan_of_followers(numbers),
                    false => wishes.plan(numbers),
                };
                let parts = fleet.parts(plan.parts)?;
                plan.update(parts, n, (samples, outputs))
            }
            Self::Estimators { each, .. } => {
                let plan = wishes.plan(count * n * (n + 3) * estimators::EFFORT);
                let parts = each.chunks_mut(count.div_ceil(plan.parts).max(1));
                plan.update(parts, n, (samples, outputs))
            }
        }
    }

    fn predict(&self, phi: &[T], prediction: &mut [T], go_on: GoOn<'_>) -> Result<(), Error> {
        Self::predict(self, phi, prediction, go_on)
    }
}

/// Takes a sample for each stream, so much time after its last one, stream by stream. Where that may take
/// long there is a copy of all, to go back to.
fn update_after<T: Number>(
    streams: &mut Streams<T>,
    elapsed: &[T],
    samples: Samples<'_, T>,
    outputs: Outputs<'_, T>,
    wishes: Wishes<'_>,
) -> Result<usize, Error> {
    let [count, n] = streams.shape();
    let is_long = is_long(count * n * (n + 3) * estimators::EFFORT);
    let is_room = || check_copies(streams.fresh(), count).is_ok();
    match wishes.go_on.filter(|_| is_long && is_room()) {
        None => one_after_the_other(streams, elapsed, samples, outputs, &mut || Ok(())),
        Some(go_on) => {
            let before = streams.copy(go_on)?;
            one_after_the_other(streams, elapsed, samples, outputs, go_on)
                .inspect_err(|_| *streams = before)
        }
    }
}

fn one_after_the_other<T: Number>(
    streams: &mut Streams<T>,
    elapsed: &[T],
    mut samples: Samples<'_, T>,
    mut outputs: Outputs<'_, T>,
    go_on: GoOn<'_>,
) -> Result<usize, Error> {
    let (n, mut used) = (streams.parameters(), 0);
    let mut pause = Pause::new(go_on, 1, n);
    for (i, &elapsed) in elapsed.iter().enumerate() {
        pause.after(1)?;
        let (sample, mut output);
        (sample, samples) = samples.split_at(1, n);
        (output, outputs) = outputs.split_at(1);
        let mut stream = [streams.get(i)];
        used += estimators::update(&mut stream, elapsed, sample, &mut output);
        let [stream] = stream;
        streams.put(i, stream)?;
    }
    Ok(used)
}
