//! Samples of one row and one target, one after the other, when nothing happens between the
//! arrival of a sample and its use.

#![allow(clippy::needless_range_loop, reason = "constant bounds unroll")]

use super::batch::{admits, measure_batch, BATCH, BATCH_FROM};
use super::layout::FEW;
use super::long::{add_scaled_by, few_products, products};
use super::measure::{many as measure_many, take, Place};
use super::small::Small;
use super::triangular::leverage_of;
use super::{bierman::largest, Told};
use crate::factor::Form;
use crate::vector::Vector;
use crate::{Kernel, One, Real};

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
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP < 8 && n <= FEW {
            match n {
                // less arithmetic than waiting for it
                1 => few::<T, V::One, 1>(&mut self),
                2 => few::<T, V::One, 2>(&mut self),
                3 => few::<T, V::One, 3>(&mut self),
                4 => few::<T, V::One, 4>(&mut self),
                _ => with_few!(n, few::<T, T>(&mut self)),
            }
            .unwrap_or(0)
        } else {
            many::<T, V, GROUP>(&mut self)
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

/// For at most ten parameters: U, D and θ stay in registers.
#[inline(always)]
fn few<T: Real, A: One<T>, const N: usize>(task: &mut Steps<'_, T>) -> Option<usize> {
    let Steps { place, form, phi, y, theta, told, thetas } = task;
    let mut small = Small::<A, N>::load(place.columns, place.diagonal.first_chunk()?);
    let theta = theta.first_chunk_mut::<N>()?;
    let mut now = theta.map(A::splat);
    let mut after = thetas.as_chunks_mut::<N>().0.iter_mut();
    let mut taken = 0;
    for ((f, &y), told) in phi.as_chunks::<N>().0.iter().zip(*y).zip(told.iter_mut()) {
        let f = f.map(A::splat);
        let (product, squares) = few_products(&f, &now);
        let (error, squares) = (y - product.get(), squares.get());
        if !accepts(error, squares) {
            break;
        }
        if form.leaves_out(squares) {
            *told = left_out(&small, error, &f);
        } else {
            let Some((gain, forgot)) = take(&mut small, place, *form, &f, squares) else {
                break;
            };
            let step = A::splat(error) * gain.inverse_a;
            for i in 0..N {
                now[i] = step.mul_add(gain.k[i], now[i]);
            }
            let (leverage, largest) = (gain.s.get(), gain.largest.get());
            *told = Told { error, leverage, largest, forgot, used: true, windup: false };
        }
        if let Some(after) = after.next() {
            *after = now.map(One::get);
        }
        taken += 1;
    }
    *theta = now.map(One::get);
    small.store(place.columns, place.diagonal.first_chunk_mut()?);
    Some(taken)
}

/// A sample in the dead zone.
#[inline(always)]
fn left_out<T: Real, A: One<T>, const N: usize>(
    small: &Small<A, N>,
    error: T,
    f: &[A; N],
) -> Told<T> {
    let (leverage, d) = (small.leverage(f).get(), small.d.map(One::get));
    Told { error, leverage, largest: largest(&d), forgot: false, used: false, windup: false }
}

/// For more than ten.
#[inline(always)]
fn many<T: Real, V: Vector<T>, const GROUP: usize>(task: &mut Steps<'_, T>) -> usize {
    let (n, most) = (task.theta.len(), task.told.len().min(task.y.len()));
    let mut taken = 0;
    while taken < most {
        let mut took = 0;
        if let Form::Scale { growth } = task.form {
            if n >= BATCH_FROM && most - taken >= BATCH {
                took = batch::<T, V, GROUP>(task, taken, growth);
            }
        }
        if took == 0 {
            took = usize::from(single::<T, V, GROUP>(task, taken).is_some());
        }
        if took == 0 {
            break;
        }
        taken += took;
    }
    taken
}

/// The sample at `at`, if it is one to take.
#[inline(always)]
fn single<T: Real, V: Vector<T>, const GROUP: usize>(
    task: &mut Steps<'_, T>,
    at: usize,
) -> Option<()> {
    let Steps { place, form, phi, y, theta, told, .. } = task;
    let n = theta.len();
    let f = &phi[at * n..(at + 1) * n];
    let (product, squares) = products::<T, V>(f, theta);
    let error = y[at] - product;
    if !accepts(error, squares) {
        return None;
    }
    if form.leaves_out(squares) {
        let leverage = leverage_of::<T, V, GROUP>(place.columns, place.diagonal, f);
        let largest = largest(place.diagonal);
        told[at] = Told { error, leverage, largest, forgot: false, used: false, windup: false };
    } else {
        let measured = measure_many::<T, V, GROUP>(place, *form, f, squares)?;
        add_scaled_by::<T, V>(theta, error * measured.inverse_variance, &place.scratch[..n]);
        told[at] = Told::used(error, &measured);
    }
    task.keep(at);
    Some(())
}

/// The samples from `at` on in one sweep over U, if none of them can be refused; how many.
#[inline(always)]
fn batch<T: Real, V: Vector<T>, const GROUP: usize>(
    task: &mut Steps<'_, T>,
    at: usize,
    growth: T,
) -> usize {
    let n = task.theta.len();
    let f = &task.phi[at * n..(at + BATCH) * n];
    let y = &task.y[at..at + BATCH];
    if !admits::<T, V>(&mut task.place, growth, f, y, task.theta) {
        return 0;
    }
    let measured = measure_batch::<T, V, GROUP>(&mut task.place, growth, f);
    for (l, (f, measured)) in f.chunks_exact(n).zip(&measured).enumerate() {
        let error = y[l] - products::<T, V>(f, task.theta).0;
        let gain = &task.place.scratch[l * n..(l + 1) * n];
        add_scaled_by::<T, V>(task.theta, error * measured.inverse_variance, gain);
        task.told[at + l] = Told::used(error, measured);
        task.keep(at + l);
    }
    BATCH
}

impl<T: Real> Steps<'_, T> {
    /// Keeps θ after a sample, if that was asked for.
    #[inline(always)]
    fn keep(&mut self, at: usize) {
        let n = self.theta.len();
        if let Some(after) = self.thetas.chunks_exact_mut(n).nth(at) {
            after.copy_from_slice(self.theta);
        }
    }
}
