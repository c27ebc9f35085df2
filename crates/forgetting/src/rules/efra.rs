//! Exponential forgetting and resetting (EFRA): P grows as if forgetting, but saturates at a known bound.
//!
//! ```text
//! K = a P φ̄ᵀ/(1 + s),  s = φ̄ P φ̄ᵀ                          EFRA, one row
//! P_k+1 = P_k/λ_k − K φ̄ P_k + b I − d P_k²
//! Γ_k = 1/a + s (1/a − 1), then                             the form used: a measurement with
//! P_k+1 = P₊ + Σ_i max(0, g p_i + b − d p_i²) v_i v_iᵀ      this noise, then a dyad for each
//!                                                           eigenpair (p_i, v_i) of P_k;
//!                                                           g = (1 − λ_k)/λ_k
//! ```
//!
//! The covariance that the estimator shows is P₊, after the data; what a sample adds to P is
//! added when the next one comes. The published map has no max: it is the same while
//! P ≤ σ_max I, σ_max = g/(2d)·(1 + √(1 + 4bd/g²)), which P₀ ≤ σ_max I guarantees for a constant λ
//! with g² + 4bd ≤ 1. λ_k = 1 is plain least squares, a, b and d left out.
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | a | gain | (0, 1] | 0.5 |
//! | b | increase | [0, ∞) | 0.005 |
//! | d | saturation | (0, ∞) | 0.0001 |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): if λ_k ≥ λ_min > 0, by the larger of P₀ and
//!   b + (1 + g)²/(4d); by σ_max where the published map applies. Silence takes P to σ_max I.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
//! - Cost: O(n³). State: P, n eigenvectors and 2 n numbers. The eigenvectors follow P from sample to
//!   sample; after one that a gate freezes they are computed anew.
//! - Use it for one output, where P must stay below a bound that is stated beforehand, with
//!   P₀ at or below it.
//!
//! Reference: M. E. Salgado, G. C. Goodwin, R. H. Middleton, *Modified least squares algorithm
//! incorporating exponential resetting and forgetting*, International Journal of Control 47,
//! 1988; as a case of Theorem 1, derived here.

use super::{Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value,
    Values,
};
use crate::covariance::spectrum::Spectrum;
use crate::memory::state::{State, Visitor, is_finite};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
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

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    largest_rows: Some(1),
    squares: 3,
    cost: "O(n^3)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::when(
            "forgetting factor >= lambda_min > 0",
            Setting::usual(Input::Silent).factor(1e-6),
        ),
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0).with(&[("increase", Value::Real(0.0))]),
        ),
    }),
    ..About::new(&[GAIN, INCREASE, SATURATION])
};

/// Exponential forgetting and resetting; see [`self`](crate::rules::efra).
#[derive(Clone, Copy, Debug)]
pub struct Efra<M: Memory> {
    gain: M::Real,
    increase: M::Real,
    saturation: M::Real,
}

/// What the last sample adds to P.
#[derive(Clone, Debug)]
pub struct Pending<M: Memory> {
    spectrum: Spectrum<M>,
    /// the weight w_i of each eigenvector
    added: M::Vector,
    /// the components z_i of what was measured along the eigenvectors
    measured: M::Vector,
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
        })
    }

    /// Takes note of what this sample adds to P, and gives it its noise.
    fn weigh(&self, state: &mut Pending<M>, step: Step<'_, '_, M>) {
        let (one, lambda) = (M::Real::ONE, step.forgetting_factor);
        let Pending { spectrum, added, measured } = state;
        added.as_mut().fill(M::Real::ZERO);
        if lambda >= one {
            spectrum.discard();
            return;
        }
        let growth = (one - lambda) / lambda;
        spectrum.follow(step.factor);
        for (added, &r) in added.as_mut().iter_mut().zip(spectrum.information()) {
            let p = one / r;
            *added = (growth * p + self.increase - self.saturation * p * p).max(M::Real::ZERO);
        }
        let leverage = step.factor.leverage(step.sample.row(0));
        let noise = one / self.gain + leverage * (one / self.gain - one);
        if noise != one {
            step.sample.scale(one / noise.sqrt());
        }
        spectrum.project(step.sample.row(0), measured.as_mut());
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
    type State = Pending<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(GAIN.number(values)?, INCREASE.number(values)?, SATURATION.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(GAIN.name, Value::Real(self.gain.to_f64()));
        each(INCREASE.name, Value::Real(self.increase.to_f64()));
        each(SATURATION.name, Value::Real(self.saturation.to_f64()));
    }

    fn start(&self, memory: M) -> Pending<M> {
        Pending {
            spectrum: Spectrum::new(memory),
            added: memory.vector(),
            measured: memory.vector(),
        }
    }

    fn is_bounded(&self) -> bool {
        true
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let (smallest, _) = constants.forgetting_factors;
        let grown = 1.0 / (4.0 * self.saturation.to_f64() * smallest * smallest);
        Bounds { below: None, above: positive(self.increase.to_f64() + grown) }
    }

    /// P changes, but what is still to be added does not.
    fn follow(&self, state: &mut Pending<M>, _: Step<'_, '_, M>) {
        state.spectrum.discard();
    }

    /// What is still to be added belongs to eigenvectors that are no longer orthogonal: it is let go.
    fn change_units(&self, state: &mut Pending<M>, _: &[M::Real]) {
        state.spectrum.discard();
        state.added.as_mut().fill(M::Real::ZERO);
    }

    fn restart(&self, state: &mut Pending<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        self.check_growth(step.forgetting_factor, step.factor.parameters())?;
        state.spectrum.discard();
        self.weigh(state, step);
        Ok(Forgotten::rank(0))
    }

    fn forget(
        &self,
        state: &mut Pending<M>,
        mut step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        self.check_growth(step.forgetting_factor, step.factor.parameters())?;
        let rank = state.add(&mut step)?;
        self.weigh(state, step);
        Ok(Forgotten::rank(rank))
    }
}

