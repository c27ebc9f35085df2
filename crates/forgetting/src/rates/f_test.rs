//! Forgets when an F-test says that the recent errors are larger than they used to be.
//!
//! ```text
//! z = all errors of a sample, d = p m numbers;  Σ_n, Σ_d = mean of z zᵀ over the last τ_n, τ_d
//! a = d τ_n,  B = (τ_n + τ_d − d − 1)(τ_d − 1)/((τ_d − d − 3)(τ_d − d))
//! b = 4 + (a + 2)/(B − 1),  c = a (b − 2)/(b (τ_d − d − 1))           Lawley and Hotelling
//! g_k = √((τ_n/τ_d) tr(Σ_n Σ_d⁻¹)/c) − √(F⁻¹_{a,b}(1 − α))
//! λ_k = 1/(1 + η g_k) if g_k > 0, else 1
//! λ_k ← clip(λ_k, smallest, largest)
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | η | sensitivity | [0, ∞) | 0.1 |
//! | τ_n | short_window | 1, 2, ... | 10 |
//! | τ_d | long_window | more than short_window and than p m + 3 | 100 |
//! | α | significance | (0, 1) | 0.01 |
//! | λ_min | smallest | (0, 1] | 0.9 |
//! | λ_max | largest | [smallest, 1] | 1 |
//!
//! - Uses this sample: both windows include it. Until τ_d samples were seen, and while Σ_d of the
//!   samples before this one is singular (d > 1; d = 1: while Σ_d = 0), λ = largest.
//! - α is more than the probability of a false alarm at each sample, which is α/4 to α/2: the law
//!   is that of windows apart, but the long one holds the short one, whose errors raise both. For d = 1 it is a = τ_n, b = τ_d, c = τ_n/τ_d, and
//!   g = √(ratio of the mean squares) − √(quantile).
//! - Only a ratio of errors counts: λ depends neither on the units of y nor on the noise
//!   covariance. e is whitened by Γ and clipped by the weighting.
//! - Cost: O(τ_d d² + d³); the sums are formed anew, so that they do not drift. State: τ_d d + d²
//!   numbers.
//! - The quantile is found once, by bisection of the continued fraction of the incomplete beta
//!   function: ten digits or more.
//! - Use it in place of `rms_ratio` when false alarms cost something.
//! - Not for slow drift: both windows then see the same errors.
//!
//! Reference: N. Mohseni, D. S. Bernstein, *Recursive least squares with variable-rate forgetting
//! based on the F-test*, American Control Conference, 2022.

mod law;
mod scatter;

use super::limits::{largest, SMALLEST};
use super::rms_ratio::{factor, Past, SENSITIVITY};
use super::{Evidence, Limits, Rate, Windows};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use core::marker::PhantomData;
use forgetting_kernels::Real;
use law::quantile;
use scatter::{inverse_root, product, sum_of_squares};

const SIGNIFICANCE: Parameter = Parameter::real(
    "significance",
    0.01,
    Range::INNER_FRACTION,
    "bound of the probability, at a sample, of forgetting although nothing has changed",
);
const LARGEST: Parameter = largest(1.0, Range::FRACTION);

/// The registry entry.
pub const ABOUT: About = About::new(&[
    SENSITIVITY,
    Windows::PARAMETERS[0],
    Windows::PARAMETERS[1],
    SIGNIFICANCE,
    SMALLEST,
    LARGEST,
]);

/// λ from an F-test; see [`self`](crate::rates::f_test).
#[derive(Clone, Copy, Debug)]
pub struct FTest<M: Memory> {
    sensitivity: M::Real,
    windows: Windows,
    significance: f64,
    limits: Limits<M::Real>,
    /// 1/c
    scale: M::Real,
    /// √(F⁻¹_{a,b}(1 − α))
    threshold: M::Real,
    memory: PhantomData<M>,
}

/// 1/c and the root of the quantile.
fn test(d: usize, windows: Windows, significance: f64) -> (f64, f64) {
    let (d, short, long) = (d as f64, windows.short() as f64, windows.long() as f64);
    let a = d * short;
    let spread = (short + long - d - 1.0) * (long - 1.0) / ((long - d - 3.0) * (long - d));
    let b = 4.0 + (a + 2.0) / (spread - 1.0);
    let c = a * (b - 2.0) / (b * (long - d - 1.0));
    (1.0 / c, libm::sqrt(quantile(1.0 - significance, a, b)))
}

