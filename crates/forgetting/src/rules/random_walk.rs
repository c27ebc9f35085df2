//! Expects the parameters to walk at random, as the Kalman filter does.
//!
//! ```text
//! P̄ = P + Q                                prediction of the Kalman filter with transition I
//! F_k = R − (P + Q)⁻¹                      the same as Theorem 1 of GF-RLS has it; the form
//!                                          used: one dyad for each row of a root of Q
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | Q | process_noise | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 1e-4 |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. Without information P grows by Q at each
//!   sample, linearly.
//! - P bounded below (A3): if Q > 0 and φ is bounded.
//! - Cost: O((p + r) n²), r the rank of Q; O(n³) for a full one. State: P alone.
//! - Q is per sample and in units of P: the variance by which θ moves, over the variance of the
//!   measurement noise (Γ).
//! - Use it when that ratio is known: the estimate is then the optimal one.
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
use forgetting_kernels::Real;
use forgetting_kernels::kernel::functions::dot;

const PROCESS_NOISE: Parameter = Parameter::elements(
    "process_noise",
    Kind::Matrix,
    1e-4,
    Range::NON_NEGATIVE,
    "covariance of the parameters' steps: c for c*I, n numbers for a diagonal, or n x n",
);

/// The registry entry.
pub const ABOUT: About = About {
    cost: "O((p + r) n^2), r = rank of process_noise",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(
            Setting::usual(Input::Silent).with(&[("process_noise", Value::Real(1e4))]),
        ),
        bounded_below: Guarantee::when(
            "process_noise is positive definite, regressors bounded",
            Setting::usual(Input::Exciting(1)).with(&[("process_noise", Value::Real(0.0))]),
        ),
    }),
    ..About::new(&[PROCESS_NOISE])
};

/// Adds Q at each sample; see [`self`](crate::rules::random_walk).
#[derive(Clone, Debug)]
pub struct RandomWalk<M: Memory> {
    process_noise: Root<M>,
    trace: M::Real,
}

impl<M: Memory> RandomWalk<M> {
    /// With steps of this covariance.
    pub fn new(process_noise: Root<M>) -> Self {
        let trace = process_noise.rows().fold(M::Real::ZERO, |sum, row| sum + dot(row, row));
        Self { process_noise, trace }
    }
}

impl<M: Memory> Forgetting<M> for RandomWalk<M> {
    type State = ();

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        Root::configure(&PROCESS_NOISE, values, memory).map(Self::new)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.process_noise.describe(PROCESS_NOISE.name, each);
    }

    fn start(&self, _: M) {}

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (least, _) = self.process_noise.extremes();
        Bounds { below: constants.least_after(least.to_f64()), above: None }
    }

    #[inline]
    fn forget(&self, (): &mut (), step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        step.factor.reserve(M::Real::ONE, self.trace)?;
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
}
