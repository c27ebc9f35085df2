//! Streams that are an estimator each: any rule, rate and weighting.

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
    let n = samples.phi.len() / streams.len().max(1);
    let mut used = 0;
    for (i, estimator) in streams.iter_mut().enumerate() {
        let (phi, y) = (&samples.phi[i * n..(i + 1) * n], &samples.y[i..=i]);
        let (error, leverage, code) = match samples.mask.is_none_or(|mask| mask[i]) {
            true => take(estimator, elapsed, phi, y),
            false => nothing(Skip::Missing.code()),
        };
        used += usize::from(code == 0);
        put(&mut outputs.error, i, error);
        put(&mut outputs.leverage, i, leverage);
        put(&mut outputs.skipped, i, code);
    }
    used
}

/// One stream's sample.
fn take<T: Number>(estimator: &mut AnyEstimator<T>, elapsed: T, phi: &[T], y: &[T]) -> (T, T, u8) {
    if is_missing(phi, y) {
        return nothing(Skip::Missing.code());
    }
    match estimator.update_after(elapsed, phi, y, Noise::Unit) {
        Ok(update) => (update.error[0], update.leverage, update.skipped.map_or(0, Skip::code)),
        Err(_) => nothing(REFUSED),
    }
}

fn nothing<T: Number>(code: u8) -> (T, T, u8) {
    let nan = T::from_f64(f64::NAN);
    (nan, nan, code)
}

fn put<T>(numbers: &mut Option<&mut [T]>, index: usize, number: T) {
    if let Some(numbers) = numbers {
        numbers[index] = number;
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

/// The largest and the smallest element of D of each stream.
pub fn extremes<T: Number>(streams: &[AnyEstimator<T>], largest: &mut [T], smallest: &mut [T]) {
    let places = largest.iter_mut().zip(smallest);
    for (stream, (largest, smallest)) in streams.iter().zip(places) {
        (*largest, *smallest) = (stream.factor().largest(), stream.factor().smallest());
    }
}
