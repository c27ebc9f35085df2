//! One row of one sample: forgetting in one of the forms of [`Form`], the measurement and the
//! correction of θ, for any number of targets.

pub mod bounds;
mod few;
pub mod forms;
pub mod many;

use super::layout::FEW;
use super::vectors::add_scaled_by;
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::Form;
use crate::kernel::measured::Measured;
use crate::number::vector::Vector;
use crate::number::Real;

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

impl<T: Real> Kernel<T> for Measure<'_, T> {
    type Output = Option<Measured<T>>;

    #[inline(always)]
    fn size(&self) -> usize {
        self.f.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> Option<Measured<T>> {
        let n = self.f.len();
        let Self { ref mut place, form, f, squares, .. } = self;
        // wide vectors are for many: without this they would be compiled for few, too
        let measured = if GROUP < 8 && n <= FEW {
            few::measure::<T, V>(place, form, f, squares)?
        } else {
            many::measure::<T, V, GROUP>(place, form, f, squares)?
        };
        for (target, theta) in self.theta.chunks_exact_mut(n).enumerate() {
            let error = self.errors[target];
            add_scaled_by::<T, V>(theta, error * measured.inverse_variance, &place.scratch[..n]);
        }
        Some(measured)
    }
}
