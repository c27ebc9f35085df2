//! More than ten parameters: in sweeps over U.

use super::super::along;
use super::super::batch::{self, keeps_digits, PerSample, BATCH};
use super::super::bierman::largest;
use super::super::copies::copy;
use super::super::measure::bounds::adds;
use super::super::measure::many::measure;
use super::super::outcome::Outcome;
use super::super::together::{arrive, correct, predict};
use super::super::triangle::leverage_of;
use super::super::vectors::{add_scaled_by, products};
use super::{accepts, Steps};
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::{Form, ALONG, SCALE};
use crate::kernel::measured::Measured;
use crate::number::vector::Vector;
use crate::number::Real;

/// Takes samples that forget in one form.
pub struct Many<'a, 'b, T, const FORM: u8>(pub &'b mut Steps<'a, T>);

impl<T: Real, const FORM: u8> Kernel<T> for Many<'_, '_, T, FORM> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.0.theta.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> usize {
        all::<T, V, GROUP, FORM>(self.0)
    }
}

/// All of them, several at a time where that is possible.
///
/// No closures hold what is long: they would be functions of their own, without the instructions
/// that this one may use.
#[inline(always)]
fn all<T: Real, V: Vector<T>, const GROUP: usize, const FORM: u8>(
    task: &mut Steps<'_, T>,
) -> usize {
    let (most, mut taken) = (task.outcomes.len().min(task.y.len()), 0);
    while taken < most {
        let several = match task.form {
            Form::Scale { growth } if FORM == SCALE && most - taken >= BATCH => {
                batches::<T, V, GROUP>(task, taken, growth)
            }
            Form::Along { weight, .. } if FORM == ALONG && most - taken >= 2 => {
                two::<T, V, GROUP>(task, taken, weight)
            }
            _ => None,
        };
        taken += match several {
            Some(count) => count,
            None => match single::<T, V, GROUP, FORM>(task, taken) {
                Some(()) => 1,
                None => break,
            },
        };
    }
    taken
}

/// The sample at `at`, if it is one to take.
#[inline(always)]
fn single<T: Real, V: Vector<T>, const GROUP: usize, const FORM: u8>(
    task: &mut Steps<'_, T>,
    at: usize,
) -> Option<()> {
    let Steps { place, form, phi, y, theta, outcomes, .. } = task;
    let n = theta.len();
    let f = &phi[at * n..(at + 1) * n];
    let (product, squares) = products::<T, V>(f, theta);
    let error = y[at] - product;
    if !accepts(error, squares) {
        return None;
    }
    if FORM == ALONG && form.leaves_out(squares) {
        let leverage = leverage_of::<T, V, GROUP>(place.columns, place.diagonal, f);
        let largest = largest(place.diagonal);
        outcomes[at] =
            Outcome { error, leverage, largest, forgot: false, used: false, windup: false };
    } else {
        let measured = measure::<T, V, GROUP>(place, *form, f, squares)?;
        add_scaled_by::<T, V>(theta, error * measured.inverse_variance, &place.scratch[..n]);
        outcomes[at] = Outcome::used(error, &measured);
    }
    keep::<T, V>(task, at);
    Some(())
}

/// The next samples, several in each sweep over U, as long as all of them can be used so; how many
/// that were, if any.
#[inline(always)]
fn batches<T: Real, V: Vector<T>, const GROUP: usize>(
    task: &mut Steps<'_, T>,
    first: usize,
    growth: T,
) -> Option<usize> {
    let Steps { place, phi, y, theta, outcomes, thetas, .. } = task;
    let (n, most) = (theta.len(), outcomes.len().min(y.len()));
    let (mut room, mut at) = (batch::Room::of(place.scratch, n), first);
    let mut steps = [T::ZERO; BATCH];
    loop {
        let (done, next) = (at > first, at + BATCH <= most);
        if next {
            arrive::<T, V, BATCH>(&phi[at * n..], n, room.f);
        }
        let p = (&mut *place.columns, &mut *place.diagonal);
        let leverage = room.sweep::<V, GROUP>(p, done, next);
        if done {
            let thetas = thetas.get_mut((at - BATCH) * n..at * n).unwrap_or_default();
            correct::<T, V, BATCH>(theta, &steps, |l, t| &room.k[t][l], thetas);
        }
        if !next {
            break;
        }
        let (mut errors, squares) = predict::<T, V, BATCH>(theta, room.f);
        for l in 0..BATCH {
            errors[l] = y[at + l] - errors[l];
        }
        let arrived = (&mut errors, &squares, leverage);
        let Some(measured) = measure_batch::<T, V, GROUP>(&mut room, place.bound, growth, arrived)
        else {
            break;
        };
        for l in 0..BATCH {
            steps[l] = errors[l] * measured[l].inverse_variance;
            outcomes[at + l] = Outcome::used(errors[l], &measured[l]);
        }
        at += BATCH;
    }
    (at > first).then(|| at - first)
}

