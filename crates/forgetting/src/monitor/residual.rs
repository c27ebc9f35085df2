//! The noise that the innovations show, and whether they are white.

use super::Seen;
use crate::state::{is_finite, State, Visitor};
use crate::Real;

/// Sums over normalized innovations, weighted with the products of λ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residual<T> {
    /// Σ 1
    pub weight: T,
    squares: T,
    products: T,
    previous: T,
}

impl<T: Real> Residual<T> {
    /// Of no sample.
    pub fn new() -> Self {
        let zero = T::ZERO;
        Self { weight: zero, squares: zero, products: zero, previous: zero }
    }

    /// Takes note of a sample, inside a kernel.
    #[inline(always)]
    pub fn note(&mut self, seen: &Seen<'_, T>) {
        let Seen { rows, errors, squared_error, leverage, forgetting_factor: lambda, .. } = *seen;
        let spread = T::ONE + average(leverage, rows);
        if spread > T::from_f64(2.0) {
            return; // more uncertain of the parameters than of the noise: it tells nothing of noise
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

#[inline(always)]
fn average<T: Real>(x: T, count: usize) -> T {
    if count == 1 {
        x
    } else {
        x / T::from_f64(count as f64)
    }
}

impl<T: Real> State<T> for Residual<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        for number in [&mut self.weight, &mut self.squares, &mut self.products, &mut self.previous]
        {
            visitor.reals(core::slice::from_mut(number));
        }
    }

    fn is_sound(&self) -> bool {
        is_finite(self) && self.weight >= T::ZERO && self.squares >= T::ZERO
    }
}
