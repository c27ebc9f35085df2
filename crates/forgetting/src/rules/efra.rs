//! Exponential forgetting and resetting (EFRA): P grows as if forgetting, but saturates at a known bound.
//!
//! ```text
//! K = a P φ̄ᵀ/(1 + s),  s = φ̄ P φ̄ᵀ                          EFRA, one row
//! P_k+1 = P_k/λ_k − K φ̄ P_k + b I − d P_k²
//! Γ_k = 1/a + s (1/a − 1), then                             the form used: a measurement with
//! P_k+1 = P₊ + Σ_i max(0, g p_i + b − d p_i²) v_i v_iᵀ      this noise, then a dyad for each
//!                                                           eigenpair (p_i, v_i) of P_k;
//!                                                           g = (1 − λ_k)/λ_k
//! P̄ = P + (p_n − P_ii) e_i e_iᵀ,  i = k mod n,  p_0 = P_ii   cyclic: one parameter a sample, for n
//! p_j+1 = p_j + max(0, g p_j + b − d p_j²)                  samples; then Γ_k, s = φ̄ P̄ φ̄ᵀ
//! ```
//!
//! The covariance that the estimator shows is P₊, after the data; what a sample adds to P is
//! added when the next one comes. The cyclic schedule forgets first and then measures. The published
//! map has no max: it is the same while P ≤ σ_max I, σ_max = g/(2d)·(1 + √(1 + 4bd/g²)), which
//! P₀ ≤ σ_max I guarantees for a constant λ with g² + 4bd ≤ 1. λ_k = 1 is plain least squares, a, b
//! and d left out.
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | a | gain | (0, 1] | 0.5 |
//! | b | increase | [0, ∞) | 0.005 |
//! | d | saturation | (0, ∞) | 0.0001 |
//! | | schedule | "every_sample" adds along each eigenvector at each sample, "cyclic" along one parameter | "every_sample" |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): if λ_k ≥ λ_min > 0, by the larger of P₀ and
//!   b + (1 + g)²/(4d), g of λ_min, the most that p + g p + b − d p² can be; where g² + 4bd ≤ 1 by
//!   σ_max in its place. Silence takes P to σ_max I. Cyclic: this bounds every P_ii, and P by n times
//!   it, as P ≤ tr(P) I; silence takes every P_ii to σ_max and leaves the rest of P as it is.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded, but not for the cyclic schedule: where
//!   two elements of φ are equal at all samples, both variances go to σ_max, and what is known of the
//!   sum of the two parameters is forgotten no more.
//! - Cost: O(n³). State: P, n eigenvectors and 2 n numbers. The eigenvectors follow P from sample to
//!   sample; after one that a gate freezes they are computed anew. Cyclic O(n²). State: P, and whose
//!   turn it is.
//! - Use it for one output, where P must stay below a bound that is stated beforehand, with
//!   P₀ at or below it. Use the cyclic schedule where n is large. It forgets along the parameters,
//!   where the published map forgets alike in any basis; a diagonal P is after a cycle in silence what
//!   n samples of the other make of it. k counts the samples used.
//! - Not with the cyclic schedule where two regressors are equal, or opposite, at almost all samples.
//!
//! Reference: M. E. Salgado, G. C. Goodwin, R. H. Middleton, *Modified least squares algorithm
//! incorporating exponential resetting and forgetting*, International Journal of Control 47,
//! 1988; as a case of Theorem 1, derived here.

mod cyclic;
mod growth;
mod pending;
mod remembered;
#[cfg(test)]
mod tests;

use self::growth::Growth;
use self::pending::Pending;
use self::remembered::Remembered;
use super::cycle::{self, Cycle};
use super::{Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value,
    Values,
};
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::Sample;
use forgetting_kernels::Real;

const GAIN: Parameter =
    Parameter::real("gain", 0.5, Range::FRACTION, "share of the least-squares gain that is used");
const INCREASE: Parameter = Parameter::real(
    "increase",
    0.005,
    Range::NON_NEGATIVE,
    "what every sample adds to the covariance in every direction (units of 1/phi^2)",
);
const SATURATION: Parameter = Parameter::real(
    "saturation",
    1e-4,
    Range::POSITIVE,
    "how strongly a large covariance is held back (units of phi^2)",
);
const SCHEDULE: Parameter = cycle::schedule(
    "where the covariance grows: along all its eigenvectors at each sample, or one parameter, in O(n^2)",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    largest_rows: Some(1),
    squares: 3,
    cost: "O(n^3); cyclic O(n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::when(
            "forgetting factor >= lambda_min > 0",
            Setting::usual(Input::Silent).factor(1e-6),
        ),
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded, and not cyclic",
            Setting::usual(Input::Exciting(1)).factor(1.0).with(&[("increase", Value::Real(0.0))]),
        ),
    }),
    ..About::new(&[GAIN, INCREASE, SATURATION, SCHEDULE])
};

/// Exponential forgetting and resetting; see [`self`](crate::rules::efra).
#[derive(Clone, Copy, Debug)]
pub struct Efra<M: Memory> {
    gain: M::Real,
    increase: M::Real,
    saturation: M::Real,
    cyclic: bool,
}

