//! Measurements of at most ten parameters: D and the gain in registers.

use super::bounds::Bounds;
use super::forms::{along, scale, walk};
use super::{Measure, Place};
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::{Form, ALONG, SCALE, WALK};
use crate::kernel::layout::FEW;
use crate::kernel::measured::Measured;
use crate::kernel::registers::{Gain, InPlace, Small};
use crate::number::vector::Vector;
use crate::number::{copy_some, Real};

/// In one form, of `N` parameters.
pub struct Few<'a, T, const N: usize, const FORM: u8>(pub Measure<'a, T>);

impl<T: Real, const N: usize, const FORM: u8> Kernel<T> for Few<'_, T, N, FORM> {
    type Output = Option<Measured<T>>;

    #[inline(always)]
    fn size(&self) -> usize {
        N
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> Option<Measured<T>> {
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP >= 8 {
            return None;
        }
        let measured = of::<T, V, N, FORM>(&mut self.0)?;
        self.0.correct::<V>(&measured);
        Some(measured)
    }
}

/// In any form, of any of these numbers of parameters, unless there is no room for P.
#[inline(always)]
pub(super) fn measure_any<T: Real, V: Vector<T>>(
    Place { columns, diagonal, scratch, bound }: &mut Place<'_, T>,
    form: Form<T>,
    f: &[T],
    squares: T,
) -> Option<Measured<T>> {
    let (n, mut padded, mut d) = (f.len(), [T::ZERO; FEW], [T::ONE; FEW]);
    copy_some(&mut padded, f);
    copy_some(&mut d, diagonal);
    let mut small = Small { u: InPlace::of_some(columns, n), d };
    let sample = (&padded, squares);
    let (gain, forgot) = match form {
        Form::Scale { .. } => gain::<T, V, FEW, SCALE>(&mut small, bound, form, sample),
        Form::Along { .. } => gain::<T, V, FEW, ALONG>(&mut small, bound, form, sample),
        Form::Walk { .. } => gain::<T, V, FEW, WALK>(&mut small, bound, form, sample),
    }?;
    diagonal.copy_from_slice(&small.d[..n]);
    scratch[..n].copy_from_slice(&gain.k[..n]);
    Some(measured(&gain, forgot))
}

#[inline(always)]
fn of<T: Real, V: Vector<T>, const N: usize, const FORM: u8>(
    task: &mut Measure<'_, T>,
) -> Option<Measured<T>> {
    let Measure { place: Place { columns, diagonal, scratch, bound }, form, f, squares, .. } = task;
    let (f, d) = (f.first_chunk::<N>()?, diagonal.first_chunk_mut::<N>()?);
    let mut small = Small { u: InPlace::of::<N>(columns), d: *d };
    let (gain, forgot) = gain::<T, V, N, FORM>(&mut small, bound, *form, (f, *squares))?;
    *d = small.d;
    let k = &mut scratch[..N];
    for i in 0..N {
        k[i] = gain.k[i];
    }
    Some(measured(&gain, forgot))
}

/// Forgets in this form and measures, unless there is no room for P.
#[inline(always)]
fn gain<T: Real, V: Vector<T>, const N: usize, const FORM: u8>(
    small: &mut Small<T, N, InPlace<'_, T>>,
    bound: &mut T,
    form: Form<T>,
    sample: (&[T; N], T),
) -> Option<(Gain<T, N>, bool)> {
    let bounds = &mut Bounds { tight: *bound, kept: bound };
    match form {
        Form::Scale { growth } if FORM == SCALE => {
            scale::<T, T, _, N, true>(small, bounds, growth, sample, T::FLOOR)
        }
        Form::Along { weight, .. } if FORM == ALONG => {
            along::<T, T, _, N, true>(small, bounds, weight, sample, T::FLOOR)
        }
        Form::Walk { noise, per_bound } if FORM == WALK => {
            let noise = (noise, per_bound);
            walk::<T, T, V::StreamVector, _, N, true>(small, bounds, noise, sample, T::FLOOR)
        }
        _ => None,
    }
}

#[inline(always)]
fn measured<T: Real, const N: usize>(gain: &Gain<T, N>, forgot: bool) -> Measured<T> {
    let &Gain { s: leverage, a: variance, inverse_a: inverse_variance, largest, .. } = gain;
    Measured { leverage, variance, inverse_variance, largest, forgot }
}
