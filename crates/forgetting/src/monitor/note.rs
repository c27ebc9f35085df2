//! One row of a sample, as the watch takes note of it: one pass of each vector.

use crate::vector::Vector;
use crate::{Kernel, Real};

/// So many parameters and less are not worth a kernel.
const FEW: usize = 8;

/// Adds (φ̃ w) φ̄ to `told` and ages each parameter that is not excited; gives φ̃ w.
pub(super) struct Note<'a, T> {
    /// φ̄
    pub row: &'a [T],
    /// S w
    pub axis: &'a [T],
    pub told: &'a mut [T],
    /// P_ii
    pub variances: &'a [T],
    pub silence: &'a mut [T],
    /// φ̄_i² P_ii from which on parameter i is excited
    pub least: T,
    /// what is added to the silence of the others
    pub age: T,
}

impl<T: Real> Note<'_, T> {
    /// Does it.
    #[inline]
    pub fn take(self) -> T {
        if self.row.len() > FEW {
            return T::compute(self);
        }
        let Self { row, axis, told, variances, silence, least, age } = self;
        let along = row.iter().zip(axis).fold(T::ZERO, |sum, (&f, &x)| sum + f * x);
        for (told, &f) in told.iter_mut().zip(row) {
            *told += along * f;
        }
        grow_old((row, variances), silence, least, age);
        along
    }
}

impl<T: Real> Kernel<T> for Note<'_, T> {
    type Output = T;

    #[inline(always)]
    fn size(&self) -> usize {
        self.row.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> T {
        let Self { row, axis, told, variances, silence, least, age } = self;
        let ((f, f_rest), (x, x_rest)) = (T::chunks(row), T::chunks(axis));
        let mut lanes = V::splat(T::ZERO);
        for (f, x) in f.iter().zip(x) {
            lanes = V::load(f).mul_add(V::load(x), lanes);
        }
        let along = f_rest.iter().zip(x_rest).fold(lanes.sum(), |sum, (&f, &x)| f.mul_add(x, sum));
        let (told, told_rest) = T::chunks_mut(told);
        let c = V::splat(along);
        for (told, f) in told.iter_mut().zip(f) {
            c.mul_add(V::load(f), V::load(told)).store(told);
        }
        for (told, &f) in told_rest.iter_mut().zip(f_rest) {
            *told = along.mul_add(f, *told);
        }
        grow_old((row, variances), silence, least, age);
        along
    }
}

/// Ages the parameters that are not excited.
#[inline(always)]
fn grow_old<T: Real>((row, variances): (&[T], &[T]), silence: &mut [T], least: T, age: T) {
    for ((silence, &variance), &f) in silence.iter_mut().zip(variances).zip(row) {
        let excited = f * f * variance >= least;
        *silence = if excited { T::ZERO } else { *silence + age };
    }
}