/// Measures a batch: updates D and the pending column changes, and corrects each error for the samples
/// before it. None, and nothing changed, if a sample cannot be taken in a batch.
#[inline(always)]
fn measure_batch<T: Real, V: Vector<T>, const GROUP: usize>(
    room: &mut batch::Room<'_, T>,
    bound: &mut T,
    growth: T,
    (errors, squares, leverage): (&mut PerSample<T>, &PerSample<T>, T),
) -> Option<PerSample<Measured<T>>> {
    let grown = (0..BATCH).fold(*bound, |bound, _| bound * growth);
    (grown < T::CEILING).then_some(())?;
    keeps_digits(leverage * (grown / *bound)).then_some(())?;
    let mut shared = [[T::ZERO; BATCH]; BATCH];
    let measured = room.measure::<V::BlockVector, GROUP>(growth, &mut shared)?;
    for l in 0..BATCH {
        for m in 0..l {
            let step = errors[m] * measured[m].inverse_variance;
            errors[l] = (-step).mul_add(shared[l][m], errors[l]);
        }
        accepts(errors[l], squares[l]).then_some(())?;
    }
    *bound = grown;
    Some(measured)
}

/// Two samples that forget along their regressors, in the same way; not where one is to be left
/// out, or has nothing to forget.
#[inline(always)]
fn two<T: Real, V: Vector<T>, const GROUP: usize>(
    task: &mut Steps<'_, T>,
    at: usize,
    weight: T,
) -> Option<usize> {
    let Steps { place, form, phi, y, theta, outcomes, thetas } = task;
    let n = theta.len();
    let (phi, y) = (&phi[at * n..], &y[at..at + 2]);
    let mut room = along::Room::<T, 2, 4>::of(place.scratch, n);
    arrive::<T, V, 2>(phi, n, room.f);
    let (predicted, [first, second]) = predict::<T, V, 2>(theta, room.f);
    (!form.leaves_out(first) && !form.leaves_out(second)).then_some(())?;
    room.look::<V, GROUP>(place.columns, place.diagonal);
    let (mut bound, leverage) = (*place.bound, room.leverage::<V::BlockVector>(1));

    let information = room.information::<V::BlockVector, 0>();
    let added = more(weight, information, first)?;
    keeps_digits(leverage + added * second).then_some(())?;
    bound += added;
    let (measured, _, above) =
        room.add_and_measure::<V::BlockVector, 0>(information / weight, information);
    let error = y[0] - predicted[0];
    let step = error * measured.inverse_variance;
    (above && accepts(error, first)).then_some(())?;

    let information = room.information::<V::BlockVector, 1>();
    bound += more(weight, information, second)?;
    let (after, shared, above) =
        room.add_and_measure::<V::BlockVector, 1>(information / weight, information);
    let later = (-step).mul_add(shared, y[1] - predicted[1]);
    (above && accepts(later, second) && bound < T::CEILING).then_some(())?;

    *place.bound = bound;
    room.carry_out::<V, GROUP>(place.columns, place.diagonal);
    outcomes[at] = Outcome::used(error, &measured);
    outcomes[at + 1] = Outcome::used(later, &after);
    let steps = [step, later * after.inverse_variance];
    let thetas = thetas.get_mut(at * n..(at + 2) * n).unwrap_or_default();
    correct::<T, V, 2>(theta, &steps, |l, t| room.gain(l, t), thetas);
    Some(2)
}

/// What forgetting along a regressor with this information and ‖φ‖² adds to the trace of P, if it
/// does anything.
#[inline(always)]
fn more<T: Real>(weight: T, information: T, squares: T) -> Option<T> {
    let c = weight / information;
    adds(c).then_some(c * squares)
}

/// Keeps θ after a sample, if that was asked for.
#[inline(always)]
fn keep<T: Real, V: Vector<T>>(task: &mut Steps<'_, T>, at: usize) {
    let n = task.theta.len();
    if let Some(after) = task.thetas.get_mut(at * n..(at + 1) * n) {
        copy::<T, V>(task.theta, after);
    }
}
