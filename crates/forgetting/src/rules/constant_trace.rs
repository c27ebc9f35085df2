//! Holds the trace of P: what the data take away in some directions, all directions get back.
//!
//! ```text
//! P₊ = P_k − K φ̄ P_k,  K = P_k φ̄ᵀ (I + φ̄ P_k φ̄ᵀ)⁻¹
//! P_k+1 = c₁ P₊/tr(P₊) + c₂ I                 c₁ = n (level − floor), c₂ = floor
//! ```
//!
//! The covariance that the estimator shows is P₊, after the data; the second line is applied
//! when the next sample comes, whatever that sample is.
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | tr(P)/n | level | (floor, ∞) | 100 |
//! | c₂ | floor | (0, ∞) | 0.01 |
//!
//! - Proper (A1): no. It can shrink P: where a direction has less variance than before, the
//!   rule claims information that no sample brought.
//! - P̄ bounded above without excitation (A2): always: floor·I ≤ P̄ ≤ (n·level − (n − 1)·floor) I.
//! - P bounded below (A3): if φ is bounded: by min(1/(β + 1/floor), 1/(β + 1/λ_min(P₀))) for
//!   φ̄ᵀφ̄ ≤ β I.
//! - Cost: O((p + 1) n²). State: P, in n²/2 numbers more, and whether the trace is to be held.
//! - Use it where tracking must never slow down and noise is small. The gain stays high however
//!   long the parameters rest.
//!
//! Reference: K. J. Åström, B. Wittenmark, *Adaptive Control*, 1995, chapter 11; as a case of
//! Theorem 1, derived here.

use super::{Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value,
    Values,
};
use crate::memory::state::{State, Visitor};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const LEVEL: Parameter = Parameter::real(
    "level",
    100.0,
    Range::POSITIVE,
    "mean variance of the parameters, which is held (units of 1/phi^2); above floor",
);
const FLOOR: Parameter = Parameter::real(
    "floor",
    0.01,
    Range::POSITIVE,
    "least variance of any direction (units of 1/phi^2)",
);

/// The registry entry.
pub const ABOUT: About = About {
    squares: 1,
    cost: "O((p + 1) n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::no(
            Setting::usual(Input::Fixed)
                .with(&[("level", Value::Real(1.0)), ("floor", Value::Real(0.2))]),
        ),
        bounded_above: Guarantee::ALWAYS,
        bounded_below: Guarantee::when("regressors bounded", Setting::usual(Input::Scaled(1e6))),
    }),
    ..About::new(&[LEVEL, FLOOR])
};

/// Holds the trace of P; see [`self`](crate::rules::constant_trace).
#[derive(Clone, Copy, Debug)]
pub struct ConstantTrace<M: Memory> {
    level: M::Real,
    floor: M::Real,
}

/// Whether a sample was measured since the trace was held: 1 or 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measured(u64);

impl<M: Memory> ConstantTrace<M> {
    /// With tr(P) = n·`level` and P ≥ `floor`·I.
    ///
    /// # Errors
    /// [`Error::Value`] names the parameter that is out of range.
    pub fn new(level: M::Real, floor: M::Real, memory: M) -> Result<Self, Error> {
        let floor = FLOOR.check(floor)?;
        let level = LEVEL.check(level)?;
        if !(floor >= M::Real::FLOOR) {
            return Err(Error::value(FLOOR.name, floor.to_f64(), "within the number type's range"));
        }
        if !(level > floor) {
            return Err(Error::value(LEVEL.name, level.to_f64(), "above floor"));
        }
        // twice the trace, for rounding
        let trace = level * M::Real::from_f64(2.0 * memory.parameters() as f64);
        if !(trace < M::Real::CEILING) {
            return Err(Error::value(LEVEL.name, level.to_f64(), "within the number type's range"));
        }
        Ok(Self { level, floor })
    }
}

impl<M: Memory> Forgetting<M> for ConstantTrace<M> {
    type State = Measured;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        Self::new(LEVEL.number(values)?, FLOOR.number(values)?, memory)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(LEVEL.name, Value::Real(self.level.to_f64()));
        each(FLOOR.name, Value::Real(self.floor.to_f64()));
    }

    fn start(&self, _: M) -> Measured {
        Measured(0)
    }

    fn is_bounded(&self) -> bool {
        true
    }

    fn defers(&self) -> bool {
        true
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (level, floor) = (self.level.to_f64(), self.floor.to_f64());
        let n = constants.parameters as f64;
        Bounds {
            // the first sample is measured with P₀ itself
            below: constants.least_after(floor.min(constants.initial.0)),
            above: positive(n * level - (n - 1.0) * floor),
        }
    }

    fn follow(&self, state: &mut Measured, _: Step<'_, '_, M>) {
        state.0 = 1;
    }

    fn restart(&self, state: &mut Measured, _: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        state.0 = 1;
        Ok(Forgotten::rank(0))
    }

    fn forget(&self, state: &mut Measured, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        if state.0 == 0 {
            state.0 = 1;
            return Ok(Forgotten::rank(0));
        }
        let n = step.factor.parameters();
        let c = M::Real::from_f64(n as f64);
        let shared = c * (self.level - self.floor);
        step.factor.hold_trace(shared);
        step.factor.reserve(M::Real::ONE, c * self.floor)?;
        if step.factor.is_deferring() {
            step.factor.defer_diagonal(|_| self.floor, step.work.gain.as_mut());
            return Ok(Forgotten::rank(n));
        }
        let variances = &mut step.work.first.as_mut()[..n];
        variances.fill(self.floor);
        step.factor.add_diagonal(variances, step.work.gain.as_mut());
        Ok(Forgotten::rank(n))
    }
}

impl<T: Real> State<T> for Measured {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.whole(&mut self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget, memory, Dense};

    #[test]
    fn holds_the_trace_from_the_second_sample_on() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.0, 0.0, 0.0]));
        let memory = memory(&phi, 1);
        let rule = ConstantTrace::new(2.0, 0.5, memory).unwrap();
        let mut state = rule.start(memory);
        let first = forget(&rule, &mut state, &p, &phi, 1.0);
        assert!(first.covariance.distance(&p) < 1e-15, "the first sample forgets nothing");
        let second = forget(&rule, &mut state, &p, &phi, 1.0);
        let trace: f64 = (0..3).map(|i| p.at(i, i)).sum();
        let floor = Dense::new(3, &[0.5, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5]);
        let expected = (4.5 / trace) * p + floor;
        assert!(second.covariance.distance(&expected) < 1e-14);
    }
}
