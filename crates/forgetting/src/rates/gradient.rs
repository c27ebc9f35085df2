//! Follows the gradient of the modelled mean square error down to the best factor.
//!
//! ```text
//! E, V ← averages of ‖e‖²/p over K_a n and K_b n samples     l = λ_{k−1},  λ_{−1} = largest
//! r′ = r,  t′ = 2 l t;   r ← 1 + l r,  t ← 1 + l² t
//! D = (n + 1) t + r²,    D′ = (n + 1) t′ + 2 r r′
//! ζ = 1 − 2/r + (n + 2)/D,   ζ′ = 2 r′/r² − (n + 2) D′/D²
//! h = 2/r − 2/D,             h′ = −2 r′/r² + 2 D′/D²
//! J_k = ζ J_{k−1} + h V                                      the modelled error
//! g ← ζ g + ζ′ E + h′ V                                      dJ/dλ
//! λ_k = clip(l − α g/(1 − l), smallest, largest)             r = t = g = 0 at the start
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | α | step_size | (0, ∞) | 1e-3 |
//! | K_a | short_memory | [1, ∞) | 2 |
//! | K_b | long_memory | (short_memory, ∞) | 10 |
//! | λ_min | smallest | (0, 1) | 0.9 |
//! | λ_max | largest | [smallest, 1) | 0.9999 |
//!
//! - Uses this sample.
//! - The sign of 2/D in h is minus: only then is J_k = V (1 + n/k) without forgetting. In print it
//!   is plus, which gives V (1 + (n + 4)/k). The original's second, moving lower clip is left
//!   out: `smallest` does its work.
//! - e is whitened by Γ and clipped by the weighting: λ does not depend on the units of y. ‖e‖² is
//!   the sum over the p rows, averaged over targets.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, errors count as 0.
//! - Cost: O(1). State: six numbers.
//! - Use it for slow, steady drift in noise whose variance is stationary.
//! - Not for jumps: λ follows over many samples.
//!
//! Reference: S. H. Leung, C. F. So, *Gradient-based variable forgetting factor RLS algorithm in
//! time-varying environments*, IEEE Transactions on Signal Processing 53(8), 2005.

use super::averages::{Averages, Memories};
use super::limits::{largest, SMALLEST};
use super::{Evidence, Limits, Rate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::memory::state::{State, Visitor, is_factor};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

pub(super) const STEP_SIZE: Parameter = Parameter::real(
    "step_size",
    1e-3,
    Range::POSITIVE,
    "step of the forgetting factor for each unit of slope of the squared whitened error",
);
const LARGEST: Parameter = largest(0.9999, Range::INNER_FRACTION);

/// The registry entry.
pub const ABOUT: About = About::new(&[
    STEP_SIZE,
    Memories::<f64>::PARAMETERS[0],
    Memories::<f64>::PARAMETERS[1],
    SMALLEST,
    LARGEST,
]);

/// λ down the modelled error; see [`self`](crate::rates::gradient).
#[derive(Clone, Copy, Debug)]
pub struct Gradient<M: Memory> {
    step_size: M::Real,
    memories: Memories<M::Real>,
    limits: Limits<M::Real>,
}

/// The averages, the sums of λ's powers, the slope and the last λ.
#[derive(Clone, Copy, Debug)]
pub struct Slope<T> {
    errors: Averages<T>,
    r: T,
    t: T,
    gradient: T,
    last: T,
}

impl<T: Real> State<T> for Slope<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        self.errors.visit(visitor);
        visitor.reals(core::slice::from_mut(&mut self.r));
        visitor.reals(core::slice::from_mut(&mut self.t));
        visitor.reals(core::slice::from_mut(&mut self.gradient));
        visitor.reals(core::slice::from_mut(&mut self.last));
    }

    fn is_sound(&self) -> bool {
        let in_range = |x: &T| x.abs() <= T::CEILING;
        self.errors.are_sound(T::CEILING)
            && [self.r, self.t, self.gradient].iter().all(in_range)
            && is_factor(self.last)
    }
}

/// ζ and h of the model, and their derivatives by λ.
#[derive(Clone, Copy, Debug)]
struct Model<T> {
    zeta: T,
    #[cfg_attr(not(test), allow(dead_code, reason = "its derivative is what a step needs"))]
    h: T,
    zeta_slope: T,
    h_slope: T,
}

impl<T: Real> Slope<T> {
    fn start(largest: T) -> Self {
        let zero = T::ZERO;
        Self { errors: Averages::START, r: zero, t: zero, gradient: zero, last: largest }
    }

