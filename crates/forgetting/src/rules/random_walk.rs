//! Expects the parameters to walk at random, as the Kalman filter does.
//!
//! ```text
//! P̄ = P + Q                                prediction of the Kalman filter with transition I
//! P̄ = (1 − λ_max(Q)/b) P + Q               where a bound b is given
//! F_k = R − P̄⁻¹                            the same as Theorem 1 of GF-RLS has it; the form used: one
//!                                          dyad for each row of a root of Q, and for Q = c·I with
//!                                          n ≤ 10 one pass of Gram and Schmidt over [U, I]
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | Q | process_noise | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 1e-4 |
//! | b | bound | (0, ∞), above process_noise, or not given | not given |
//!
//! - Proper (A1): without a bound; with one, while P ≤ Q b/λ_max(Q), which for Q = c·I is P ≤ b·I.
//! - P̄ bounded above without excitation (A2): with a bound b, since P ≤ b·I makes P̄ ≤ b·I. Without one
//!   P grows by Q at each sample that brings no information, linearly.
//! - P bounded below (A3): if Q > 0 and φ is bounded.
//! - Cost: O((p + r) n²), r the rank of Q; O(n³) for a full one, at n ≤ 10 with Q = c·I about twice that
//!   of `exponential`. State: P alone.
//! - Q is per sample and in units of P: the variance by which θ moves, over the variance of the
//!   measurement noise (Γ).
//! - Use it when that ratio is known: the estimate is then the optimal one. With P₀ that follows the
//!   data, Q counts in units of the root mean square of each regressor.
//!
//! Reference: R. E. Kalman, *A new approach to linear filtering and prediction problems*, Journal
//! of Basic Engineering 82, 1960; as forgetting, GF-RLS, Theorem 1.

use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Kind, Parameter, Range, Setting, Value,
    Values,
};
use crate::rules::root::Root;
use crate::error::Error;
use crate::memory::Memory;
use crate::choice::guarantee::positive;
use forgetting_kernels::kernel::form::{shrink, Form};
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::Real;

const PROCESS_NOISE: Parameter = Parameter::elements(
    "process_noise",
    Kind::Matrix,
    1e-4,
    Range::NON_NEGATIVE,
    "covariance of the parameters' steps: c for c*I, n numbers for a diagonal, or n x n",
);

const BOUND: Parameter = Parameter {
    name: "bound",
    about: "what no variance grows beyond without excitation; not bounded if not given",
    kind: Kind::Real,
    range: Range::POSITIVE,
    default: None,
    optional: true,
};

/// The registry entry.
pub const ABOUT: About = About {
    squares: 3,
    cost: "O((p + r) n^2), r = rank of process_noise",
    guarantees: Some(Guarantees {
        proper: Guarantee::when(
            "no bound, or P <= bound",
            Setting::usual(Input::Exciting(1)).with(&[("bound", Value::Real(0.5))]),
        ),
        bounded_above: Guarantee::when(
            "a bound is given",
            Setting::usual(Input::Silent).with(&[("process_noise", Value::Real(1e4))]),
        ),
        bounded_below: Guarantee::when(
            "process_noise is positive definite, regressors bounded",
            Setting::usual(Input::Exciting(1)).with(&[("process_noise", Value::Real(0.0))]),
        ),
    }),
    ..About::new(&[PROCESS_NOISE, BOUND])
};

/// Adds Q at each sample; see [`self`](crate::rules::random_walk).
#[derive(Clone, Debug)]
pub struct RandomWalk<M: Memory> {
    process_noise: Root<M>,
    trace: M::Real,
    bound: Option<M::Real>,
    /// λ_max(Q)
    largest: M::Real,
    /// 1/b; 0 without a bound
    per_bound: M::Real,
}

impl<M: Memory> RandomWalk<M> {
    /// With steps of this covariance, P not bounded.
    pub fn new(process_noise: Root<M>) -> Self {
        let trace = process_noise.rows().fold(M::Real::ZERO, |sum, row| sum + dot(row, row));
        let (_, largest) = process_noise.extremes();
        Self { process_noise, trace, bound: None, largest, per_bound: M::Real::ZERO }
    }

