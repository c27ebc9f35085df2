//! Trusts a sample less the larger its error, as if the noise had Student's t distribution.
//!
//! ```text
//! r_k = ‖ē_k‖ over the rows, of the target where it is longest     ē = Γ^(−1/2)(y − φθ)
//! w_k = min(1, (ν + p)/(ν + r_k²))                                 Γ ← Γ/w
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | ν | degrees | (0, ∞) | 4 |
//!
//! - Bounded influence: w r ≤ c, with c = (ν + p)/(2√ν) at r = √ν, or √p at r = √p if ν < p. One
//!   sample moves θ_i of any target by at most c ‖(P̄φ̄ᵀ)_i‖ ≤ c √(P̄_ii tr φ̄P̄φ̄ᵀ), whatever y is;
//!   see `huber`. Beyond that r the influence falls again, to 0 as 1/r.
//! - w is the weight of the maximum likelihood estimate, but never above 1: that would trust a
//!   sample more than its Γ says.
//! - Rates see the clipped error w ē.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, w = 1.
//! - Cost: O(p m). State: none.
//! - Use it when gross errors are so large that even a clipped one disturbs; `huber` loses less
//!   when there are none. After a jump of θ it takes longer to believe.
//! - Not where a large error is news: a jump of θ is taken for gross errors, and hardly followed
//!   at first.
//!
//! Reference: K. L. Lange, R. J. A. Little, J. M. G. Taylor, *Robust statistical modeling using the
//! t distribution*, Journal of the American Statistical Association 84(408), 1989.

use super::Weighting;
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::sample::Evidence;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const DEGREES: Parameter = Parameter::real(
    "degrees",
    4.0,
    Range::POSITIVE,
    "degrees of freedom of the noise; the fewer, the heavier its tails",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[DEGREES]);

/// w = min(1, (ν + p)/(ν + r²)); see [`self`](crate::weightings::student_t).
#[derive(Clone, Copy, Debug)]
pub struct StudentT<M: Memory> {
    degrees: M::Real,
}

impl<M: Memory> StudentT<M> {
    /// With ν degrees of freedom.
    ///
    /// # Errors
    /// [`Error::Value`] unless `degrees` is positive.
    pub fn new(degrees: M::Real) -> Result<Self, Error> {
        Ok(Self { degrees: DEGREES.check(degrees)? })
    }
}

impl<M: Memory> Weighting<M> for StudentT<M> {
    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(DEGREES.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(DEGREES.name, Value::Real(self.degrees.to_f64()));
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn weight(&self, evidence: &Evidence<'_, '_, M>) -> M::Real {
        let (nu, p) = (self.degrees, M::Real::from_f64(evidence.rows as f64));
        let squared = evidence.standardized(evidence.largest_squared_error());
        let w = (nu + p) / (nu + squared);
        w.max(M::Real::FLOOR).min(M::Real::ONE)
    }

    fn influence(&self, rows: usize) -> Option<M::Real> {
        let (nu, p) = (self.degrees, M::Real::from_f64(rows as f64));
        Some(if nu < p { p.sqrt() } else { (nu + p) / (nu.sqrt() + nu.sqrt()) })
    }
}

#[cfg(test)]
mod tests {
    use super::{StudentT, Weighting};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Fixed;
    use crate::rates::Constant;
    use crate::rules::NoForgetting;

    /// ν = 4, r = 4: w = 5/20, P₊ = 1/(1 + w), θ₊ = P₊ w 4; r = ½: w = 1, not 5/4.25.
    #[test]
    fn weighs_by_the_error() {
        for (y, weight) in [(4.0, 0.25), (0.5, 1.0)] {
            let memory = Fixed::<f64, 1>::new();
            let (rate, prior) = (Constant::new(1.0).unwrap(), Prior::scalar(memory, 1.0).unwrap());
            let student = StudentT::new(4.0).unwrap();
            let mut estimator = Estimator::new(NoForgetting::new(), rate, student, prior);
            let update = estimator.update(&[1.0], &[y]).unwrap();
            assert!((update.leverage - weight).abs() < 1e-15);
            assert!((estimator.theta()[0] - weight * y / (1.0 + weight)).abs() < 1e-15);
        }
    }

    #[test]
    fn its_influence_is_largest_where_the_header_says() {
        for (nu, rows) in [(4.0, 1), (4.0, 3), (1.0, 4), (0.5, 2)] {
            let weighting = StudentT::<Fixed<f64, 1>>::new(nu).unwrap();
            let c = Weighting::influence(&weighting, rows).unwrap();
            let w = |r: f64| ((nu + rows as f64) / (nu + r * r)).min(1.0);
            let most = (0..100_000)
                .map(|k| f64::from(k) * 1e-4)
                .fold(0.0f64, |most, r| most.max(w(r) * r));
            assert!(most <= c * (1.0 + 1e-12) && most > c * (1.0 - 1e-4), "{most} is not {c}");
        }
    }
}
