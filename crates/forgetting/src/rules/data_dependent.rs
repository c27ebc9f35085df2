//! Weighs each sample by what it can tell given a bound on the noise, and forgets in proportion.
//!
//! ```text
//! R_{k+1} = (1 − μ_k) R_k + μ_k φ̄_kᵀ φ̄_k         GF-RLS (45)
//! θ_{k+1} = θ_k + μ_k P_{k+1} φ̄_kᵀ ē_k           (46)
//! F_k = μ_k R_k with Γ_k = I/μ_k                 the form used: D ← D/(1 − μ), φ̄ and ē times √μ
//! σ²_{k+1}(μ) = (1 − μ) σ²_k + μ γ² − μ (1 − μ) Σ_i c_i² / (1 − μ + μ w_i)
//! ```
//!
//! θ is known to lie in {t : (t − θ_k)ᵀ R_k (t − θ_k) ≤ σ²_k}. μ_k in [0, a] makes σ²_{k+1} as small
//! as it can be; w_i are the eigenvalues of φ̄ P φ̄ᵀ and c_i the errors in its eigenvectors (c_i² is
//! the mean over the targets). If σ² + ‖ē‖² ≤ γ², μ = 0: the sample is left out (`within_bound`).
//! Else, for one row with G = φ̄ P φ̄ᵀ, δ = ē² + σ² − γ² and C = δ + (γ² − σ²) G,
//! μ = min(a, δ / (C + √(C G ē²))), and a if C ≤ 0; for several rows μ is found by bisection of the
//! slope of σ²(μ), which does not decrease. The printed (50), Γ = I with
//! λ_k = (1 − μ_k) μ_{k−1}/μ_k, is undefined at μ = 0 and not proper when μ falls fast.
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | γ | noise_bound | (0, ∞) | 1 |
//! | a | largest_weight | (0, 1) | 0.5 |
//! | σ₀ | initial_radius | (0, ∞) | 1 |
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. Silence with errors beyond the bound winds up.
//! - P bounded below (A3): if φ is bounded: R_k ≤ max(β, λ_max(R₀)) I for φ̄ᵀφ̄ ≤ β I.
//! - Cost: O(p n²). State: P and σ². It sets its own forgetting factor 1 − μ; no rate.
//! - Use it when a bound on the noise is known but not its distribution. σ² < 0 means that the
//!   noise has broken its bound; the formulas go on.
//!
//! Reference: S. Dasgupta, Y.-F. Huang, *Asymptotically convergent modified recursive least
//! squares with data-dependent updating and forgetting factor for systems with bounded noise*,
//! IEEE Transactions on Information Theory 33, 1987.

use super::ellipsoid::Terms;
use super::{Forgetting, Forgotten, Skip, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value,
    Values,
};
use crate::memory::state::{State, Visitor};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;
use forgetting_kernels::Kernels;

const NOISE_BOUND: Parameter = Parameter::real(
    "noise_bound",
    1.0,
    Range::POSITIVE,
    "largest length of the whitened noise of a sample (units of y over those of sqrt(gamma))",
);
const LARGEST_WEIGHT: Parameter = Parameter::real(
    "largest_weight",
    0.5,
    Range::INNER_FRACTION,
    "largest weight of a sample; the forgetting factor is at least 1 less that",
);
const INITIAL_RADIUS: Parameter = Parameter::real(
    "initial_radius",
    1.0,
    Range::POSITIVE,
    "largest distance of theta from its initial value, in the norm of the inverse of P_0",
);

/// The registry entry.
pub const ABOUT: About = About {
    cost: "O(p n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(Setting { error: 1e6, ..Setting::usual(Input::Silent) }),
        bounded_below: Guarantee::when("regressors bounded", Setting::usual(Input::Scaled(1e6))),
    }),
    ..About::new(&[NOISE_BOUND, LARGEST_WEIGHT, INITIAL_RADIUS])
};

/// Weighs by a bound on the noise; see [`self`](crate::rules::data_dependent).
#[derive(Clone, Copy, Debug)]
pub struct DataDependent<M: Memory> {
    noise_bound: M::Real,
    largest_weight: M::Real,
    initial_radius: M::Real,
}

/// σ².
#[derive(Clone, Debug)]
pub struct Ellipsoid<M: Memory> {
    squared_radius: M::Real,
    /// not state: the errors in the eigenvectors of φ̄ P φ̄ᵀ
    rotated: M::Errors,
}

impl<M: Memory> State<M::Real> for Ellipsoid<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(core::slice::from_mut(&mut self.squared_radius));
    }
}

impl<M: Memory> DataDependent<M> {
    /// With a bound on the length of the whitened noise, a largest weight and the distance
    /// within which θ is believed to be.
    ///
    /// # Errors
    /// [`Error::Value`] names the parameter that is out of range.
    pub fn new(
        noise_bound: M::Real,
        largest_weight: M::Real,
        initial_radius: M::Real,
    ) -> Result<Self, Error> {
        Ok(Self {
            noise_bound: bounded(&NOISE_BOUND, noise_bound)?,
            largest_weight: LARGEST_WEIGHT.check(largest_weight)?,
            initial_radius: bounded(&INITIAL_RADIUS, initial_radius)?,
        })
    }
}

/// The value, if it is in range and so is its square.
fn bounded<T: Kernels>(parameter: &Parameter, value: T) -> Result<T, Error> {
    let value = parameter.check(value)?;
    let squared = value * value;
    if squared > T::ZERO && squared <= T::CEILING {
        return Ok(value);
    }
    Err(Error::value(parameter.name, value.to_f64(), "numbers with a square in range"))
}

