//! Expects the parameters to walk at random, as the Kalman filter does.
//!
//! ```text
//! P̄ = P + Q                                prediction of the Kalman filter with transition I
//! P̄ = κ P + Q,  κ = 1 − λ_max(Q)/b         where a bound b is given
//! P̄ = P + r w_jᵀ w_j,  j = k mod r         cyclic: Q = Σ_j w_jᵀ w_j, one of its r dyads a sample,
//!                                          for r samples
//! P̄ = S_j P S_j + (1 − κʳ)/(1 − κ) w_jᵀ w_j    the same with a bound, for a diagonal Q:
//!                                          S_j = I but for κ^(r/2) at parameter j
//! F_k = R − P̄⁻¹                            the same as Theorem 1 of GF-RLS has it; the form used: for
//!                                          a diagonal Q, of what was added the part that the sample
//!                                          depends on, for Q = c·I with n ≤ 10 one pass of Gram and
//!                                          Schmidt over [U, I], else one dyad for each row of a root
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | Q | process_noise | a number c ≥ 0 (c·I), n numbers ≥ 0 or an n x n positive semidefinite matrix | 1e-4 |
//! | b | bound | (0, ∞), above process_noise, or not given | not given |
//! | | schedule | "every_sample" adds Q at each sample, "cyclic" one dyad of it | "every_sample" |
//!
//! - Proper (A1): if there is no bound; with one, while P ≤ Q b/λ_max(Q), which for Q = c·I is P ≤ b·I,
//!   but for the cyclic schedule, which draws each variance towards its bound in its turn.
//! - P̄ bounded above without excitation (A2): if a bound b is given: P ≤ b·I makes P̄ ≤ b·I. Without one
//!   P grows by Q at each sample that brings no information, linearly.
//! - P bounded below (A3): if Q > 0 and φ is bounded.
//! - Cost: O((p + 1) n²) for a number or n numbers, at n ≤ 10 about twice that of `exponential`; O((p + r) n²)
//!   for a matrix of rank r; cyclic O((p + 1) n²), and less of it. State: P, in n²/2 numbers more for a diagonal
//!   Q, and whose turn it is.
//! - Where the time Δt between samples is given, Q is per unit of it: κ^Δt and (1 − κ^Δt)/(1 − κ) Q, or
//!   Δt Q without a bound, so that gaps without data add up.
//! - Q is per sample and in units of P: the variance by which θ moves, over the variance of the
//!   measurement noise (Γ).
//! - Use it when that ratio is known: the estimate is then the optimal one. With P₀ that follows the
//!   data, Q counts in units of the typical size of each regressor. Use the cyclic schedule where n
//!   is large, Q a full matrix or memory scarce, and θ moves little in n samples: without data a whole
//!   cycle adds what r samples add, and within one P is off by less than that.
//! - Not without a bound where the input may fall silent for ever: P then grows without end.
//!
//! A diagonal Q is taken in the order of its elements, a full one in the order of the pivots of
//! Cholesky's factorization with diagonal pivots. k counts the samples used.
//!
//! Reference: R. E. Kalman, *A new approach to linear filtering and prediction problems*, Journal
//! of Basic Engineering 82, 1960; as forgetting, GF-RLS, Theorem 1. The cyclic schedule is that filter
//! for steps that come in turns; one direction a sample is from B. Lai, D. S. Bernstein,
//! *Exponential resetting and cyclic resetting recursive least squares*, IEEE Control Systems
//! Letters 7, 2023.

mod parameters;
mod passed;

use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Setting, Value, Values,
};
use crate::covariance::Factor;
use crate::rules::cycle::{self, Cycle};
use crate::rules::root::Root;
use crate::sample::Work;
use crate::error::Error;
use crate::memory::Memory;
use crate::choice::guarantee::positive;
use forgetting_kernels::kernel::form::{shrink, Form};
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::Real;
use passed::Turns;

pub(crate) use parameters::{BOUND, PROCESS_NOISE, SCHEDULE};
pub(crate) use passed::steps_after;

/// So many dyads a sample are added one by one.
const FEW_DYADS: usize = 4;

/// The registry entry.
pub const ABOUT: About = About {
    squares: 3,
    cost: "O((p + 1) n^2), for a matrix of rank r O((p + r) n^2); cyclic O((p + 1) n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::when(
            "no bound, or P <= bound and not cyclic",
            Setting::usual(Input::Exciting(1))
                .with(&[("bound", Value::Real(0.5)), ("process_noise", Value::Real(0.1))]),
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
    ..About::new(&[PROCESS_NOISE, BOUND, SCHEDULE])
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
    turns: Option<Turns<M::Real>>,
}

