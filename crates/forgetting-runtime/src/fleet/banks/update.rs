//! Samples of streams that are banks.

use super::Banks;
use crate::estimator::GoOn;
use crate::fleet::many::Many;
use crate::fleet::numbers::{copy, load, store};
use crate::fleet::one_by_one::{nothing, one_by_one, outcome, Outcome};
use crate::fleet::part;
use crate::fleet::threads::Wishes;
use crate::missing::is_missing;
use crate::number::Number;
use forgetting::bank::Bank;
use forgetting::fleet::{Outputs, Samples, REFUSED};
use forgetting::{Error, Noise, Skip};

/// How much more a number of the state costs here than in a block of lanes.
const EFFORT: usize = 4;

impl<T: Number> Many<T> for Banks<T> {
    fn shape(&self) -> [usize; 2] {
        [self.count, self.parameters()]
    }

    fn update(
        &mut self,
        elapsed: Option<&[T]>,
        samples: Samples<'_, T>,
        outputs: Outputs<'_, T>,
        wishes: Wishes<'_>,
    ) -> Result<usize, Error> {
        let (n, (numbers, counts)) = (self.parameters(), self.widths());
        let plan = wishes.plan(self.count * numbers * EFFORT);
        let streams = self.count.div_ceil(plan.parts).max(1);
        self.workers.resize_with(self.count.div_ceil(streams), || self.fresh.clone());
        let states = self.numbers.chunks_mut(streams * numbers);
        let states = states.zip(self.counts.chunks_mut(streams * counts));
        let parts = self.workers.iter_mut().zip(states).enumerate();
        let parts = parts.map(|(part, (bank, (numbers, counts)))| {
            let elapsed = elapsed.map(|elapsed| &elapsed[part * streams..]);
            let widths = (self.start.0.len(), self.start.1.len());
            Part { bank, numbers, counts, widths, elapsed }
        });
        plan.update(parts, n, (samples, outputs))
    }

    fn predict(&self, phi: &[T], prediction: &mut [T], go_on: GoOn<'_>) -> Result<(), Error> {
        let n = self.parameters();
        self.try_each(go_on, |i, bank| {
            bank.predict(&phi[i * n..(i + 1) * n], &mut prediction[i..=i])
        })
    }
}

/// Some streams, and the bank that takes their samples.
struct Part<'a, T: Number> {
    bank: &'a mut Bank<T>,
    numbers: &'a mut [T],
    counts: &'a mut [u64],
    /// numbers and counts of a stream
    widths: (usize, usize),
    /// since the last sample of each; 1 if not given
    elapsed: Option<&'a [T]>,
}

impl<T: Number> Part<'_, T> {
    /// One stream's sample.
    fn take(&mut self, i: usize, phi: &[T], y: &[T]) -> Outcome<T> {
        if is_missing(phi, y) {
            return nothing(Skip::Missing.code());
        }
        let Self { bank, numbers, counts, widths, elapsed } = self;
        let numbers = &mut numbers[i * widths.0..(i + 1) * widths.0];
        let counts = &mut counts[i * widths.1..(i + 1) * widths.1];
        load(bank, (numbers, counts));
        let elapsed = elapsed.map_or(T::ONE, |elapsed| elapsed[i]);
        let told = match bank.update_after(elapsed, phi, y, Noise::Unit) {
            Ok(update) => outcome(update.error, update.leverage, update.skipped),
            Err(_) => return nothing(REFUSED),
        };
        store(bank, (numbers, counts));
        told
    }
}

impl<T: Number> part::Part<T> for Part<'_, T> {
    type Before = (Vec<T>, Vec<u64>);

    fn count(&self) -> usize {
        self.numbers.len() / self.widths.0
    }

    fn update(&mut self, samples: Samples<'_, T>, outputs: &mut Outputs<'_, T>) -> usize {
        one_by_one(samples, outputs, |i, phi, y| self.take(i, phi, y))
    }

    fn before(&mut self) -> Result<Self::Before, Error> {
        Ok((copy(self.numbers)?, copy(self.counts)?))
    }

    fn put_back(&mut self, (numbers, counts): &Self::Before) {
        self.numbers.copy_from_slice(numbers);
        self.counts.copy_from_slice(counts);
    }
}
