//! Measurements of at most ten parameters: D and the gain in registers.

use super::bounds::Bounds;
use super::forms::{along, scale, walk};
use super::Place;
use crate::kernel::form::Form;
use crate::kernel::layout::{COMPACT, FEW};
use crate::kernel::measured::Measured;
use crate::kernel::registers::{Gain, InPlace, Small};
use crate::number::vector::Vector;
use crate::number::{copy_some, Real};

/// Forgets and measures, unless there is no room for P.
#[inline(always)]
pub(super) fn measure<T: Real, V: Vector<T>>(
    place: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    if COMPACT {
        return of_any::<T, V>(place, form, f, squares);
    }
    with_few!(f.len(), of::<T, V>(place, form, f, squares))
}

/// For any of these numbers of parameters.
#[inline(always)]
fn of_any<T: Real, V: Vector<T>>(
    Place { columns, diagonal, scratch, bound }: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    let (n, mut padded, mut d) = (f.len(), [T::ZERO; FEW], [T::ONE; FEW]);
    copy_some(&mut padded, f);
    copy_some(&mut d, diagonal);
    let mut small = Small { u: InPlace::of_some(columns, n), d };
    let (gain, forgot) = gain::<T, V, FEW>(&mut small, bound, form, (&padded, squares))?;
    diagonal.copy_from_slice(&small.d[..n]);
    scratch[..n].copy_from_slice(&gain.k[..n]);
    Some(measured(&gain, forgot))
}

/// For N parameters.
#[inline(always)]
fn of<T: Real, V: Vector<T>, const N: usize>(
    Place { columns, diagonal, scratch, bound }: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    let (f, d) = (f.first_chunk::<N>()?, diagonal.first_chunk_mut::<N>()?);
    let mut small = Small { u: InPlace::of::<N>(columns), d: *d };
    let (gain, forgot) = gain::<T, V, N>(&mut small, bound, form, (f, squares))?;
    *d = small.d;
    let k = &mut scratch[..N];
    for i in 0..N {
        k[i] = gain.k[i];
    }
    Some(measured(&gain, forgot))
}

/// Forgets in this form and measures.
#[inline(always)]
fn gain<T: Real, V: Vector<T>, const N: usize>(
    small: &mut Small<T, N, InPlace<'_, T>>,
    bound: &mut T,
    form: Form<T>,
    sample: (&[T; N], T),
) -> Option<(Gain<T, N>, bool)> {
    let bounds = &mut Bounds { tight: *bound, kept: bound };
    match form {
        Form::Scale { growth } => {
            scale::<T, T, _, N, true>(small, bounds, growth, sample, T::FLOOR)
        }
        Form::Along { weight, .. } => {
            along::<T, T, _, N, true>(small, bounds, weight, sample, T::FLOOR)
        }
        Form::Walk { noise, per_bound } => {
            let noise = (noise, per_bound);
            walk::<T, T, V::StreamVector, _, N, true>(small, bounds, noise, sample, T::FLOOR)
        }
    }
}

#[inline(always)]
fn measured<T: Real, const N: usize>(gain: &Gain<T, N>, forgot: bool) -> Measured<T> {
    let &Gain { s: leverage, a: variance, inverse_a: inverse_variance, largest, .. } = gain;
    Measured { leverage, variance, inverse_variance, largest, forgot }
}
