//! The variance of the noise, estimated from the errors where no Γ is given.

use crate::memory::state::{State, Visitor};
use core::cmp::Ordering;
use forgetting_kernels::Real;

/// The estimate starts from the median of so many errors.
const FIRST: usize = 5;
/// The median of z² for a normal z.
const MEDIAN: f64 = 0.455;
/// Then an error counts as at most so many standard deviations.
const CLIP: f64 = 2.0;
/// 1/E min(z², [`CLIP`]²) for a normal z.
const CONSISTENT: f64 = 1.086;
/// The most errors that the estimate remembers.
const MEMORY: f64 = 100.0;
/// The least that an error tells of the noise: where the leverage is always large, the prior of the
/// estimator is, and not what is unknown of θ.
const LEAST: f64 = 0.1;
/// Samples a parameter of which the errors tell more of θ.
const WARM_UP: u64 = 2;

/// Follows the variance of the noise.
///
/// ```text
/// z = mean of e² / (1 + min(s, 1))  s the mean leverage of the rows, e of all rows and targets
/// v = median of the first z / 0.455, after 2n samples
/// v ← v + g (κ min(z, 2² v) − v)    g = w · max(2/(c + 2), 1/100),  c ← c + w
/// w = max(1/(1 + s), 1/10)          what the error tells of the noise, and not of θ
/// ```
///
/// An outlier counts as an error of two standard deviations, so that one among twenty samples raises
/// the standard deviation by an eighth, whatever its size; of more than one in five, it follows the
/// outliers. An error of exactly 0, as where a sensor is silent, tells nothing.
#[derive(Clone, Copy, Debug)]
pub struct NoiseVariance<T> {
    first: [T; FIRST],
    variance: T,
    /// errors seen, until the memory is full
    count: T,
}

impl<T: Real> NoiseVariance<T> {
    /// Of which nothing is known.
    pub const UNKNOWN: Self = Self { first: [T::ZERO; FIRST], variance: T::ZERO, count: T::ZERO };

    /// The variance, once enough errors have been seen.
    #[inline]
    pub fn known(&self) -> Option<T> {
        (self.variance > T::ZERO).then_some(self.variance)
    }

    /// Takes note of the mean `squared_error` of `numbers` errors, predicted with this mean `leverage`.
    #[inline]
    pub fn learn(&mut self, squared_error: T, numbers: usize, leverage: T) {
        let squared = squared_error / (T::ONE + leverage.min(T::ONE));
        if !(squared > T::ZERO && squared < T::CEILING) {
            return;
        }
        let share = (T::ONE / (T::ONE + leverage)).max(T::from_f64(LEAST));
        match self.known() {
            Some(variance) => self.follow(variance, squared, numbers, share),
            None => self.start(squared),
        }
    }

    /// Whether errors after so many `samples` tell of the noise.
    #[inline]
    pub fn is_settled(samples: u64, parameters: usize) -> bool {
        samples >= WARM_UP * parameters as u64
    }

    fn follow(&mut self, variance: T, squared: T, numbers: usize, share: T) {
        let (two, memory) = (T::from_f64(2.0), T::from_f64(MEMORY));
        let gain = share * (two / (self.count + two)).max(T::ONE / memory);
        let clipped = squared.min(T::from_f64(CLIP * CLIP) * variance);
        // the mean of several squares is hardly ever clipped
        let seen = if numbers == 1 { T::from_f64(CONSISTENT) * clipped } else { clipped };
        self.variance = (variance + gain * (seen - variance)).max(T::FLOOR);
        self.count = (self.count + share).min(two * memory);
    }

    fn start(&mut self, squared: T) {
        let seen = self.first.iter().filter(|&&z| z > T::ZERO).count();
        self.first[seen.min(FIRST - 1)] = squared;
        if seen + 1 >= FIRST {
            let mut sorted = self.first;
            sorted.sort_unstable_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
            let median = sorted[FIRST / 2] / T::from_f64(MEDIAN);
            self.variance = median.max(T::FLOOR).min(T::CEILING);
            self.count = T::from_f64(FIRST as f64);
        }
    }
}

impl<T: Real> State<T> for NoiseVariance<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(&mut self.first);
        visitor.reals(core::slice::from_mut(&mut self.variance));
        visitor.reals(core::slice::from_mut(&mut self.count));
    }

    fn is_sound(&self) -> bool {
        let sound = |x: &T| (T::ZERO..=T::CEILING).contains(x);
        self.first.iter().all(sound)
            && sound(&self.variance)
            && (T::ZERO..=T::from_f64(2.0 * MEMORY)).contains(&self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::NoiseVariance;

    /// A recurrence of full period in 16 bits, as normal as the sum of twelve uniform numbers is.
    fn normal(seed: &mut u32) -> f64 {
        let mut uniform = || {
            *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(*seed >> 8) / f64::from(1_u32 << 24)
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }

    fn mean_variance(outliers: usize, size: f64) -> f64 {
        let (mut noise, mut seed) = (NoiseVariance::UNKNOWN, 1);
        let (mut sum, count) = (0.0, 20_000_usize);
        for k in 0..count {
            let e = if outliers > 0 && k % outliers == 0 { size } else { 3.0 * normal(&mut seed) };
            noise.learn(e * e, 1, 0.0);
            sum += noise.known().unwrap_or(9.0);
        }
        sum / count as f64
    }

    #[test]
    fn is_the_variance_of_normal_errors() {
        assert!((mean_variance(0, 0.0) / 9.0 - 1.0).abs() < 0.03, "{}", mean_variance(0, 0.0));
    }

    #[test]
    fn one_outlier_in_twenty_counts_as_one_of_two_deviations() {
        // v = 1.086 (0.95 E min(z², 4 v) + 0.05 · 4 v); the mean is 0.957 at v = 1.26
        let variance = 0.95 * 1.086 * 0.9568 / (1.0 - 0.05 * 4.0 * 1.086);
        for size in [1e3, 1e9] {
            assert!((mean_variance(20, size) / 9.0 / variance - 1.0).abs() < 0.05);
        }
    }

    #[test]
    fn uncertain_predictions_tell_little() {
        let mut noise = NoiseVariance::<f64>::UNKNOWN;
        (0..200).for_each(|_| noise.learn(1.0, 1, 0.0));
        let before = noise.known().unwrap();
        (0..10).for_each(|_| noise.learn(1e10, 1, 1e6));
        assert!(noise.known().unwrap() < 1.04 * before);
        for _ in 0..300 {
            noise.learn(1.0, 1, 0.0);
        }
        // each square is that of one deviation, as if the mean square of a normal were never clipped
        assert!(noise.known().is_some_and(|variance| (variance - 1.086).abs() < 0.05));
    }

    #[test]
    fn two_first_errors_out_of_five_may_be_outliers() {
        let mut noise = NoiseVariance::<f64>::UNKNOWN;
        [1e20, 1.0, 2.0, 1e20, 0.5].iter().for_each(|&z| noise.learn(z, 1, 0.0));
        assert_eq!(noise.known(), Some(2.0 / 0.455));
    }

    #[test]
    fn silence_tells_nothing() {
        let mut noise = NoiseVariance::<f64>::UNKNOWN;
        (0..10).for_each(|_| noise.learn(4.0, 1, 0.0));
        let before = noise.known();
        (0..100_000).for_each(|_| noise.learn(0.0, 1, 0.0));
        assert_eq!(noise.known(), before);
    }
}
