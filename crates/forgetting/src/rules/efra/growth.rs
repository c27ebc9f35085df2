//! How the variance of a direction grows from sample to sample without data.

use forgetting_kernels::Real;

/// p ← p + max(0, g p + b − d p²)
#[derive(Clone, Copy, Debug)]
pub struct Growth<T> {
    /// g = (1 − λ)/λ
    pub growth: T,
    /// b
    pub increase: T,
    /// d
    pub saturation: T,
}

impl<T: Real> Growth<T> {
    /// What one sample adds to the variance `p`.
    #[inline]
    pub fn added(self, p: T) -> T {
        (self.growth * p + self.increase - self.saturation * p * p).max(T::ZERO)
    }

    /// What so many `samples` add to it, one after the other.
    #[inline]
    pub fn added_in(self, samples: usize, p: T) -> T {
        let mut sum = T::ZERO;
        for _ in 0..samples {
            let added = self.added(p + sum);
            if !(added > T::ZERO) {
                break;
            }
            sum += added;
        }
        sum
    }

    /// What no variance grows beyond: the p at which nothing is added, where more p never makes less
    /// of it up to there; else the largest value that p + g p + b − d p² has.
    pub fn most(self) -> T {
        let Self { growth, increase, saturation } = self;
        let (one, two, four) = (T::ONE, T::from_f64(2.0), T::from_f64(4.0));
        let squared = growth * growth + four * increase * saturation;
        if squared <= one {
            return (growth + squared.sqrt()) / (two * saturation);
        }
        let root = (one + growth) / two;
        increase + root * (root / saturation)
    }
}

#[cfg(test)]
mod tests {
    use super::Growth;

    #[test]
    fn three_samples_by_hand() {
        let growth = Growth { growth: 0.5, increase: 0.25, saturation: 0.125 };
        // 1 + (0.5 + 0.25 − 0.125) = 1.625, + (0.8125 + 0.25 − 0.330078125) = 2.357421875, …
        assert_eq!(growth.added_in(2, 1.0), 1.357421875);
        let third = 0.5 * 2.357421875 + 0.25 - 0.125 * 2.357421875 * 2.357421875;
        assert_eq!(growth.added_in(3, 1.0), 1.357421875 + third);
    }

    #[test]
    fn no_variance_grows_beyond_the_most() {
        for (growth, increase) in [(0.5, 0.25), (0.5, 0.0), (3.0, 0.5), (0.1, 7.0), (0.0, 2.0)] {
            let growth = Growth { growth, increase, saturation: 0.125 };
            let most = growth.most();
            let after = |k: usize| k as f64 / 1e3 * most + growth.added(k as f64 / 1e3 * most);
            let largest = (0..=1000).map(after).fold(0.0, f64::max);
            // what is stated is reached, but for the steps of a thousandth
            assert!(
                largest < most * (1.0 + 1e-12) && largest > most * (1.0 - 1e-5),
                "{largest} {most}"
            );
        }
    }

    #[test]
    fn nothing_is_added_at_the_bound_and_beyond() {
        let growth = Growth { growth: 0.5, increase: 0.0, saturation: 0.125 };
        assert_eq!(growth.added_in(9, 4.0), 0.0);
        assert_eq!(growth.added_in(9, 1e300), 0.0);
    }
}
