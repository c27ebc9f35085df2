//! The noise that the innovations show, and whether they are white.

use super::Observation;
use crate::number::Real;

/// Sums over normalized innovations, weighted with the products of λ.
#[derive(Clone, Copy, Debug)]
pub struct Residual<T> {
    /// Σ 1
    pub weight: T,
    /// Σ ν², of innovations ν over their standard deviation in units of the noise's
    pub squares: T,
    /// Σ ν ν of the sample before
    pub products: T,
    /// ν of the last sample
    pub previous: T,
}

impl<T: Real> Residual<T> {
    /// Of no sample.
    pub fn new() -> Self {
        let zero = T::ZERO;
        Self { weight: zero, squares: zero, products: zero, previous: zero }
    }

    /// Notes a sample, inside a kernel.
    #[inline(always)]
    pub fn note(&mut self, sample: &Observation<'_, T>) {
        let Observation { rows, errors, squared_error, leverage, forgetting_factor, .. } = *sample;
        let (lambda, spread) = (forgetting_factor, T::ONE + average(leverage, rows));
        if spread > T::from_f64(2.0) {
            return; // more uncertain of the parameters than of the noise: it says nothing of noise
        }
        let inverse = T::ONE / spread;
        // neither the quotient nor the root waits for the other
        let innovation = errors[0] * (inverse * spread.sqrt());
        let square = average(squared_error, errors.len()) * inverse;
        self.weight = lambda.mul_add(self.weight, T::ONE);
        self.squares = lambda.mul_add(self.squares, square);
        self.products = lambda.mul_add(self.products, innovation * self.previous);
        self.previous = innovation;
    }

    /// Of the noise.
    pub fn variance(&self) -> T {
        self.squares / self.weight
    }

    /// Of one innovation with the next.
    pub fn correlation(&self) -> T {
        self.products / self.squares
    }
}

impl<T: Real> Default for Residual<T> {
    fn default() -> Self {
        Self::new()
    }
}

#[inline(always)]
fn average<T: Real>(x: T, count: usize) -> T {
    if count == 1 {
        x
    } else {
        x / T::from_f64(count as f64)
    }
}
