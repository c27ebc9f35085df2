//! Samples of one row and one target, one after the other, when nothing happens between the
//! arrival of a sample and its use.

mod few;
mod many;

use super::dispatch::Dispatch;
use super::layout::{COMPACT, FEW};
use super::measure::Place;
use super::outcome::Outcome;
use crate::kernel::form::{Form, ALONG, SCALE, WALK};
use crate::number::Real;
pub(super) use few::left_out;
use few::Few;
use many::Many;

/// Samples, and what takes them.
pub struct Steps<'a, T> {
    /// the factor
    pub place: Place<'a, T>,
    /// how to forget
    pub form: Form<T>,
    /// n numbers a sample
    pub phi: &'a [T],
    /// one number a sample
    pub y: &'a [T],
    /// θ
    pub theta: &'a mut [T],
    /// one for each sample at most
    pub outcomes: &'a mut [Outcome<T>],
    /// n numbers a sample, or none: θ after it
    pub thetas: &'a mut [T],
}

/// Takes the samples until one is to be refused or looked at closely, or P needs more room; returns
/// how many it took: none where programs are to be small.
#[inline(always)]
pub fn advance<T: Real, D: Dispatch<T>>(steps: &mut Steps<'_, T>) -> usize {
    match steps.theta.len() {
        _ if COMPACT => 0,
        1..=FEW => with_few!(steps.theta.len(), few::<T, D>(steps)),
        _ => many::<T, D>(steps),
    }
}

/// A kernel for each number of parameters and each form: fewer would share their registers.
#[inline(always)]
fn few<T: Real, D: Dispatch<T>, const N: usize>(steps: &mut Steps<'_, T>) -> usize {
    match steps.form {
        Form::Scale { .. } => D::run(Few::<T, N, SCALE>(steps)),
        Form::Along { .. } => D::run(Few::<T, N, ALONG>(steps)),
        Form::Walk { .. } => D::run(Few::<T, N, WALK>(steps)),
    }
}

#[inline(always)]
fn many<T: Real, D: Dispatch<T>>(steps: &mut Steps<'_, T>) -> usize {
    match steps.form {
        Form::Scale { .. } => D::run(Many::<T, SCALE>(steps)),
        Form::Along { .. } => D::run(Many::<T, ALONG>(steps)),
        // of few parameters only
        Form::Walk { .. } => 0,
    }
}

/// Whether a sample with this error and ‖φ‖² is one to use: not if either is NaN.
#[inline(always)]
pub(super) fn accepts<T: Real>(error: T, squares: T) -> bool {
    (error.abs() <= T::CEILING) & (squares <= T::CEILING)
}

impl<T: Real> Form<T> {
    #[inline(always)]
    pub(super) fn leaves_out(self, squares: T) -> bool {
        matches!(self, Self::Along { dead_zone, .. } if dead_zone.holds(squares))
    }
}
