//! The loops over U: one function per operation, on plain slices.
//!
//! `columns` holds the columns of U in tiles ([`place`] says where a number is); every inner loop
//! runs along columns, over neighbouring numbers.
//!
//! Each loop is a [`Kernel`](crate::Kernel): the number type decides with which vectors and over
//! how many columns at a time it runs. The bits of the result depend on neither.

/// Calls `$function::<.., N>` with a number N of parameters, 1 to 8, as a constant.
macro_rules! with_width {
    ($n:expr, $function:ident::<$($T:ident),+>$arguments:tt) => {
        match $n {
            1 => $function::<$($T,)+ 1>$arguments,
            2 => $function::<$($T,)+ 2>$arguments,
            3 => $function::<$($T,)+ 3>$arguments,
            4 => $function::<$($T,)+ 4>$arguments,
            5 => $function::<$($T,)+ 5>$arguments,
            6 => $function::<$($T,)+ 6>$arguments,
            7 => $function::<$($T,)+ 7>$arguments,
            _ => $function::<$($T,)+ 8>$arguments,
        }
    };
}

/// The same for 1 to 10.
macro_rules! with_few {
    ($n:expr, $function:ident::<$($T:ident),+>$arguments:tt) => {
        match $n {
            9 => $function::<$($T,)+ 9>$arguments,
            10 => $function::<$($T,)+ 10>$arguments,
            n => with_width!(n, $function::<$($T),+>$arguments),
        }
    };
}

mod agee_turner;
mod along;
mod arrival;
mod batch;
mod bierman;
#[cfg(feature = "alloc")]
pub(crate) mod fleet;
mod layout;
mod long;
mod measure;
mod small;
mod steps;
mod tile;
mod told;
mod triangular;

pub use layout::{
    capacity, column, get_column, is_unit_triangular, length, most, place, put_column, scratch,
    set_identity, visit, FEW,
};
pub(crate) use long::{add_scaled_by, dot_of};
pub(crate) use measure::{Measure, Place};
pub(crate) use steps::{advance, Steps};
pub use told::Told;

use super::{Form, Measured};
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
    let place = Place { columns, diagonal, scratch: gain, bound: &mut { T::ZERO } };
    let (theta, errors) = (&mut [][..], &[][..]);
    let form = Form::Scale { growth: T::ONE };
    match T::compute(Measure { place, form, f, squares: T::ONE, theta, errors }) {
        Some(measured) => measured,
        None => unreachable!("there is room for what does not grow"),
    }
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
