//! At most ten parameters: U, D and θ stay in registers.

use super::super::bierman::largest;
use super::super::measure::bounds::Bounds;
use super::super::measure::forms::{along, scale, walk};
use super::super::outcome::Outcome;
use super::super::registers::{InPlace, Small, Unit};
use super::super::vectors::few_products;
use super::{accepts, Steps};
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::{shrink, Form, ALONG, SCALE, WALK};
use crate::number::lane::One;
use crate::number::vector::{StreamVector, Vector};
use crate::number::Real;

/// Takes samples of `N` parameters that forget in one form.
pub struct Few<'a, 'b, T, const N: usize, const FORM: u8>(pub &'b mut Steps<'a, T>);

impl<T: Real, const N: usize, const FORM: u8> Kernel<T> for Few<'_, '_, T, N, FORM> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        N
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> usize {
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP >= 8 {
            return 0;
        }
        match N {
            // there is less arithmetic than waiting for it
            0..=4 => in_registers::<T, V::One, V::StreamVector, N, FORM>(self.0),
            // more of it than of numbers: the compiler would lose time with pairs of them
            _ if FORM == ALONG => in_place::<T, V::One, V::StreamVector, N, FORM>(self.0),
            _ => in_place::<T, T, V::StreamVector, N, FORM>(self.0),
        }
        .unwrap_or(0)
    }
}

/// With U in registers.
#[inline(always)]
fn in_registers<T: Real, A: One<T>, L: StreamVector<T>, const N: usize, const FORM: u8>(
    task: &mut Steps<'_, T>,
) -> Option<usize> {
    let mut small = Small::<A, N>::load(task.place.columns, task.place.diagonal.first_chunk()?);
    let taken = all::<T, A, L, _, N, FORM>(task, &mut small)?;
    small.store(task.place.columns, task.place.diagonal.first_chunk_mut()?);
    Some(taken)
}

/// With U where it is kept.
#[inline(always)]
fn in_place<T: Real, A: One<T>, L: StreamVector<T>, const N: usize, const FORM: u8>(
    task: &mut Steps<'_, T>,
) -> Option<usize> {
    let d = A::splat_each(task.place.diagonal.first_chunk()?);
    let u = InPlace::of::<N>(core::mem::take(&mut task.place.columns));
    let mut small = Small { u, d };
    let taken = all::<T, A, L, _, N, FORM>(task, &mut small)?;
    *task.place.diagonal.first_chunk_mut()? = A::get_each(&small.d);
    Some(taken)
}

#[inline(always)]
fn all<T, A, L, U, const N: usize, const FORM: u8>(
    task: &mut Steps<'_, T>,
    small: &mut Small<A, N, U>,
) -> Option<usize>
where
    T: Real,
    A: One<T>,
    L: StreamVector<T>,
    U: Unit<A, N>,
{
    let mut theta = A::splat_each(task.theta.first_chunk::<N>()?);
    let (most, mut taken) = (task.outcomes.len().min(task.y.len()), 0);
    let (mut trace, mut tight) = (*task.place.bound, false);
    while taken < most {
        match take::<T, A, L, U, N, FORM>(task, taken, small, (&mut theta, &mut trace)) {
            0 if tight => break,
            // perhaps only because the bound is far above the trace
            0 => (trace, tight) = (small.trace().get(), true),
            took => (taken, tight) = (taken + took, false),
        }
    }
    *task.theta.first_chunk_mut()? = A::get_each(&theta);
    Some(taken)
}

/// Takes samples from `at` on; returns how many. 0 means that `trace`, which is at least that of P, is
/// too large, or that the next one must be taken elsewhere.
#[inline(always)]
fn take<T, A, L, U, const N: usize, const FORM: u8>(
    task: &mut Steps<'_, T>,
    at: usize,
    small: &mut Small<A, N, U>,
    (theta, trace): (&mut [A; N], &mut T),
) -> usize
where
    T: Real,
    A: One<T>,
    L: StreamVector<T>,
    U: Unit<A, N>,
{
    let Steps { place, form, phi, y, outcomes, thetas, .. } = task;
    let mut bounds = Bounds { kept: &mut *place.bound, tight: *trace };
    let mut after = thetas.get_mut(at * N..).unwrap_or_default().as_chunks_mut::<N>().0.iter_mut();
    let (phi, y, outcomes) = (phi[at * N..].as_chunks::<N>().0, &y[at..], &mut outcomes[at..]);
    let count = phi.len().min(y.len()).min(outcomes.len());
    let (mut least, mut taken) = (small.least(), 0);
    for k in 0..count {
        let (f, outcome) = (A::splat_each(&phi[k]), &mut outcomes[k]);
        let (product, squares) = few_products(&f, theta);
        let (error, squares) = (y[k] - product.get(), squares.get());
        if !accepts(error, squares) {
            break;
        }
        if FORM == ALONG && form.leaves_out(squares) {
            *outcome = left_out(small, error, &f);
        } else {
            let sample = (&f, squares);
            let gain = match *form {
                Form::Scale { growth } if FORM == SCALE => {
                    scale::<T, A, U, N, false>(small, &mut bounds, growth, sample, least)
                }
                Form::Along { weight, .. } if FORM == ALONG => {
                    along::<T, A, U, N, false>(small, &mut bounds, weight, sample, least)
                }
                Form::Walk { noise, per_bound } if FORM == WALK => {
                    let noise = (noise, per_bound);
                    walk::<T, A, L, U, N, false>(small, &mut bounds, noise, sample, least)
                }
                _ => None,
            };
            let Some((gain, forgot)) = gain else { break };
            // D becomes no less than D / a
            least *= match *form {
                Form::Walk { noise, per_bound } if FORM == WALK => {
                    shrink::<T, T>(noise, per_bound) * gain.inverse_a.get()
                }
                _ => gain.inverse_a.get(),
            };
            let step = A::splat(error) * gain.inverse_a;
            for i in 0..N {
                theta[i] = step.mul_add(gain.k[i], theta[i]);
            }
            let (leverage, largest) = (gain.s.get(), gain.largest.get());
            *outcome = Outcome { error, leverage, largest, forgot, used: true, windup: false };
        }
        if let Some(after) = after.next() {
            *after = A::get_each(theta);
        }
        taken += 1;
    }
    *trace = bounds.tight;
    taken
}

/// A sample in the dead zone.
#[inline(always)]
pub fn left_out<T: Real, A: One<T>, U: Unit<A, N>, const N: usize>(
    small: &Small<A, N, U>,
    error: T,
    f: &[A; N],
) -> Outcome<T> {
    let (leverage, d) = (small.leverage(f).get(), A::get_each(&small.d));
    Outcome { error, leverage, largest: largest(&d), forgot: false, used: false, windup: false }
}