impl<M: Memory> FTest<M> {
    /// With the sensitivity η and the significance α, for lists of this `memory`.
    ///
    /// # Errors
    /// [`Error::Value`] unless `sensitivity` ≥ 0, `significance` is in (0, 1) and the long window
    /// is longer than p m + 3 and has room in a list.
    pub fn new(
        memory: M,
        sensitivity: M::Real,
        windows: Windows,
        significance: f64,
        limits: Limits<M::Real>,
    ) -> Result<Self, Error> {
        let d = memory.rows() * memory.targets();
        if windows.long() <= d + 3 {
            let allowed = "more than rows * targets + 3";
            return Err(Error::value("long_window", windows.long() as f64, allowed));
        }
        windows.fit(memory, d, d.saturating_mul(d))?;
        let sensitivity = SENSITIVITY.check(sensitivity)?;
        let significance = SIGNIFICANCE.check(significance)?;
        let (scale, threshold) = test(d, windows, significance);
        let (scale, threshold) = (M::Real::from_f64(scale), M::Real::from_f64(threshold));
        let memory = PhantomData;
        Ok(Self { sensitivity, windows, significance, limits, scale, threshold, memory })
    }

    /// τ_n/τ_d tr(Σ_n Σ_d⁻¹), unless Σ_d is singular.
    ///
    /// A is τ_d Σ_d without this z, and A⁻¹ = LᵀL is known from the last sample. Then
    /// z_iᵀ(A + z zᵀ)⁻¹z_i = z_iᵀA⁻¹z_i − (z_iᵀA⁻¹z)²/(1 + q) with q = zᵀA⁻¹z.
    fn statistic(&self, past: &[M::Real], evidence: &Evidence<'_, '_, M>) -> Option<M::Real> {
        let (z, place) = (evidence.errors, self.windows.place(evidence.samples));
        let d = z.len();
        let (ring, root) = past.split_at(self.windows.long() * d);
        if !(root[0] > M::Real::ZERO) {
            // A = 0: there is nothing but this z
            return (d == 1 && z[0] != M::Real::ZERO).then_some(M::Real::ONE);
        }
        let one_and_q = M::Real::ONE + product(root, z, z);
        let now = M::Real::ONE - M::Real::ONE / one_and_q;
        Some(self.windows.recent(place).fold(now, |sum, k| {
            let other = &ring[k * d..(k + 1) * d];
            let shared = product(root, other, z);
            // the larger of 0 and what may be no number, when z is out of all proportion
            sum + (product(root, other, other) - shared * (shared / one_and_q)).max(M::Real::ZERO)
        }))
    }
}