    /// One more sample in the sums r and t, with `lambda`, and the model with them.
    #[inline]
    fn advance(&mut self, lambda: T, n: usize) -> Model<T> {
        let (one, two, n) = (T::ONE, T::from_f64(2.0), T::from_f64(n as f64));
        let (r_slope, t_slope) = (self.r, two * lambda * self.t);
        self.r = one + lambda * self.r;
        self.t = one + lambda * lambda * self.t;
        let r = self.r;
        let d = (n + one) * self.t + r * r;
        let d_slope = (n + one) * t_slope + two * r * r_slope;
        let turn = two * r_slope / (r * r);
        let bend = d_slope / (d * d);
        Model {
            zeta: one - two / r + (n + two) / d,
            h: two / r - two / d,
            zeta_slope: turn - (n + two) * bend,
            h_slope: two * bend - turn,
        }
    }
}

impl<M: Memory> Gradient<M> {
    /// With the step size α.
    ///
    /// # Errors
    /// [`Error::Value`] unless `step_size` is positive and `largest` less than 1.
    pub fn new(
        step_size: M::Real,
        memories: Memories<M::Real>,
        limits: Limits<M::Real>,
    ) -> Result<Self, Error> {
        LARGEST.check(limits.largest())?;
        Ok(Self { step_size: STEP_SIZE.check(step_size)?, memories, limits })
    }

    /// The state with this sample.
    #[inline]
    fn next(&self, mut slope: Slope<M::Real>, evidence: &Evidence<'_, '_, M>) -> Slope<M::Real> {
        let n = evidence.factor.parameters();
        let squared = evidence.standardized(evidence.squared_error);
        let squared = squared / M::Real::from_f64(evidence.rows as f64);
        slope.errors = slope.errors.with(squared, &self.memories, n, evidence.samples);
        let lambda = slope.last;
        let Model { zeta, zeta_slope, h_slope, .. } = slope.advance(lambda, n);
        let pull = zeta_slope * slope.errors.fast + h_slope * slope.errors.slow;
        slope.gradient = zeta * slope.gradient + pull;
        let step = self.step_size * slope.gradient / (M::Real::ONE - lambda);
        slope.last = self.limits.clip(lambda - step);
        slope
    }
}

impl<M: Memory> Rate<M> for Gradient<M> {
    type State = Slope<M::Real>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        let limits = Limits::configure(values, &LARGEST)?;
        Self::new(STEP_SIZE.number(values)?, Memories::configure(values)?, limits)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(STEP_SIZE.name, Value::Real(self.step_size.to_f64()));
        self.memories.describe(each);
        self.limits.describe(each);
    }

    fn start(&self, _: M) -> Self::State {
        Slope::start(self.limits.largest())
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn forgetting_factor(
        &self,
        slope: &Self::State,
        evidence: &Evidence<'_, '_, M>,
    ) -> Result<M::Real, Error> {
        Ok(self.next(*slope, evidence).last)
    }

    #[inline]
    fn learn(&self, slope: &mut Self::State, evidence: &Evidence<'_, '_, M>, _: M::Real) {
        *slope = self.next(*slope, evidence);
    }
}

#[cfg(test)]
mod tests {
    use super::{Model, Slope};

    /// J_k → V (1 + n/k) without forgetting.
    #[test]
    fn the_model_has_the_known_excess_error() {
        for n in [1, 5, 12] {
            let (mut slope, mut cost) = (Slope::start(1.0), 0.0);
            for _ in 0..4000 {
                let Model { zeta, h, .. } = slope.advance(1.0, n);
                cost = zeta * cost + h;
            }
            assert!(((cost - 1.0) * 4000.0 / n as f64 - 1.0).abs() < 2e-2);
        }
    }

    #[test]
    fn its_derivatives_are_those_of_differences() {
        let step = 1e-6;
        let mut slope = Slope::start(0.9);
        for _ in 0..20 {
            slope.advance(0.9, 3);
        }
        let at = |lambda: f64| {
            let mut slope = slope;
            slope.advance(lambda, 3)
        };
        let (up, here, down) = (at(0.9 + step), at(0.9), at(0.9 - step));
        assert!(((up.zeta - down.zeta) / (2.0 * step) / here.zeta_slope - 1.0).abs() < 1e-8);
        assert!(((up.h - down.h) / (2.0 * step) / here.h_slope - 1.0).abs() < 1e-8);
    }
}
