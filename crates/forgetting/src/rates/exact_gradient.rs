//! Follows the exact gradient of the squared error: how θ would have been with another factor.
//!
//! ```text
//! Ψ = dθ/dλ,  Z = dP/dλ,  both 0 at the start;  l = λ_k,  P = P_{k+1},  M = I − P φ̄ᵀφ̄
//! λ_{k+1} = clip(l + α tr(Ψᵀφ̄ᵀe)/m, smallest, largest)          λ_0 = largest
//! Z ← (M Z Mᵀ − P + P φ̄ᵀφ̄ P)/l
//! Ψ ← M Ψ + Z φ̄ᵀe                                               the new Z, the error before
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | α | step_size | (0, ∞) | 1e-3 |
//! | λ_min | smallest | (0, 1] | 0.9 |
//! | λ_max | largest | [smallest, 1] | 0.9999 |
//!
//! - For the next sample.
//! - Exact for a constant λ and the rule `exponential`; with other rules it is the same recursion.
//! - φ̄ and e are whitened by Γ and weighted: λ does not depend on the units of y. Targets are
//!   averaged.
//! - Should Z or Ψ leave the range of the number type, where P has wound up, both start again at 0.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, errors count as 0.
//! - Cost: O(n³/6 + p n²), for the elements of P. State: Z, Ψ and the next λ, n² + m n + 1 numbers.
//! - Use it for slow drift when n is small; `gradient` costs nothing beside.
//! - Not for jumps: λ follows over many samples. Not for large n, by its cost.
//!
//! Reference: S. Haykin, *Adaptive Filter Theory*, "RLS algorithm with adaptive memory".

use super::gradient::STEP_SIZE;
use super::limits::{largest, SMALLEST};
use super::{Evidence, Limits, Rate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::memory::state::{State, Visitor, is_factor, is_finite};
use crate::covariance::Factor;
use crate::error::Error;
use crate::memory::Memory;
use crate::sample::Sample;
use forgetting_kernels::Real;
use forgetting_kernels::kernel::functions::{add_scaled, dot};

const LARGEST: Parameter = largest(0.9999, Range::FRACTION);

/// The registry entry.
pub const ABOUT: About = About { squares: 1, ..About::new(&[STEP_SIZE, SMALLEST, LARGEST]) };

/// λ down the squared error; see [`self`](crate::rates::exact_gradient).
#[derive(Clone, Copy, Debug)]
pub struct ExactGradient<M: Memory> {
    step_size: M::Real,
    limits: Limits<M::Real>,
}

/// Z, Ψ and the next λ.
#[derive(Clone, Debug)]
pub struct Sensitivity<M: Memory> {
    /// Z, n x n and symmetric
    covariance: M::Square,
    /// Ψ, m x n: one target after the other
    theta: M::Parameters,
    next: M::Real,
    /// work: Pφ̄ᵀ, row by row
    gains: M::Rows,
    /// work: Zφ̄ᵀ, row by row
    products: M::Rows,
    /// work: h_i
    partner: M::Vector,
}

impl<M: Memory> State<M::Real> for Sensitivity<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.covariance.as_mut());
        visitor.reals(self.theta.as_mut());
        visitor.reals(core::slice::from_mut(&mut self.next));
    }

    fn is_sound(&self) -> bool {
        is_finite(self) && is_factor(self.next)
    }
}

impl<M: Memory> Sensitivity<M> {
    /// tr(Ψᵀφ̄ᵀe), summed over targets.
    fn ascent(&self, sample: &Sample<'_, M>) -> M::Real {
        let n = sample.row(0).len();
        (0..sample.rows()).fold(M::Real::ZERO, |sum, i| {
            let targets = self.theta.as_ref().chunks_exact(n).zip(sample.error(i));
            targets.fold(sum, |sum, (theta, &e)| sum + dot(theta, sample.row(i)) * e)
        })
    }

