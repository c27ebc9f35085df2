//! One sample of a factor that is kept in as few numbers as there are: of U only what is above its
//! diagonal, column after column.
//!
//! It takes the sums of [`super::runs`] in the same order, and so gives the same bits. There is one copy
//! of the loop, which looks after D near its floor in every sample: it is for machines with little
//! memory.

use super::form::Form;
use super::measure::bounds::Bounds;
use super::measure::forms::{along, scale, walk};
use super::outcome::Outcome;
use super::registers::{Small, Unit};
use super::runs::{accepts, left_out};
use super::vectors::few_products;
use crate::number::Real;
use core::cmp::Ordering;

/// How many numbers of U are above the diagonal of n columns.
pub const fn triangle(n: usize) -> usize {
    n * n.saturating_sub(1) / 2
}

/// U above its diagonal: column c begins at c (c − 1)/2.
struct Triangle<'a, T>(&'a mut [T]);

impl<T: Real, const N: usize> Unit<T, N> for Triangle<'_, T> {
    #[inline(always)]
    fn get(&self, c: usize, i: usize) -> T {
        self.0.get(triangle(c) + i).copied().unwrap_or(T::ZERO)
    }
    #[inline(always)]
    fn set(&mut self, c: usize, i: usize, u: T) {
        if let Some(place) = self.0.get_mut(triangle(c) + i) {
            *place = u;
        }
    }
    #[inline(always)]
    fn last_pass(&mut self, _: &[T; N]) {}
}

/// P and θ of `N` parameters, at most ten.
#[derive(Debug)]
pub struct Compact<'a, T, const N: usize> {
    /// [`triangle`] of N numbers: U above its diagonal, column after column
    pub triangle: &'a mut [T],
    /// D
    pub diagonal: &'a mut [T; N],
    /// at least the trace of P
    pub bound: &'a mut T,
    /// θ
    pub theta: &'a mut [T; N],
}

impl<T: Real, const N: usize> Compact<'_, T, N> {
    /// Forgets, measures and corrects. A sample whitened elsewhere comes with its whitened error, which
    /// is then what is reported; `y` is not read.
    ///
    /// Nothing is forgotten where P would leave the range of the number type, and nothing has changed,
    /// without an outcome, where the error or ‖φ‖² is beyond it.
    // always, so that what calls it with one form compiles that one only
    #[inline(always)]
    pub fn take(
        &mut self,
        form: Form<T>,
        (phi, y): (&[T; N], T),
        whitened: Option<T>,
    ) -> Option<Outcome<T>> {
        let (product, squares) = few_products::<T, T, N>(phi, self.theta);
        let error = whitened.unwrap_or(y - product);
        if !accepts(error, squares) {
            return None;
        }
        let (sample, before) = ((phi, squares), *self.bound);
        for tight in [false, true] {
            if tight {
                *self.bound = self.trace();
            }
            let outcome = self.measure(form, sample, error);
            if outcome.is_some() {
                return outcome;
            }
        }
        // there is room for what does not grow
        *self.bound = T::ZERO;
        let outcome = self.measure(Form::NOTHING, sample, error);
        *self.bound = before;
        outcome
    }

    /// The trace of P.
    #[inline]
    pub fn trace(&mut self) -> T {
        Small { u: Triangle(&mut *self.triangle), d: *self.diagonal }.trace::<T>()
    }

    /// The element of U at row i and column j.
    #[inline]
    pub fn unit(&self, i: usize, j: usize) -> T {
        match i.cmp(&j) {
            Ordering::Less => self.triangle.get(triangle(j) + i).copied().unwrap_or(T::ZERO),
            Ordering::Equal => T::ONE,
            Ordering::Greater => T::ZERO,
        }
    }

    #[inline(always)]
    fn measure(
        &mut self,
        form: Form<T>,
        (f, squares): (&[T; N], T),
        error: T,
    ) -> Option<Outcome<T>> {
        let mut small = Small { u: Triangle(&mut *self.triangle), d: *self.diagonal };
        if form.leaves_out(squares) {
            return Some(left_out(&small, error, f));
        }
        let bounds = &mut Bounds { tight: *self.bound, kept: &mut *self.bound };
        let (sample, least) = ((f, squares), T::FLOOR);
        let (gain, forgot) = match form {
            Form::Scale { growth } => {
                scale::<T, T, _, N, true>(&mut small, bounds, growth, sample, least)?
            }
            Form::Along { weight, .. } => {
                along::<T, T, _, N, true>(&mut small, bounds, weight, sample, least)?
            }
            Form::Walk { noise, per_bound } => {
                let noise = (noise, per_bound);
                walk::<T, T, T, _, N, true>(&mut small, bounds, noise, sample, least)?
            }
        };
        *self.diagonal = small.d;
        let step = error * gain.inverse_a;
        for i in 0..N {
            self.theta[i] = step.mul_add(gain.k[i], self.theta[i]);
        }
        let (leverage, largest) = (gain.s, gain.largest);
        Some(Outcome { error, leverage, largest, forgot, used: true, windup: false })
    }
}
