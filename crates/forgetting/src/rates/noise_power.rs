//! Lets the error after the correction have the power of the noise, which it estimates.
//!
//! ```text
//! A ← A + (‖e‖²/p − A)/min(K_a n, m)             σ_e², the m-th sample
//! B ← B + (‖e‖²/p − B)/min(K_b n, m)             σ_v²
//! Q ← Q + ((tr S/p)² − Q)/min(K_a n, m)          σ_q²,  S = φ̄ P φ̄ᵀ
//! λ_{k+1} = largest                              if √A ≤ γ √B
//!         = √Q √B / (ξ + |√A − √B|)              else
//! λ_{k+1} ← clip(λ_{k+1}, smallest, largest),   λ_0 = largest
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | K_a | short_memory | [1, ∞) | 2 |
//! | K_b | long_memory | (short_memory, ∞) | 10 |
//! | γ | ratio | [1, ∞) | 1.5 |
//! | ξ | floor | (0, ∞) | 1e-8 |
//! | λ_min | smallest | (0, 1] | 0.9 |
//! | λ_max | largest | [smallest, 1] | 0.9999 |
//!
//! - For the next sample. One row is the published algorithm once m > K_b n; it leaves the first
//!   values open, and plain means forget the errors of an arbitrary θ₀ soonest. The lower clip is
//!   ours.
//! - e is whitened by Γ and clipped by the weighting: λ does not depend on the units of y. ‖e‖² is
//!   the sum over the p rows, averaged over targets.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, errors count as 0.
//! - Cost: O(p n²/2) for tr S. State: three averages and the next λ.
//! - Use it when the noise is unknown or its variance changes slowly.
//! - Not where changes are small beside the noise: they hide in its power.
//!
//! Reference: C. Paleologu, J. Benesty, S. Ciochină, *A robust variable forgetting factor
//! recursive least-squares algorithm for system identification*, IEEE Signal Processing Letters
//! 15, 2008.

use super::averages::{Averages, Memories};
use super::limits::{largest, SMALLEST};
use super::{Evidence, Limits, Needs, Rate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::memory::state::{State, Visitor, is_factor};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const RATIO: Parameter = Parameter::real(
    "ratio",
    1.5,
    Range::AT_LEAST_ONE,
    "how many times the noise the error must be before anything but the largest factor is used",
);
const FLOOR: Parameter = Parameter::real(
    "floor",
    1e-8,
    Range::POSITIVE,
    "added to the difference of error and noise (whitened) so as not to divide by 0",
);
const LARGEST: Parameter = largest(0.9999, Range::FRACTION);

/// The registry entry.
pub const ABOUT: About = About::new(&[
    Memories::<f64>::PARAMETERS[0],
    Memories::<f64>::PARAMETERS[1],
    RATIO,
    FLOOR,
    SMALLEST,
    LARGEST,
]);

/// λ from the power of error and noise; see [`self`](crate::rates::noise_power).
#[derive(Clone, Copy, Debug)]
pub struct NoisePower<M: Memory> {
    memories: Memories<M::Real>,
    ratio: M::Real,
    floor: M::Real,
    limits: Limits<M::Real>,
}

/// The averages, and the next λ.
#[derive(Clone, Copy, Debug)]
pub struct Powers<T> {
    errors: Averages<T>,
    spreads: Averages<T>,
    next: T,
}

impl<T: Real> State<T> for Powers<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        self.errors.visit(visitor);
        self.spreads.visit(visitor);
        visitor.reals(core::slice::from_mut(&mut self.next));
    }

    fn is_sound(&self) -> bool {
        // what evidence tells is at most the ceiling, and a spread is squared
        self.errors.are_sound(T::CEILING)
            && self.spreads.are_sound(T::CEILING * T::CEILING)
            && is_factor(self.next)
    }
}

impl<M: Memory> NoisePower<M> {
    /// With these memories, the ratio γ and the floor ξ.
    ///
    /// # Errors
    /// [`Error::Value`] unless `ratio` is at least 1 and `floor` is positive.
    pub fn new(
        memories: Memories<M::Real>,
        ratio: M::Real,
        floor: M::Real,
        limits: Limits<M::Real>,
    ) -> Result<Self, Error> {
        Ok(Self { memories, ratio: RATIO.check(ratio)?, floor: FLOOR.check(floor)?, limits })
    }
}

impl<M: Memory> Rate<M> for NoisePower<M> {
    type State = Powers<M::Real>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        let memories = Memories::configure(values)?;
        let limits = Limits::configure(values, &LARGEST)?;
        Self::new(memories, RATIO.number(values)?, FLOOR.number(values)?, limits)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.memories.describe(each);
        each(RATIO.name, Value::Real(self.ratio.to_f64()));
        each(FLOOR.name, Value::Real(self.floor.to_f64()));
        self.limits.describe(each);
    }

    fn start(&self, _: M) -> Self::State {
        let next = self.limits.largest();
        Powers { errors: Averages::START, spreads: Averages::START, next }
    }

    #[inline]
    fn needs(&self) -> Needs {
        Needs::Leverage
    }

    #[inline]
    fn forgetting_factor(
        &self,
        powers: &Self::State,
        _: &Evidence<'_, '_, M>,
    ) -> Result<M::Real, Error> {
        Ok(self.limits.clip(powers.next))
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn learn(&self, powers: &mut Self::State, evidence: &Evidence<'_, '_, M>, _: M::Real) {
        let Evidence { leverage, samples, factor, .. } = *evidence;
        let squared_error = evidence.standardized(evidence.squared_error);
        let (n, p) = (factor.parameters(), M::Real::from_f64(evidence.rows as f64));
        let spread = leverage / p;
        powers.errors = powers.errors.with(squared_error / p, &self.memories, n, samples);
        powers.spreads = powers.spreads.with(spread * spread, &self.memories, n, samples);
        let (fast, slow) = (powers.errors.fast.sqrt(), powers.errors.slow.sqrt());
        powers.next = if fast > self.ratio * slow {
            let spread = powers.spreads.fast.sqrt();
            self.limits.clip(spread * slow / (self.floor + (fast - slow).abs()))
        } else {
            self.limits.largest()
        };
    }
}

#[cfg(test)]
mod tests {
    use super::{Limits, Memories, NoisePower};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Fixed;
    use crate::rules::Exponential;
    use crate::weightings::Equal;

    /// n = 1, K_a = 1 and K_b = 2: A = e², B the mean of both; λ = 1 at first.
    #[test]
    fn is_the_published_quotient_by_hand() {
        let memories = Memories::new(1.0, 2.0).unwrap();
        let rate = NoisePower::new(memories, 1.0, 1e-9, Limits::new(0.01, 1.0).unwrap()).unwrap();
        let prior = Prior::scalar(Fixed::<f64, 1>::new(), 0.3).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        let mut take = |e: f64| {
            let y = estimator.theta()[0] + e;
            estimator.update(&[1.0], &[y]).unwrap().forgetting_factor
        };
        // A = B = 1: not more error than noise
        assert_eq!((take(1.0), take(2.0)), (1.0, 1.0));
        // A = 4, B = 2.5, Q = (0.3/1.3)²
        let (fast, slow) = (2.0, 2.5f64.sqrt());
        let expected = 0.3 / 1.3 * slow / (1e-9 + fast - slow);
        assert!((take(0.0) - expected).abs() < 1e-14 && expected < 0.9);
    }
}
