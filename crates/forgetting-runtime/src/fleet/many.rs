//! What every kind of streams can do with a sample each.

use super::streams::Streams;
use super::{estimators, threads};
use crate::number::Number;
use forgetting::fleet::{Outputs, Part, Samples};
use forgetting::Error;

/// Many streams.
pub trait Many<T: Number> {
    /// (count, n)
    fn shape(&self) -> [usize; 2];

    /// Takes a sample for each stream, on as many cores as `threads` says, `elapsed` after the last of
    /// each, or 1; returns how many streams used it.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for so many threads; none that a stream's own sample causes.
    fn update(
        &mut self,
        elapsed: Option<&[T]>,
        samples: Samples<'_, T>,
        outputs: Outputs<'_, T>,
        threads: Option<usize>,
    ) -> Result<usize, Error>;

    /// φθ of each stream.
    ///
    /// # Errors
    /// Those of [`Estimator::predict`](forgetting::Estimator::predict).
    fn predict(&self, phi: &[T], prediction: &mut [T]) -> Result<(), Error>;
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
        threads: Option<usize>,
    ) -> Result<usize, Error> {
        if let Some(elapsed) = elapsed {
            return update_after(self, elapsed, samples, outputs);
        }
        let [count, n] = self.shape();
        match self {
            Self::Blocks(fleet) => {
                let parts = fleet.parts(threads::parts(threads, count * n * (n + 3) / 2))?;
                let parts = parts.map(|part| (part.count(), part));
                let work = |mut part: Part<'_, T>,
                            samples: Samples<'_, T>,
                            mut outputs: Outputs<'_, T>| {
                    part.update(samples, &mut outputs)
                };
                Ok(threads::sum(parts, n, (samples, outputs), work))
            }
            Self::Estimators { each, .. } => {
                let parts = threads::parts(threads, count * n * (n + 3) * estimators::EFFORT);
                let parts = each.chunks_mut(count.div_ceil(parts).max(1));
                let parts = parts.map(|part| (part.len(), part));
                Ok(threads::sum(parts, n, (samples, outputs), |part, samples, mut outputs| {
                    estimators::update(part, T::ONE, samples, &mut outputs)
                }))
            }
        }
    }

    fn predict(&self, phi: &[T], prediction: &mut [T]) -> Result<(), Error> {
        match self {
            Self::Blocks(fleet) => fleet.predict(phi, prediction),
            Self::Estimators { each, .. } => estimators::predict(each, phi, prediction),
        }
    }
}

/// Takes a sample for each stream, so much time after its last one, stream by stream.
fn update_after<T: Number>(
    streams: &mut Streams<T>,
    elapsed: &[T],
    mut samples: Samples<'_, T>,
    mut outputs: Outputs<'_, T>,
) -> Result<usize, Error> {
    let (n, mut used) = (streams.parameters(), 0);
    for (i, &elapsed) in elapsed.iter().enumerate() {
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