    /// Z ← (M Z Mᵀ − P + P φ̄ᵀφ̄ P)/l = (Z − P − Σ (g_i h_iᵀ + h_i g_iᵀ))/l, with the gains
    /// g_i = Pφ̄_iᵀ, b_i = Zφ̄_iᵀ and h_i = b_i − ½ g_i − ½ Σ_j (φ̄_j b_i) g_j.
    fn follow_covariance(&mut self, factor: &Factor<M>, sample: &Sample<'_, M>, lambda: M::Real) {
        let n = factor.parameters();
        let used = sample.rows() * n;
        let half = M::Real::from_f64(0.5);
        let (gains, products) = (&mut self.gains.as_mut()[..used], self.products.as_mut());
        let (covariance, h) = (self.covariance.as_mut(), self.partner.as_mut());
        for (i, (g, b)) in gains.chunks_exact_mut(n).zip(products.chunks_exact_mut(n)).enumerate() {
            factor.multiply(sample.row(i), g);
            for (b, z) in b.iter_mut().zip(covariance.chunks_exact(n)) {
                *b = dot(z, sample.row(i));
            }
        }
        for (g, b) in gains.chunks_exact(n).zip(products.chunks_exact(n)) {
            h.copy_from_slice(b);
            add_scaled(h, -half, g);
            for (j, other) in gains.chunks_exact(n).enumerate() {
                add_scaled(h, -(half * dot(sample.row(j), b)), other);
            }
            for (i, z) in covariance.chunks_exact_mut(n).enumerate() {
                add_scaled(&mut z[i..], -g[i], &h[i..]);
                add_scaled(&mut z[i..], -h[i], &g[i..]);
            }
        }
        subtract(factor, covariance, h);
        for i in 0..n {
            for j in i..n {
                let z = covariance[i * n + j] / lambda;
                covariance[i * n + j] = z;
                covariance[j * n + i] = z;
            }
        }
    }

    /// Ψ ← M Ψ + Z φ̄ᵀe, with the gains of [`Sensitivity::follow_covariance`].
    fn follow_theta(&mut self, sample: &Sample<'_, M>) {
        let n = sample.row(0).len();
        let (products, covariance) = (self.products.as_mut(), self.covariance.as_ref());
        for (i, b) in products.chunks_exact_mut(n).enumerate().take(sample.rows()) {
            for (b, z) in b.iter_mut().zip(covariance.chunks_exact(n)) {
                *b = dot(z, sample.row(i));
            }
        }
        for (target, theta) in self.theta.as_mut().chunks_exact_mut(n).enumerate() {
            let before = self.partner.as_mut();
            before.copy_from_slice(theta);
            let columns = self.gains.as_ref().chunks_exact(n).zip(products.chunks_exact(n));
            for (i, (g, b)) in columns.enumerate().take(sample.rows()) {
                add_scaled(theta, -dot(sample.row(i), before), g);
                add_scaled(theta, sample.error(i)[target], b);
            }
        }
    }

    /// Starts again at 0 if a number has left the range of its type.
    fn restart_if_lost(&mut self) {
        let (covariance, theta) = (self.covariance.as_mut(), self.theta.as_mut());
        let lost = |x: &M::Real| !(x.abs() <= M::Real::CEILING);
        if covariance.iter().any(lost) || theta.iter().any(lost) {
            covariance.fill(M::Real::ZERO);
            theta.fill(M::Real::ZERO);
        }
    }
}

/// The upper triangle of `matrix` −= that of P = Σ_j D_j u_j u_jᵀ and what is deferred, O(n³/6).
fn subtract<M: Memory>(factor: &Factor<M>, matrix: &mut [M::Real], u: &mut [M::Real]) {
    let n = factor.parameters();
    for (j, &d) in factor.diagonal_elements().iter().enumerate() {
        factor.get_column(j, u);
        let u = &u[..j];
        for (i, &x) in u.iter().enumerate() {
            let row = &mut matrix[i * n + i..];
            add_scaled(row, -(d * x), &u[i..]);
            row[j - i] -= d * x;
        }
        matrix[j * n + j] -= d;
    }
    factor.subtract_deferred(matrix);
}

impl<M: Memory> ExactGradient<M> {
    /// With the step size α.
    ///
    /// # Errors
    /// [`Error::Value`] unless `step_size` is positive.
    pub fn new(step_size: M::Real, limits: Limits<M::Real>) -> Result<Self, Error> {
        Ok(Self { step_size: STEP_SIZE.check(step_size)?, limits })
    }
}