impl<M: Memory> Forgetting<M> for DataDependent<M> {
    type State = Ellipsoid<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(
            NOISE_BOUND.number(values)?,
            LARGEST_WEIGHT.number(values)?,
            INITIAL_RADIUS.number(values)?,
        )
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(NOISE_BOUND.name, Value::Real(self.noise_bound.to_f64()));
        each(LARGEST_WEIGHT.name, Value::Real(self.largest_weight.to_f64()));
        each(INITIAL_RADIUS.name, Value::Real(self.initial_radius.to_f64()));
    }

    fn start(&self, memory: M) -> Ellipsoid<M> {
        Ellipsoid {
            squared_radius: self.initial_radius * self.initial_radius,
            rotated: memory.errors(),
        }
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        Bounds { below: positive(1.0 / constants.regressor_bound), above: None }
    }

    #[inline]
    fn forget(&self, state: &mut Ellipsoid<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let bound = self.noise_bound * self.noise_bound;
        let margin = bound - state.squared_radius;
        let rotated = state.rotated.as_mut();
        let terms = Terms::of(step.factor, step.sample, step.work.first.as_mut(), rotated);
        let excess = terms.squared_error() - margin;
        if !(excess > M::Real::ZERO) {
            return Ok(Forgotten::skipped(Skip::WithinBound).with_factor(1.0));
        }
        let mu = terms.best_weight(margin, excess, self.largest_weight);
        if !(mu > M::Real::ZERO) {
            return Ok(Forgotten::skipped(Skip::WithinBound).with_factor(1.0));
        }
        let kept = M::Real::ONE - mu;
        step.factor.scale(M::Real::ONE / kept)?;
        let gained = mu * kept * terms.sum(|c, w| c / (kept + mu * w));
        let after = kept * state.squared_radius + mu * bound - gained;
        state.squared_radius = after.max(-M::Real::CEILING);
        step.sample.scale(mu.sqrt());
        Ok(Forgotten::rank(step.factor.parameters()).with_factor(kept.to_f64()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget_with_errors, memory, two_rows, Dense};

    /// σ²(μ), straight from the header, with the inverse in the place of eigenvectors.
    fn radius(p: &Dense, phi: &Dense, e: &Dense, (sigma, gamma): (f64, f64), mu: f64) -> f64 {
        let s = phi.clone() * p.clone() * phi.transpose();
        let inner = (1.0 - mu) * Dense::identity(s.rows) + mu * s;
        let gained = (e.transpose() * inner.inverse() * e.clone()).trace() / e.columns as f64;
        (1.0 - mu) * sigma + mu * gamma - mu * (1.0 - mu) * gained
    }

    fn check(phi: &Dense, e: &Dense, largest: f64) {
        let (p, m) = (covariance(), memory(phi, e.columns));
        let rule = DataDependent::new(0.7, largest, 1.1).unwrap();
        let mut state = Forgetting::<Dynamic<f64>>::start(&rule, m);
        let outcome = forget_with_errors(&rule, &mut state, &p, (phi, e), 1.0);
        let mu = 1.0 - outcome.forgotten.forgetting_factor.unwrap();
        assert!(mu > 0.0 && mu <= largest);
        let at = |mu| radius(&p, phi, e, (1.21, 0.49), mu);
        assert!((state.squared_radius - at(mu)).abs() < 1e-13);
        for other in (0..=1000).map(|k| largest * f64::from(k) / 1000.0) {
            assert!(at(mu) <= at(other) + 1e-13, "mu = {mu}, better: {other}");
        }
        // R ← (1 − μ) R, and √μ φ is measured
        assert!(
            (p.inverse().trace() * (1.0 - mu) - outcome.covariance.inverse().trace()).abs() < 1e-13
        );
        assert!(outcome.regressors.distance(&(mu.sqrt() * phi.clone())) < 1e-15);
    }

    use crate::memory::Dynamic;

    #[test]
    fn the_weight_makes_the_ellipsoid_smallest() {
        let row = Dense::new(1, &[0.8, -0.2, 1.1]);
        check(&row, &Dense::new(1, &[1.7]), 0.5);
        check(&row, &Dense::new(1, &[3.0, -0.1]), 0.9);
        check(&row, &Dense::new(1, &[40.0]), 0.1);
        check(&two_rows(), &Dense::new(2, &[1.7, -0.9]), 0.5);
        check(&two_rows(), &Dense::new(2, &[1.7, 0.3, -0.9, 2.0]), 0.9);
        check(&(0.1 * two_rows()), &Dense::new(2, &[0.6, 0.0]), 0.99);
    }

    #[test]
    fn a_sample_within_the_bound_is_left_out() {
        let phi = Dense::new(1, &[0.8, -0.2, 1.1]);
        let rule = DataDependent::new(2.0, 0.5, 1.0).unwrap();
        let mut state = Forgetting::<Dynamic<f64>>::start(&rule, memory(&phi, 1));
        let errors = Dense::new(1, &[3f64.sqrt() * (1.0 - 1e-9)]);
        let outcome = forget_with_errors(&rule, &mut state, &covariance(), (&phi, &errors), 1.0);
        assert_eq!(outcome.forgotten.skipped, Some(Skip::WithinBound));
        assert_eq!(state.squared_radius, 1.0);
    }
}