impl<M: Memory> Rate<M> for FTest<M> {
    type State = Past<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let (limits, windows) = (Limits::configure(values, &LARGEST)?, Windows::configure(values)?);
        let significance = SIGNIFICANCE.number(values)?;
        Self::new(memory, SENSITIVITY.number(values)?, windows, significance, limits)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(SENSITIVITY.name, Value::Real(self.sensitivity.to_f64()));
        self.windows.describe(each);
        each(SIGNIFICANCE.name, Value::Real(self.significance));
        self.limits.describe(each);
    }

    /// The last τ_d − 1 of z in a ring, 0 where the next one goes; then L.
    fn start(&self, memory: M) -> Self::State {
        let d = memory.rows() * memory.targets();
        Past(memory.list(self.windows.long() * d + d * d))
    }

    #[inline]
    fn forgetting_factor(
        &self,
        past: &Self::State,
        evidence: &Evidence<'_, '_, M>,
    ) -> Result<M::Real, Error> {
        let statistic = match self.statistic(past.0.as_ref(), evidence) {
            Some(statistic) if self.windows.full(evidence.samples) => statistic,
            _ => return Ok(self.limits.largest()),
        };
        let g = (self.scale * statistic).sqrt() - self.threshold;
        Ok(self.limits.clip(factor(self.sensitivity, g)))
    }

    fn learn(&self, past: &mut Self::State, evidence: &Evidence<'_, '_, M>, _: M::Real) {
        let (samples, d) = (evidence.samples, evidence.errors.len());
        let (ring, root) = past.0.as_mut().split_at_mut(self.windows.long() * d);
        let root = &mut root[..d * d];
        let limit = M::Real::CEILING.sqrt();
        let place = self.windows.place(samples) * d;
        for (kept, &z) in ring[place..place + d].iter_mut().zip(evidence.errors) {
            *kept = z.min(limit).max(-limit);
        }
        // no later window has the oldest
        let next = self.windows.place(samples + 1) * d;
        ring[next..next + d].fill(M::Real::ZERO);
        if self.windows.full(samples + 1) {
            sum_of_squares(ring, root, d);
            inverse_root(root, d);
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{quantile, FTest, Limits, Windows};
    use crate::covariance::Prior;
    use crate::error::Error;
    use crate::estimator::Estimator;
    use crate::memory::{Dynamic, Fixed};
    use crate::rules::Exponential;
    use crate::weightings::Equal;

    #[test]
    fn for_one_error_it_is_the_ratio_of_two_variances() {
        let memory = Fixed::<f64, 1, 1, 1, 9>::new();
        let (windows, limits) = (Windows::new(2, 8).unwrap(), Limits::new(0.01, 1.0).unwrap());
        let rate = FTest::new(memory, 0.5, windows, 0.5, limits).unwrap();
        let prior = Prior::scalar(memory, 1.0).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        let errors = [1.0, -2.0, 1.0, 0.5, 1.0, -1.0, 2.0, 3.0, -9.0, 1e12];
        for (k, &e) in errors.iter().enumerate() {
            let lambda = estimator.update(&[0.0], &[e]).unwrap().forgetting_factor;
            if k < 7 {
                assert_eq!(lambda, 1.0);
                continue;
            }
            let mean = |count: usize| {
                errors[k + 1 - count..=k].iter().map(|e| e * e).sum::<f64>() / count as f64
            };
            let g = (mean(2) / mean(8)).sqrt() - quantile(0.5, 2.0, 8.0).sqrt();
            assert!((lambda - 1.0 / (1.0 + 0.5 * g)).abs() < 1e-14, "{k}: {lambda}");
        }
    }

    /// The trace as it is written, by the inverse of 2 x 2 matrices.
    #[test]
    fn for_more_errors_it_is_the_trace() {
        let memory = Dynamic::<f64>::new(1, 2, 1).unwrap();
        let (windows, limits) = (Windows::new(3, 7).unwrap(), Limits::new(0.01, 1.0).unwrap());
        let rate = FTest::new(memory, 1.0, windows, 0.9, limits).unwrap();
        let (scale, threshold) = (rate.scale, rate.threshold);
        let prior = Prior::scalar(memory, 1.0).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        let z = |k: usize| [libm::sin(k as f64 * 1.7), libm::cos((k * k) as f64) * (k as f64)];
        for k in 0..30 {
            let lambda = estimator.update(&[0.0, 0.0], &z(k)).unwrap().forgetting_factor;
            let sum = |count: usize| {
                (0..count.min(k + 1))
                    .map(|age| z(k - age))
                    .fold([0.0; 3], |[a, b, c], [x, y]| [a + x * x, b + x * y, c + y * y])
            };
            let ([a, b, c], [e, f, g]) = (sum(3), sum(7));
            let trace = (a * g - 2.0 * b * f + c * e) / (e * g - f * f);
            let excess = ((scale * trace).sqrt() - threshold).max(0.0);
            let expected = if k < 6 { 1.0 } else { 1.0 / (1.0 + excess) };
            assert!((lambda - expected).abs() < 1e-13, "{k}: {lambda} is not {expected}");
        }
    }

    #[test]
    fn refuses_windows_too_short_for_the_test() {
        let memory = Dynamic::<f64>::new(1, 2, 2).unwrap();
        let (windows, limits) = (Windows::new(3, 7).unwrap(), Limits::new(0.01, 1.0).unwrap());
        let refused = FTest::new(memory, 1.0, windows, 0.9, limits);
        assert!(matches!(refused, Err(Error::Value { parameter: "long_window", .. })));
    }
}
