//! Streams that are an estimator each: any rule, rate and weighting.

use super::one_by_one::{nothing, one_by_one, outcome, Outcome};
use crate::missing::is_missing;
use crate::number::Number;
use forgetting::fleet::{Outputs, Samples, REFUSED};
use forgetting::{AnyEstimator, Error, Noise, Skip};

/// How much more a number of the state costs here than in a block of lanes.
pub const EFFORT: usize = 8;

/// Takes a sample for each stream, so much time after its last one; returns how many used it. See
/// [`Part::update`](forgetting::fleet::Part::update).
pub fn update<T: Number>(
    streams: &mut [AnyEstimator<T>],
    elapsed: T,
    samples: Samples<'_, T>,
    outputs: &mut Outputs<'_, T>,
) -> usize {
    one_by_one(samples, outputs, |i, phi, y| take(&mut streams[i], elapsed, phi, y))
}

/// One stream's sample.
fn take<T: Number>(estimator: &mut AnyEstimator<T>, elapsed: T, phi: &[T], y: &[T]) -> Outcome<T> {
    if is_missing(phi, y) {
        return nothing(Skip::Missing.code());
    }
    match estimator.update_after(elapsed, phi, y, Noise::Unit) {
        Ok(update) => outcome(update.error, update.leverage, update.skipped),
        Err(_) => nothing(REFUSED),
    }
}

/// φθ of each stream.
///
/// # Errors
/// Those of [`Estimator::predict`](forgetting::Estimator::predict).
pub fn predict<T: Number>(
    streams: &[AnyEstimator<T>],
    phi: &[T],
    prediction: &mut [T],
) -> Result<(), Error> {
    let n = phi.len() / streams.len().max(1);
    let each = phi.chunks_exact(n).zip(prediction.chunks_exact_mut(1));
    streams.iter().zip(each).try_for_each(|(stream, (phi, y))| stream.predict(phi, y))
}