impl<M: Memory> RandomWalk<M> {
    /// With steps of this covariance, P not bounded.
    pub fn new(process_noise: Root<M>) -> Self {
        let trace = process_noise.rows().fold(M::Real::ZERO, |sum, row| sum + dot(row, row));
        let (_, largest) = process_noise.extremes();
        Self { process_noise, trace, bound: None, largest, per_bound: M::Real::ZERO, turns: None }
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

    /// The same with one direction of the process noise a sample, in O(n²).
    ///
    /// # Errors
    /// [`Error::Value`] names the bound where there is one and the process noise is a full matrix.
    pub fn cyclic(self) -> Result<Self, Error> {
        let rank = self.process_noise.rank() as f64;
        let Some(bound) = self.bound.map(Real::to_f64) else {
            return Ok(Self { turns: Some(Turns::new(rank, 0.0, 1.0)), ..self });
        };
        if !self.process_noise.is_diagonal() {
            let allowed = "not given where a full process_noise is added in cycles";
            return Err(Error::value(BOUND.name, bound, allowed));
        }
        let share = self.largest.to_f64() / bound;
        Ok(Self { turns: Some(Turns::new(rank, share, 1.0)), ..self })
    }

    /// How many steps of Q are added in this time: Δt, and with a bound (1 − κ^Δt)/(1 − κ), so that
    /// P is drawn towards it as in as many steps.
    #[inline]
    fn steps(&self, elapsed: M::Real) -> M::Real {
        steps_after((self.largest * self.per_bound).to_f64(), elapsed)
    }

    /// P ← P + c·wᵀw for row `j` of the root.
    #[inline(always)]
    fn add(&self, j: usize, c: M::Real, factor: &mut Factor<M>, work: &mut Work<M>) {
        let direction = &mut work.first.as_mut()[..factor.parameters()];
        direction.copy_from_slice(self.process_noise.row(j));
        factor.add_covariance(direction, c);
    }

    /// What row `j` of the root is to add in its turn.
    #[inline]
    fn take_turn(&self, j: usize, turns: Turns<M::Real>, step: Step<'_, '_, M>) -> Result<(), Error> {
        let row = self.process_noise.row(j);
        step.factor.reserve(M::Real::ONE, turns.samples * dot(row, row))?;
        if turns.scale < M::Real::ONE {
            if let Some(parameter) = row.iter().position(|&x| x > M::Real::ZERO) {
                step.factor.shrink_one(parameter, turns.scale);
            }
        }
        self.add(j, turns.samples, step.factor, step.work);
        Ok(())
    }
}

impl<M: Memory> Forgetting<M> for RandomWalk<M> {
    /// Whose turn it is, if they take turns.
    type State = Option<Cycle>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let mut rule = Self::new(Root::configure(&PROCESS_NOISE, values, memory)?);
        if values.get(BOUND.name).is_some() {
            rule = rule.with_bound(BOUND.number(values)?)?;
        }
        if cycle::is_cyclic(&SCHEDULE, values)? {
            rule.cyclic()
        } else {
            Ok(rule)
        }
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        self.process_noise.describe(PROCESS_NOISE.name, each);
        if let Some(bound) = self.bound {
            each(BOUND.name, Value::Real(bound.to_f64()));
        }
        each(SCHEDULE.name, cycle::word(self.turns.is_some()));
    }

    fn is_bounded(&self) -> bool {
        self.bound.is_some()
    }

    fn defers(&self) -> bool {
        let several = self.process_noise.rank() > FEW_DYADS;
        several && self.process_noise.is_diagonal() && self.turns.is_none()
    }

    fn start(&self, _: M) -> Option<Cycle> {
        self.turns.map(|_| Cycle::default())
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let least = self.process_noise.extremes().0.to_f64();
        let above = self.bound.and_then(|bound| positive(bound.to_f64()));
        let Some(turns) = self.turns else {
            return Bounds { below: constants.least_after(least), above };
        };
        // between two of its turns R grows by β a sample, in each of orthogonal directions
        let grown = self.process_noise.rank() as f64 * constants.regressor_bound;
        let added = (turns.samples.to_f64() * least).min(constants.initial.0);
        let below = positive(1.0 / (grown + 1.0 / added));
        Bounds { below: below.filter(|_| self.process_noise.is_diagonal()), above }
    }

    /// A walk, where every parameter walks alike and there are few.
    #[inline]
    fn form(&self, _: M::Real, elapsed: M::Real) -> Option<Form<M::Real>> {
        if self.process_noise.parameters() > FEW || self.turns.is_some() {
            return None;
        }
        let noise = self.process_noise.scalar_given()? * self.steps(elapsed);
        let walks = noise >= M::Real::FLOOR || (noise > M::Real::ZERO && self.bound.is_none());
        if walks {
            return Some(Form::Walk { noise, per_bound: self.per_bound });
        }
        // no time has passed, or too little for numbers to show
        (elapsed < M::Real::ONE).then_some(Form::NOTHING)
    }

    fn walk(&self) -> Option<Form<M::Real>> {
        let noise = self.process_noise.scalar_given().filter(|_| self.turns.is_none())?;
        (noise >= M::Real::FLOOR).then_some(Form::Walk { noise, per_bound: self.per_bound })
    }

    #[inline]
    fn forget(
        &self,
        cycle: &mut Option<Cycle>,
        step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        let rank = self.process_noise.rank();
        if let (Some(turns), Some(cycle), 1..) = (self.turns, cycle, rank) {
            let turns = turns.after(step.elapsed);
            self.take_turn(cycle.turn(rank), turns, step)?;
            cycle.pass(rank);
            return Ok(Forgotten::rank(1).with_factor(1.0));
        }
        let steps = self.steps(step.elapsed);
        step.factor.reserve(M::Real::ONE, steps * self.trace)?;
        if self.bound.is_some() {
            step.factor.shrink(shrink(steps * self.largest, self.per_bound));
        }
        if step.factor.is_deferring() {
            let work = &mut step.work.first.as_mut()[..step.factor.parameters()];
            step.factor.defer_diagonal(|i| steps * self.process_noise.element(i, i), work);
            return Ok(Forgotten::rank(rank).with_factor(1.0));
        }
        for j in 0..rank {
            self.add(j, steps, step.factor, step.work);
        }
        Ok(Forgotten::rank(rank).with_factor(1.0))
    }
}

#[cfg(test)]
mod tests;
