//! Samples of one row and one target, one after the other, when nothing happens between the
//! arrival of a sample and its use.

#![allow(clippy::needless_range_loop, reason = "constant bounds unroll")]

use super::block::with_width;
use super::layout::BLOCK;
use super::long::{add_scaled_by, few_products, products};
use super::measure::{many, Place};
use super::small::Small;
use super::triangular::leverage_of;
use super::{bierman::largest, Told};
use crate::factor::Form;
use crate::vector::Vector;
use crate::{Kernel, Real};

/// Takes the samples until one is to be refused, or P needs more room; returns how many it took.
pub struct Steps<'a, T> {
    pub place: Place<'a, T>,
    pub form: Form<T>,
    /// n numbers a sample
    pub phi: &'a [T],
    pub y: &'a [T],
    pub theta: &'a mut [T],
    /// one for each sample at most
    pub told: &'a mut [Told<T>],
    /// n numbers a sample, or none: θ after it
    pub thetas: &'a mut [T],
}

impl<T: Real> Kernel<T> for Steps<'_, T> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.theta.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> usize {
        let n = self.theta.len();
        if n <= BLOCK {
            with_width!(n, few::<T>(&mut self)).unwrap_or(0)
        } else {
            one_by_one::<T, V, GROUP>(&mut self)
        }
    }
}

/// Whether a sample with this error and ‖φ‖² is one to use: not if either is NaN.
#[inline(always)]
fn accepts<T: Real>(error: T, squares: T) -> bool {
    (error.abs() <= T::CEILING) & (squares <= T::CEILING)
}

impl<T: Real> Form<T> {
    #[inline(always)]
    fn leaves_out(self, squares: T) -> bool {
        matches!(self, Self::Along { dead_zone, .. } if dead_zone.holds(squares))
    }
}

/// For at most eight parameters: U, D and θ stay in registers.
#[inline(always)]
fn few<T: Real, const N: usize>(task: &mut Steps<'_, T>) -> Option<usize> {
    let Steps { place, form, phi, y, theta, told, thetas } = task;
    let mut small = Small::<T, N>::load(place.columns, place.diagonal.first_chunk()?);
    let theta = theta.first_chunk_mut::<N>()?;
    let (regressors, _) = phi.as_chunks::<N>();
    let mut after = thetas.as_chunks_mut::<N>().0.iter_mut();
    let mut taken = 0;
    for ((f, &y), told) in regressors.iter().zip(*y).zip(told.iter_mut()) {
        let (product, squares) = few_products(f, theta);
        let error = y - product;
        if !accepts(error, squares) {
            break;
        }
        if form.leaves_out(squares) {
            *told = small.left_out(error, f);
        } else {
            let Some((gain, forgot)) = small.take(place, *form, f, squares) else { break };
            let step = error * gain.inverse_a;
            for i in 0..N {
                theta[i] = step.mul_add(gain.k[i], theta[i]);
            }
            *told = Told { error, leverage: gain.s, largest: gain.largest, forgot, used: true };
        }
        if let Some(after) = after.next() {
            *after = *theta;
        }
        taken += 1;
    }
    small.store(place.columns, place.diagonal.first_chunk_mut()?);
    Some(taken)
}

impl<T: Real, const N: usize> Small<T, N> {
    #[inline(never)]
    fn left_out(&self, error: T, f: &[T; N]) -> Told<T> {
        let leverage = self.leverage(f);
        Told { error, leverage, largest: largest(&self.d), forgot: false, used: false }
    }
}

/// For more than eight.
#[inline(always)]
fn one_by_one<T: Real, V: Vector<T>, const GROUP: usize>(task: &mut Steps<'_, T>) -> usize {
    let Steps { place, form, phi, y, theta, told, thetas } = task;
    let n = theta.len();
    let mut after = thetas.chunks_exact_mut(n);
    let mut taken = 0;
    for ((f, &y), told) in phi.chunks_exact(n).zip(*y).zip(told.iter_mut()) {
        let (product, squares) = products::<T, V>(f, theta);
        let error = y - product;
        if !accepts(error, squares) {
            break;
        }
        if form.leaves_out(squares) {
            let leverage = leverage_of::<T, V, GROUP>(place.columns, place.diagonal, f);
            let largest = largest(place.diagonal);
            *told = Told { error, leverage, largest, forgot: false, used: false };
        } else {
            let Some(measured) = many::<T, V, GROUP>(place, *form, f, squares) else { break };
            let step = error * measured.inverse_variance;
            add_scaled_by::<T, V>(theta, step, &place.scratch[..n]);
            *told = Told::used(error, &measured);
        }
        if let Some(after) = after.next() {
            after.copy_from_slice(theta);
        }
        taken += 1;
    }
    taken
}