    /// With steps of the covariance `process_noise`·I and P bounded by `bound`·I.
    ///
    /// # Errors
    /// [`Error::Value`] names the parameter that is out of range.
    pub fn bounded(process_noise: M::Real, bound: M::Real, memory: M) -> Result<Self, Error> {
        Self::new(Root::scalar(&PROCESS_NOISE, process_noise, memory)?).with_bound(bound)
    }

    fn with_bound(self, bound: M::Real) -> Result<Self, Error> {
        let bound = BOUND.check(bound)?;
        if !(bound > self.largest && bound <= M::Real::CEILING) {
            let allowed = "above process_noise, within the number type's range";
            return Err(Error::value(BOUND.name, bound.to_f64(), allowed));
        }
        Ok(Self { bound: Some(bound), per_bound: M::Real::ONE / bound, ..self })
    }
}

impl<M: Memory> Forgetting<M> for RandomWalk<M> {
    type State = ();

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let rule = Self::new(Root::configure(&PROCESS_NOISE, values, memory)?);
        match values.get(BOUND.name) {
            None => Ok(rule),
            Some(_) => rule.with_bound(BOUND.number(values)?),
        }
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.process_noise.describe(PROCESS_NOISE.name, each);
        if let Some(bound) = self.bound {
            each(BOUND.name, Value::Real(bound.to_f64()));
        }
    }

    fn is_bounded(&self) -> bool {
        self.bound.is_some()
    }

    fn start(&self, _: M) {}

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (least, _) = self.process_noise.extremes();
        let above = self.bound.and_then(|bound| positive(bound.to_f64()));
        Bounds { below: constants.least_after(least.to_f64()), above }
    }

    /// A walk, where every parameter walks alike and there are few.
    #[inline]
    fn form(&self, _: M::Real) -> Option<Form<M::Real>> {
        let noise = self.process_noise.scalar_given()?;
        let few = self.process_noise.parameters() <= FEW;
        let walks = noise >= M::Real::FLOOR || (noise > M::Real::ZERO && self.bound.is_none());
        (few && walks).then_some(Form::Walk { noise, per_bound: self.per_bound })
    }

    #[inline]
    fn forget(&self, (): &mut (), step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        step.factor.reserve(M::Real::ONE, self.trace)?;
        if self.bound.is_some() {
            step.factor.shrink(shrink(self.largest, self.per_bound));
        }
        let direction = &mut step.work.first.as_mut()[..step.factor.parameters()];
        for row in self.process_noise.rows() {
            direction.copy_from_slice(row);
            step.factor.add_covariance(direction, M::Real::ONE);
        }
        Ok(Forgotten::rank(self.process_noise.rank()).with_factor(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Defaults;
    use crate::testing::{covariance, forget, memory, Dense};

    #[test]
    fn adds_the_covariance_of_a_step() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let rule = RandomWalk::configure(&Defaults, memory(&phi, 1)).unwrap();
        let outcome = forget(&rule, &mut (), &p, &phi, 0.5);
        let expected = p + 1e-4 * Dense::identity(3);
        assert!(outcome.covariance.distance(&expected) < 1e-15);
    }

    #[test]
    fn a_bound_draws_the_covariance_towards_it() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let rule = RandomWalk::bounded(0.5, 4.0, memory(&phi, 1)).unwrap();
        let outcome = forget(&rule, &mut (), &p, &phi, 0.5);
        let expected = 0.875 * p + 0.5 * Dense::identity(3);
        assert!(outcome.covariance.distance(&expected) < 1e-14);
    }

    #[test]
    fn a_bound_is_above_the_noise() {
        let memory = memory(&Dense::new(1, &[1.0]), 1);
        let refused = RandomWalk::bounded(0.5, 0.5, memory).unwrap_err();
        assert!(matches!(refused, Error::Value { parameter: "bound", .. }));
    }
}