impl<M: Memory> Pending<M> {
    /// Adds to P what the last sample adds; returns the number of directions.
    fn add(&mut self, step: &mut Step<'_, '_, M>) -> Result<usize, Error> {
        let Self { spectrum, added, .. } = self;
        let total = added.as_ref().iter().fold(M::Real::ZERO, |sum, &x| sum + x);
        let mut rank = 0;
        if total > M::Real::ZERO {
            step.factor.reserve(M::Real::ONE, total)?;
            let mut room = total;
            for (i, &weight) in added.as_ref().iter().enumerate() {
                if weight > M::Real::ZERO {
                    spectrum.widen(i, (weight, &mut room), step.factor, step.work.gain.as_mut());
                    rank += 1;
                }
            }
        }
        if self.spectrum.is_known() {
            self.follow(step.work.gain.as_mut());
        }
        Ok(rank)
    }

    /// The spectrum of P after it was measured and added to; uses n numbers `row`.
    ///
    /// What was measured before the addition is, after it, a measurement of another row:
    /// (P₊ + Σ w_i v_i v_iᵀ)⁻¹ = Σ v_i v_iᵀ/(p_i + w_i) + uᵀu with
    /// u = Σ z_i p_i/(p_i + w_i) v_i/√(1 + Σ z_i² p_i w_i/(p_i + w_i)), by the matrix inversion
    /// lemma: P₊ = P − P z zᵀ P/(1 + zᵀ P z).
    fn follow(&mut self, row: &mut [M::Real]) {
        let Self { spectrum, added, measured } = self;
        let (one, mut variance) = (M::Real::ONE, M::Real::ONE);
        for (i, (&w, z)) in added.as_ref().iter().zip(measured.as_mut()).enumerate() {
            let p = one / spectrum.information()[i];
            let kept = p / (p + w);
            variance = (*z * *z).mul_add(kept * w, variance);
            *z *= kept;
            spectrum.set_information(i, one / (p + w));
        }
        row.fill(M::Real::ZERO);
        for (i, &z) in measured.as_ref().iter().enumerate() {
            add_scaled(row, z / variance.sqrt(), spectrum.vector(i));
        }
        spectrum.learn(row);
    }
}

impl<M: Memory> State<M::Real> for Pending<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        self.spectrum.visit(visitor);
        visitor.reals(self.added.as_mut());
        visitor.reals(self.measured.as_mut());
    }

    fn is_sound(&self) -> bool {
        let (added, measured) = (self.added.as_ref(), self.measured.as_ref());
        let total = added.iter().fold(M::Real::ZERO, |sum, &x| sum + x);
        is_finite(self)
            && added.iter().all(|&x| x >= M::Real::ZERO)
            && total <= M::Real::CEILING
            && dot(measured, measured) <= M::Real::CEILING
            && (total == M::Real::ZERO && !self.spectrum.is_known() || self.spectrum.is_spectrum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{forget, memory, Dense};

    #[test]
    fn silence_leads_to_the_bound_that_is_stated() {
        let (a, b, d, lambda) = (0.5, 0.02, 0.01, 0.95f64);
        let rule = Efra::new(a, b, d).unwrap();
        let phi = Dense::new(1, &[0.0, 0.0]);
        let mut state = rule.start(memory(&phi, 1));
        let mut p = Dense::new(2, &[1.0, 0.3, 0.3, 2.0]);
        for _ in 0..1000 {
            p = forget(&rule, &mut state, &p, &phi, lambda).covariance;
        }
        let g = (1.0 - lambda) / lambda;
        let bound = g / (2.0 * d) * (1.0 + (1.0 + 4.0 * b * d / (g * g)).sqrt());
        assert!(p.distance(&Dense::new(2, &[bound, 0.0, 0.0, bound])) < 1e-12);
    }

    #[test]
    fn the_sample_is_measured_with_its_own_noise() {
        let rule = Efra::new(0.5, 0.0, 0.01).unwrap();
        let phi = Dense::new(1, &[2.0, 0.0]);
        let p = Dense::new(2, &[3.0, 0.0, 0.0, 1.0]);
        let found = forget(&rule, &mut rule.start(memory(&phi, 1)), &p, &phi, 0.9);
        // Γ = 1/a + s (1/a − 1) = 2 + 12
        let expected = Dense::new(1, &[2.0 / 14f64.sqrt(), 0.0]);
        assert!(found.regressors.distance(&expected) < 1e-15);
        let plain = forget(&rule, &mut rule.start(memory(&phi, 1)), &p, &phi, 1.0);
        assert_eq!(plain.regressors.elements, phi.elements);
    }
}
