//! The loops over U: one function per operation, on plain slices.
//!
//! `columns` holds the columns of U, each padded with zeros below its unit diagonal ([`start`]
//! says where one starts); every inner loop runs along columns, over neighbouring numbers.
//!
//! Each loop is a [`Kernel`](crate::Kernel): the number type decides with which vectors and over
//! how many columns at a time it runs. The bits of the result depend on neither.

mod agee_turner;
mod bierman;
mod block;
mod layout;
mod long;
mod step;
mod triangular;

pub use layout::{column, column_mut, length, set_identity, start, visit};
pub(crate) use step::{Step, Stepped};

use super::Measured;
use crate::Real;

/// Σ aᵢ bᵢ over the shorter of the two, in 8 (f64) or 16 (f32) partial sums.
#[inline(always)]
pub fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    T::compute(long::Dot { a, b })
}

/// `y` += c·`x`
#[inline(always)]
pub fn add_scaled<T: Real>(y: &mut [T], c: T, x: &[T]) {
    T::compute(long::AddScaled { y, c, x });
}

/// Copies `phi` to `copy`; returns φ·θ and φ·φ. All three are equally long.
#[inline(always)]
pub(crate) fn arrive<T: Real>(phi: &[T], theta: &[T], copy: &mut [T]) -> (T, T) {
    T::compute(long::Arrive { phi, theta, copy })
}

/// f·P·fᵀ = Σ_j D_j (Uᵀfᵀ)_j², O(n²/2).
#[inline(always)]
pub fn leverage<T: Real>(columns: &[T], diagonal: &[T], f: &[T]) -> T {
    T::compute(triangular::Leverage { columns, diagonal, f })
}

/// Bierman's measurement update with unit variance: P⁻¹ ← P⁻¹ + fᵀf. O(1.5 n²).
///
/// Leaves a times the gain, P·fᵀ with the P of before, in `gain`.
#[inline(always)]
pub fn bierman<T: Real>(
    columns: &mut [T],
    diagonal: &mut [T],
    f: &[T],
    gain: &mut [T],
) -> Measured<T> {
    let (growth, theta, errors) = (T::ONE, &mut [][..], &[][..]);
    T::compute(bierman::Bierman { columns, diagonal, growth, f, gain, theta, errors })
}

/// The same after P ← `growth`·P, and with the correction of the n numbers of `theta` for each
/// of `errors`: θ ← θ + P₊fᵀe.
#[inline(always)]
pub(crate) fn measure<T: Real>(
    (columns, diagonal, growth): (&mut [T], &mut [T], T),
    f: &[T],
    gain: &mut [T],
    (theta, errors): (&mut [T], &[T]),
) -> Measured<T> {
    T::compute(bierman::Bierman { columns, diagonal, growth, f, gain, theta, errors })
}

/// Agee and Turner's update: P ← P + c·x·xᵀ with c ≥ 0. Uses up `x`. O(n²).
#[inline(always)]
pub fn agee_turner<T: Real>(columns: &mut [T], diagonal: &mut [T], x: &mut [T], c: T) {
    T::compute(agee_turner::AgeeTurner { columns, diagonal, x, c });
}

/// `x` ← U⁻¹·`x`, O(n²/2).
#[inline(always)]
pub fn solve<T: Real>(columns: &[T], x: &mut [T]) {
    T::compute(triangular::Solve { columns, x });
}

/// `x` ← U·`x`, O(n²/2).
#[inline(always)]
pub fn multiply<T: Real>(columns: &[T], x: &mut [T]) {
    T::compute(triangular::Multiply { columns, x });
}

/// `x` ← Uᵀ·`x`, O(n²/2).
#[inline(always)]
pub fn multiply_transposed<T: Real>(columns: &[T], x: &mut [T]) {
    T::compute(triangular::MultiplyTransposed { columns, x });
}
