//! Each of the forms of [`Form`](crate::kernel::form::Form), with the measurement, in registers.

use super::bounds::{adds, Bounds};
use crate::kernel::form::shrink;
use crate::kernel::registers::{Gain, Small, Unit};
use crate::number::lane::One;
use crate::number::vector::StreamVector;
use crate::number::Real;

/// Scales P and measures f with the squared length `squares` in registers, unless there is no room;
/// says whether anything was forgotten.
///
/// Unless `NEAR` it does nothing, either, where an element of D may come near its floor; all of them
/// are at least `least`.
#[inline(always)]
pub fn scale<T: Real, A: One<T>, U: Unit<A, N>, const N: usize, const NEAR: bool>(
    small: &mut Small<A, N, U>,
    bounds: &mut Bounds<'_, T>,
    growth: T,
    (f, squares): (&[A; N], T),
    least: T,
) -> Option<(Gain<A, N>, bool)> {
    bounds.grow::<NEAR>((growth, T::ZERO), (least, squares))?;
    let gain = small.scale_and_measure::<T, NEAR>(A::splat(growth), f);
    Some((gain, growth > T::ONE))
}

/// The same with forgetting along f.
#[inline(always)]
pub fn along<T: Real, A: One<T>, U: Unit<A, N>, const N: usize, const NEAR: bool>(
    small: &mut Small<A, N, U>,
    bounds: &mut Bounds<'_, T>,
    weight: T,
    (f, squares): (&[A; N], T),
    least: T,
) -> Option<(Gain<A, N>, bool)> {
    let (one, zero) = (A::splat(T::ONE), A::splat(T::ZERO));
    let mut along = small.along(f);
    let information = along.information.get();
    let c = weight / information;
    if !adds(c) {
        bounds.grow::<NEAR>((T::ONE, T::ZERO), (least, squares))?;
        (along.z, along.q) = ([zero; N], [zero; N]);
        return Some((small.add_and_measure::<T, NEAR>((zero, one), &along, f), false));
    }
    bounds.grow::<NEAR>((T::ONE, c * squares), (least, squares))?;
    let added = (A::splat(c), A::splat(information / weight));
    Some((small.add_and_measure::<T, NEAR>(added, &along, f), true))
}

/// The same with the same variance added to every parameter.
#[inline(always)]
pub fn walk<T, A, L, U, const N: usize, const NEAR: bool>(
    small: &mut Small<A, N, U>,
    bounds: &mut Bounds<'_, T>,
    (noise, per_bound): (T, T),
    (f, squares): (&[A; N], T),
    least: T,
) -> Option<(Gain<A, N>, bool)>
where
    T: Real,
    A: One<T>,
    L: StreamVector<T>,
    U: Unit<A, N>,
{
    let shrink = shrink::<T, T>(noise, per_bound);
    let added = noise * T::from_f64(small.u.count() as f64);
    bounds.grow::<NEAR>((shrink, added), (least * shrink, squares))?;
    small.walk_by_columns::<T, L>(shrink, noise);
    let gain = small.scale_and_measure::<T, NEAR>(A::splat(T::ONE), f);
    Some((gain, noise > T::ZERO))
}
