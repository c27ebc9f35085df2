//! Intervals that hold what they promise, whatever the errors are.
//!
//! The half-width is c σ, σ² the mean of squared errors over up to the last hundred samples, and
//! c a number that follows the errors: after each sample
//!
//! ln c ← ln c + η (level)      if the error was outside,
//! ln c ← ln c − η (1 − level)  if it was inside,
//!
//! so that the share of errors inside over T samples differs from `level` by |ln c_T − ln c_0|/(η T):
//! under any drift, any distribution, and in any unit. It is adaptive conformal inference (Gibbs and
//! Candès 2021) in the form of quantile tracking (Angelopoulos, Candès and Tibshirani 2023), with
//! the logarithm in the place of the number.

use crate::error::Error;
use libm::{exp, sqrt};

/// Samples over which squared errors are averaged.
const MEMORY: f64 = 100.0;
/// ln c stays within this: beyond, errors are not of one size in any sense.
const LARGEST: f64 = 40.0;
/// Squares are cut here, so that the mean of them is finite.
const LARGEST_SQUARE: f64 = 1e300;

/// The half-width of an interval about the next prediction; one is as large as its level asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intervals {
    level: f64,
    rate: f64,
    /// ln c
    logarithm: f64,
    mean_square: f64,
    /// squares averaged, up to [`MEMORY`]
    averaged: f64,
    /// errors that are not counted yet: n parameters fit n samples whatever the noise
    skip: u64,
    /// errors that had an interval, and those inside
    judged: u64,
    inside: u64,
}

impl Intervals {
    /// For this share of errors inside, beginning with `factor` standard deviations (1.96 for 95 % of
    /// Gaussian errors), after `skip` errors.
    ///
    /// # Errors
    /// [`Error::Value`] names `level` or `rate` unless they lie between 0 and 1, or `factor` unless it is
    /// positive.
    pub fn new(level: f64, rate: f64, factor: f64, skip: u64) -> Result<Self, Error> {
        for (name, value) in [("level", level), ("rate", rate)] {
            if !(value > 0.0 && value < 1.0) {
                return Err(Error::value(name, value, "between 0 and 1"));
            }
        }
        if !(factor > 0.0 && factor < f64::INFINITY) {
            return Err(Error::value("factor", factor, "positive"));
        }
        let logarithm = libm::log(factor);
        Ok(Self {
            level,
            rate,
            logarithm,
            mean_square: 0.0,
            averaged: 0.0,
            skip,
            judged: 0,
            inside: 0,
        })
    }

    /// All that it keeps, as numbers and counts; see [`Intervals::from_numbers`].
    #[must_use]
    pub fn numbers(&self) -> ([f64; 5], [u64; 3]) {
        let numbers = [self.level, self.rate, self.logarithm, self.mean_square, self.averaged];
        (numbers, [self.skip, self.judged, self.inside])
    }

    /// Those of which [`Intervals::numbers`] told.
    ///
    /// # Errors
    /// [`Error::State`] when they are not numbers of this kind.
    pub fn from_numbers(numbers: [f64; 5], counts: [u64; 3]) -> Result<Self, Error> {
        let [level, rate, logarithm, mean_square, averaged] = numbers;
        let [skip, judged, inside] = counts;
        let sound = logarithm.abs() <= LARGEST
            && (0.0..=LARGEST_SQUARE).contains(&mean_square)
            && (0.0..=MEMORY).contains(&averaged)
            && inside <= judged;
        if !sound {
            return Err(Error::State { reason: "its numbers are not those of intervals" });
        }
        let new = Self::new(level, rate, 1.0, skip)?;
        Ok(Self { logarithm, mean_square, averaged, judged, inside, ..new })
    }

    /// The half-width for the next error; nothing before there was one that counts.
    #[must_use]
    pub fn half_width(&self) -> Option<f64> {
        self.deviation().map(|deviation| exp(self.logarithm) * deviation)
    }

    /// σ, the root of the mean square of the last errors; nothing before there was one that counts.
    #[must_use]
    pub fn deviation(&self) -> Option<f64> {
        (self.averaged > 0.0).then(|| sqrt(self.mean_square))
    }

    /// The share of errors inside their intervals; nothing before the first that had one.
    #[must_use]
    pub fn coverage(&self) -> Option<f64> {
        (self.judged > 0).then(|| self.inside as f64 / self.judged as f64)
    }

    /// Takes the error of a prediction; a NaN is none.
    ///
    /// # Errors
    /// [`Error::Value`] names `error` when it is infinite; nothing has changed.
    pub fn update(&mut self, error: f64) -> Result<(), Error> {
        if error.is_infinite() {
            return Err(Error::value("error", error, "finite, or NaN for none"));
        }
        if error.is_nan() {
            return Ok(());
        }
        if self.skip > 0 {
            self.skip -= 1;
            return Ok(());
        }
        if let Some(half_width) = self.half_width() {
            self.judge(error.abs() <= half_width);
        }
        self.averaged = (self.averaged + 1.0).min(MEMORY);
        let square = (error * error).min(LARGEST_SQUARE);
        self.mean_square += (square - self.mean_square) / self.averaged;
        Ok(())
    }

    fn judge(&mut self, inside: bool) {
        self.judged += 1;
        self.inside += u64::from(inside);
        let step = if inside { self.level - 1.0 } else { self.level };
        self.logarithm = (self.logarithm + self.rate * step).clamp(-LARGEST, LARGEST);
    }
}

#[cfg(test)]
mod tests {
    use super::Intervals;

    #[test]
    fn the_share_inside_is_the_level_whatever_comes() {
        let mut intervals = Intervals::new(0.9, 0.1, 1.64, 0).expect("sound");
        for k in 0..20_000u32 {
            // sizes that grow and fall by a factor of a thousand, with an outlier now and then
            let size = libm::pow(10.0, 1.5 * libm::sin(f64::from(k) / 700.0));
            let error = size * libm::sin(f64::from(k) * f64::from(k % 97));
            let outlier = if k % 53 == 0 { 1e4 } else { 1.0 };
            intervals.update(error * outlier).expect("finite");
        }
        let coverage = intervals.coverage().expect("there were many");
        assert!((coverage - 0.9).abs() < 0.005, "{coverage}");
    }

    #[test]
    fn what_is_refused_changes_nothing() {
        let mut intervals = Intervals::new(0.5, 0.1, 1.0, 0).expect("sound");
        intervals.update(2.0).expect("finite");
        let before = intervals;
        assert!(intervals.update(f64::INFINITY).is_err());
        intervals.update(f64::NAN).expect("none");
        assert_eq!(intervals, before);
        assert_eq!(intervals.half_width(), Some(2.0));
    }
}