impl<M: Memory> Efra<M> {
    /// With a = `gain`, b = `increase` and d = `saturation`.
    ///
    /// # Errors
    /// [`Error::Value`] names the parameter that is out of range.
    pub fn new(gain: M::Real, increase: M::Real, saturation: M::Real) -> Result<Self, Error> {
        for (parameter, value) in [(INCREASE, increase), (SATURATION, saturation)] {
            if !(value <= M::Real::CEILING) {
                return Err(Error::value(parameter.name, value.to_f64(), parameter.range.words));
            }
        }
        Ok(Self {
            gain: GAIN.check(gain)?,
            increase: INCREASE.check(increase)?,
            saturation: SATURATION.check(saturation)?,
            cyclic: false,
        })
    }

    /// The same with one parameter a sample, in O(n²).
    #[must_use]
    pub fn cyclic(self) -> Self {
        Self { cyclic: true, ..self }
    }

    #[inline]
    fn growth(&self, lambda: M::Real) -> Growth<M::Real> {
        let growth = (M::Real::ONE - lambda) / lambda;
        Growth { growth, increase: self.increase, saturation: self.saturation }
    }

    /// Gives a sample its noise, of which P is the `factor`.
    #[inline]
    fn weigh(&self, factor: &Factor<M>, sample: &mut Sample<'_, M>) {
        let one = M::Real::ONE;
        let leverage = factor.leverage(sample.row(0));
        let noise = one / self.gain + leverage * (one / self.gain - one);
        if noise != one {
            sample.scale(one / noise.sqrt());
        }
    }

    /// Takes note of what this sample adds to P, and gives it its noise.
    fn note(&self, pending: &mut Pending<M>, step: Step<'_, '_, M>) {
        if step.forgetting_factor >= M::Real::ONE {
            pending.clear();
            return;
        }
        pending.note(self.growth(step.forgetting_factor), step.factor);
        self.weigh(step.factor, step.sample);
        pending.measure(step.sample.row(0));
    }

    /// Refuses a forgetting factor so small that P could leave the range at the next sample.
    #[inline]
    fn check_growth(&self, lambda: M::Real, n: usize) -> Result<(), Error> {
        let growth = (M::Real::ONE - lambda) / lambda;
        let four = M::Real::from_f64(4.0);
        let most = self.increase + growth * (growth / (four * self.saturation));
        let limit = M::Real::CEILING / (four * M::Real::from_f64(n as f64));
        if most < limit {
            return Ok(());
        }
        let (value, limit) = (most.to_f64(), limit.to_f64());
        Err(Error::Range { parameter: "covariance (its growth)", value, limit })
    }
}

impl<M: Memory> Forgetting<M> for Efra<M> {
    type State = Remembered<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        let (gain, increase) = (GAIN.number(values)?, INCREASE.number(values)?);
        let cyclic = cycle::is_cyclic(&SCHEDULE, values)?;
        Ok(Self { cyclic, ..Self::new(gain, increase, SATURATION.number(values)?)? })
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(GAIN.name, Value::Real(self.gain.to_f64()));
        each(INCREASE.name, Value::Real(self.increase.to_f64()));
        each(SATURATION.name, Value::Real(self.saturation.to_f64()));
        each(SCHEDULE.name, cycle::word(self.cyclic));
    }

    fn start(&self, memory: M) -> Remembered<M> {
        if self.cyclic {
            return Remembered::Cyclic(Cycle::default());
        }
        Remembered::EverySample(Pending::new(memory))
    }

    fn is_bounded(&self) -> bool {
        true
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (smallest, _) = constants.forgetting_factors;
        let (growth, increase) = ((1.0 - smallest) / smallest, self.increase.to_f64());
        let grown = Growth { growth, increase, saturation: self.saturation.to_f64() }.most();
        let most = grown.max(constants.initial.1);
        // cyclic: of each element of the diagonal; P is at most their sum
        let times = if self.cyclic { constants.parameters as f64 } else { 1.0 };
        Bounds { below: None, above: positive(times * most) }
    }

    /// P changes, but what is still to be added does not.
    fn follow(&self, state: &mut Remembered<M>, _: Step<'_, '_, M>) {
        if let Remembered::EverySample(pending) = state {
            pending.lose_sight();
        }
    }

    /// What is still to be added belongs to eigenvectors that are no longer orthogonal: it is let go.
    fn change_units(&self, state: &mut Remembered<M>, _: &[M::Real]) {
        if let Remembered::EverySample(pending) = state {
            pending.clear();
        }
    }

    fn restart(
        &self,
        state: &mut Remembered<M>,
        step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        let n = step.factor.parameters();
        match state {
            Remembered::EverySample(pending) => {
                self.check_growth(step.forgetting_factor, n)?;
                pending.lose_sight();
                self.note(pending, step);
            }
            Remembered::Cyclic(cycle) => {
                if step.forgetting_factor < M::Real::ONE {
                    self.weigh(step.factor, step.sample);
                }
                cycle.pass(n);
            }
        }
        Ok(Forgotten::rank(0))
    }

    #[inline]
    fn forget(
        &self,
        state: &mut Remembered<M>,
        mut step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        let (lambda, n) = (step.forgetting_factor, step.factor.parameters());
        let mut rank = 0;
        match state {
            Remembered::EverySample(pending) => {
                self.check_growth(lambda, n)?;
                rank = pending.add(&mut step)?;
                self.note(pending, step);
            }
            Remembered::Cyclic(cycle) => {
                if lambda < M::Real::ONE {
                    rank = cyclic::take_turn(cycle, self.growth(lambda), &mut step)?;
                    self.weigh(step.factor, step.sample);
                }
                cycle.pass(n);
            }
        }
        Ok(Forgotten::rank(rank))
    }
}
