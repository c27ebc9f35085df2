//! Samples of one row and one target, one after the other, when nothing happens between the
//! arrival of a sample and its use.

#![allow(clippy::needless_range_loop, reason = "constant bounds unroll")]

use super::along;
use super::arrival::{arrive, correct};
use super::batch::{self, BATCH};
use super::layout::FEW;
use super::long::{add_scaled_by, few_products, products};
use super::measure::{adds, many as measure_many, take, Place};
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

/// For more than ten: several at a time where that is possible.
///
/// No closures hold what is long: they would be functions of their own, without the instructions
/// that this one may use.
#[inline(always)]
fn many<T: Real, V: Vector<T>, const GROUP: usize>(task: &mut Steps<'_, T>) -> usize {
    let (most, mut taken) = (task.told.len().min(task.y.len()), 0);
    match task.form {
        Form::Scale { growth } => {
            while most - taken >= BATCH {
                taken += match batch::<T, V, GROUP>(task, taken, growth) {
                    Some(()) => BATCH,
                    None if single::<T, V, GROUP>(task, taken).is_some() => 1,
                    None => return taken,
                };
            }
        }
        Form::Along { weight, .. } => {
            while most - taken >= 2 {
                taken += match two::<T, V, GROUP>(task, taken, weight) {
                    Some(()) => 2,
                    None if single::<T, V, GROUP>(task, taken).is_some() => 1,
                    None => return taken,
                };
            }
        }
    }
    while taken < most && single::<T, V, GROUP>(task, taken).is_some() {
        taken += 1;
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

/// The next samples in one sweep over U, if all of them can be used so.
#[inline(always)]
fn batch<T: Real, V: Vector<T>, const GROUP: usize>(
    task: &mut Steps<'_, T>,
    at: usize,
    growth: T,
) -> Option<()> {
    let Steps { place, phi, y, theta, told, thetas, .. } = task;
    let n = theta.len();
    let (phi, y) = (&phi[at * n..(at + BATCH) * n], &y[at..at + BATCH]);
    let bound = (0..BATCH).fold(*place.bound, |bound, _| bound * growth);
    (bound < T::CEILING).then_some(())?;
    let mut room = batch::Room::of(place.scratch, n);
    let arrival = arrive::<T, V, BATCH>(phi, theta, room.f);
    room.look::<V, GROUP>(place.columns, place.diagonal);
    let mut shared = [[T::ZERO; BATCH]; BATCH];
    let measured = [
        room.scale_and_measure::<V::Eight, 0>(growth, &mut shared[0])?,
        room.scale_and_measure::<V::Eight, 1>(growth, &mut shared[1])?,
        room.scale_and_measure::<V::Eight, 2>(growth, &mut shared[2])?,
        room.scale_and_measure::<V::Eight, 3>(growth, &mut shared[3])?,
    ];
    let [mut errors, mut steps] = [[T::ZERO; BATCH]; 2];
    for l in 0..BATCH {
        errors[l] = y[l] - arrival.predicted[l];
        for m in 0..l {
            errors[l] = (-steps[m]).mul_add(shared[l][m], errors[l]);
        }
        steps[l] = errors[l] * measured[l].inverse_variance;
        accepts(errors[l], arrival.squares[l]).then_some(())?;
    }
    *place.bound = bound;
    room.carry_out::<V, GROUP>(place.columns, place.diagonal);
    for l in 0..BATCH {
        told[at + l] = Told::used(errors[l], &measured[l]);
    }
    let thetas = thetas.get_mut(at * n..(at + BATCH) * n).unwrap_or_default();
    correct::<T, V, BATCH>(theta, &steps, |l, t| &room.k[t][l], thetas);
    Some(())
}

/// Two samples that forget along their regressors, in the same way; not where one is to be left
/// out, or has nothing to forget.
#[inline(always)]
fn two<T: Real, V: Vector<T>, const GROUP: usize>(
    task: &mut Steps<'_, T>,
    at: usize,
    weight: T,
) -> Option<()> {
    let Steps { place, form, phi, y, theta, told, thetas } = task;
    let n = theta.len();
    let (phi, y) = (&phi[at * n..(at + 2) * n], &y[at..at + 2]);
    let mut room = along::Room::<T, 2, 4>::of(place.scratch, n);
    let arrival = arrive::<T, V, 2>(phi, theta, room.f);
    let [first, second] = arrival.squares;
    (!form.leaves_out(first) && !form.leaves_out(second)).then_some(())?;
    room.look::<V, GROUP>(place.columns, place.diagonal);
    let mut bound = *place.bound;

    let information = room.information::<V::Eight, 0>();
    bound += more(weight, information, first)?;
    let (measured, _, above) = room.add_and_measure::<V::Eight, 0>(information / weight);
    let error = y[0] - arrival.predicted[0];
    let step = error * measured.inverse_variance;
    (above && accepts(error, first)).then_some(())?;

    let information = room.information::<V::Eight, 1>();
    bound += more(weight, information, second)?;
    let (after, shared, above) = room.add_and_measure::<V::Eight, 1>(information / weight);
    let later = (-step).mul_add(shared, y[1] - arrival.predicted[1]);
    (above && accepts(later, second) && bound < T::CEILING).then_some(())?;

    *place.bound = bound;
    room.carry_out::<V, GROUP>(place.columns, place.diagonal);
    told[at] = Told::used(error, &measured);
    told[at + 1] = Told::used(later, &after);
    let steps = [step, later * after.inverse_variance];
    let thetas = thetas.get_mut(at * n..(at + 2) * n).unwrap_or_default();
    correct::<T, V, 2>(theta, &steps, |l, t| room.gain(l, t), thetas);
    Some(())
}

/// What forgetting along a regressor with this information and ‖φ‖² adds to the trace of P, if it
/// does anything.
#[inline(always)]
fn more<T: Real>(weight: T, information: T, squares: T) -> Option<T> {
    let c = weight / information;
    adds(c).then_some(c * squares)
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
