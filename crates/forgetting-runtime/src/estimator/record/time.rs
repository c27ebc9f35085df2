//! The times of a record's samples.

use super::shapes::Sizes;
use crate::error::Error;
use crate::number::View;
use crate::shape::either;
use forgetting::Real;
use std::borrow::Cow;

/// When each sample was taken, in units of time in which forgetting is stated.
pub(crate) struct RecordTime<'a> {
    times: Cow<'a, [f64]>,
    /// of the last sample that was not missing, if that is known
    last: Option<f64>,
    /// where the first sample is in `times`
    first: usize,
}

impl<'a> RecordTime<'a> {
    /// Times of T samples, with or without that of the one before them.
    ///
    /// # Errors
    /// [`Error::Shape`] names `time`.
    pub fn read(time: View<'a>, sizes: Sizes) -> Result<Self, Error> {
        let first = match *time.shape() {
            [count] if count == sizes.samples => 0,
            [count] if count == sizes.samples + 1 => 1,
            _ => {
                let allowed = either(&[vec![sizes.samples], vec![sizes.samples + 1]]);
                return Err(Error::shape("time", time.shape(), allowed));
            }
        };
        let times = time.numbers().to_f64();
        let last = (first == 1).then(|| times[0]);
        Ok(Self { times, last, first })
    }

    /// The time from the last sample that was not missing to sample `k`, which is not; one unit
    /// before the first of all.
    ///
    /// # Errors
    /// [`forgetting::Error::Value`] names `time`, where it is not finite or runs back.
    pub fn elapsed<T: Real>(&mut self, k: usize) -> Result<T, forgetting::Error> {
        let now = self.times[self.first + k];
        let elapsed = self.last.map_or(1.0, |last| now - last);
        if !(now.is_finite() && elapsed >= 0.0 && elapsed.is_finite()) {
            let allowed = "finite, and not before the sample before it";
            return Err(forgetting::Error::value("time", now, allowed));
        }
        self.last = Some(now);
        Ok(T::from_f64(elapsed))
    }
}
