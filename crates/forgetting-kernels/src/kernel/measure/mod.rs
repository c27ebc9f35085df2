//! One row of one sample: forgetting in one of the forms of [`Form`], the measurement and the
//! correction of θ, for any number of targets.

pub mod bounds;
mod few;
pub mod forms;
pub mod many;

use super::layout::{COMPACT, FEW};
use super::vectors::add_scaled_by;
use crate::kernel::dispatch::{Dispatch, Kernel};
use crate::kernel::form::{Form, ALONG, SCALE, WALK};
use crate::kernel::measured::Measured;
use crate::number::vector::Vector;
use crate::number::Real;
use few::Few;
use many::Many;

/// The factor and what goes with it.
pub struct Place<'a, T> {
    /// U, in tiles
    pub columns: &'a mut [T],
    /// D
    pub diagonal: &'a mut [T],
    /// [`scratch`](super::scratch) numbers; P·fᵀ, with the P just before the measurement, comes first
    pub scratch: &'a mut [T],
    /// at least the trace of P
    pub bound: &'a mut T,
}

/// Forgets, measures f and corrects the n numbers of `theta` for each of `errors`, unless there
/// is no room for P; `f` has the squared length `squares`.
pub struct Measure<'a, T> {
    /// the factor
    pub place: Place<'a, T>,
    /// how to forget
    pub form: Form<T>,
    /// the regressor, n numbers
    pub f: &'a [T],
    /// ‖f‖²
    pub squares: T,
    /// θ
    pub theta: &'a mut [T],
    /// one for each target
    pub errors: &'a [T],
}

/// Measures: of few parameters with a kernel for each form and each number of them.
#[inline(always)]
pub fn measure<T: Real, D: Dispatch<T>>(task: Measure<'_, T>) -> Option<Measured<T>> {
    match task.f.len() {
        _ if COMPACT => D::run(Any(task)),
        1..=FEW => with_few!(task.f.len(), few::<T, D>(task)),
        _ => D::run(Many(task)),
    }
}

#[inline(always)]
fn few<T: Real, D: Dispatch<T>, const N: usize>(task: Measure<'_, T>) -> Option<Measured<T>> {
    match task.form {
        Form::Scale { .. } => D::run(Few::<T, N, SCALE>(task)),
        Form::Along { .. } => D::run(Few::<T, N, ALONG>(task)),
        Form::Walk { .. } => D::run(Few::<T, N, WALK>(task)),
    }
}

/// In any form, of any number of parameters: for programs that are to be small.
struct Any<'a, T>(Measure<'a, T>);

impl<T: Real> Kernel<T> for Any<'_, T> {
    type Output = Option<Measured<T>>;

    #[inline(always)]
    fn size(&self) -> usize {
        self.0.f.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> Option<Measured<T>> {
        let Measure { ref mut place, form, f, squares, .. } = self.0;
        let measured = match f.len() {
            1..=FEW => few::measure_any::<T, V>(place, form, f, squares)?,
            _ => many::measure::<T, V, GROUP>(place, form, f, squares)?,
        };
        self.0.correct::<V>(&measured);
        Some(measured)
    }
}

impl<T: Real> Measure<'_, T> {
    /// θ ← θ + P·fᵀe, once P·fᵀ is known.
    #[inline(always)]
    fn correct<V: Vector<T>>(self, measured: &Measured<T>) {
        let n = self.f.len();
        for (target, theta) in self.theta.chunks_exact_mut(n).enumerate() {
            let step = self.errors[target] * measured.inverse_variance;
            add_scaled_by::<T, V>(theta, step, &self.place.scratch[..n]);
        }
    }
}