impl<M: Memory> Rate<M> for ExactGradient<M> {
    type State = Sensitivity<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(STEP_SIZE.number(values)?, Limits::configure(values, &LARGEST)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(STEP_SIZE.name, Value::Real(self.step_size.to_f64()));
        self.limits.describe(each);
    }

    fn start(&self, memory: M) -> Self::State {
        Sensitivity {
            covariance: memory.square(),
            theta: memory.theta(),
            next: self.limits.largest(),
            gains: memory.regressors(),
            products: memory.regressors(),
            partner: memory.vector(),
        }
    }

    fn change_units(&self, state: &mut Self::State, ratios: &[M::Real]) {
        let rows = state.covariance.as_mut().chunks_exact_mut(ratios.len());
        for (row, &own) in rows.zip(ratios) {
            row.iter_mut().zip(ratios).for_each(|(z, &other)| *z *= own * other);
        }
        for theta in state.theta.as_mut().chunks_exact_mut(ratios.len()) {
            theta.iter_mut().zip(ratios).for_each(|(slope, &ratio)| *slope *= ratio);
        }
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn forgetting_factor(
        &self,
        state: &Self::State,
        _: &Evidence<'_, '_, M>,
    ) -> Result<M::Real, Error> {
        Ok(self.limits.clip(state.next))
    }

    fn learn(&self, state: &mut Self::State, evidence: &Evidence<'_, '_, M>, lambda: M::Real) {
        let Evidence { sample, factor, .. } = *evidence;
        let ascent = evidence.standardized(state.ascent(sample));
        let ascent = ascent / M::Real::from_f64(evidence.targets as f64);
        state.next = self.limits.clip(state.next + self.step_size * ascent);
        state.follow_covariance(factor, sample, lambda);
        state.follow_theta(sample);
        state.restart_if_lost();
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{ExactGradient, Limits};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Dynamic;
    use crate::rates::Constant;
    use crate::rules::Exponential;
    use crate::weightings::Equal;
    use std::vec::Vec;

    fn sample(k: u32) -> ([f64; 6], [f64; 4]) {
        let phi = core::array::from_fn(|i| libm::sin(f64::from(k * 7 + i as u32 * 3)));
        (phi, core::array::from_fn(|i| libm::cos(f64::from(k * 5 + i as u32))))
    }

    /// θ and P after twelve samples of two rows and two targets.
    fn end(lambda: f64) -> (Vec<f64>, Vec<f64>) {
        let prior = Prior::scalar(Dynamic::new(3, 2, 2).unwrap(), 1.0).unwrap();
        let rate = Constant::new(lambda).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        for k in 0..12 {
            let (phi, y) = sample(k);
            estimator.update(&phi, &y).unwrap();
        }
        let mut covariance = std::vec![0.0; 9];
        estimator.factor().reconstruct(&mut covariance);
        (estimator.theta().to_vec(), covariance)
    }

    #[test]
    fn its_slopes_are_those_of_differences() {
        let prior = Prior::scalar(Dynamic::new(3, 2, 2).unwrap(), 1.0).unwrap();
        let rate = ExactGradient::new(1e-3, Limits::new(0.95, 0.95).unwrap()).unwrap();
        let mut estimator = Estimator::new(Exponential::new(), rate, Equal::new(), prior);
        for k in 0..12 {
            let (phi, y) = sample(k);
            estimator.update(&phi, &y).unwrap();
        }
        let step = 1e-6;
        let ((theta_up, up), (theta_down, down)) = (end(0.95 + step), end(0.95 - step));
        let state = estimator.rate_state();
        let close = |slopes: &[f64], up: &[f64], down: &[f64]| {
            for ((slope, up), down) in slopes.iter().zip(up).zip(down) {
                assert!((slope - (up - down) / (2.0 * step)).abs() < 1e-7, "{slope}");
            }
        };
        close(&state.theta, &theta_up, &theta_down);
        close(&state.covariance, &up, &down);
        assert!(state.theta.iter().any(|slope| slope.abs() > 0.01));
    }
}
