//! The kernels of whole vectors and of P, as functions of slices.

use super::agee_turner::AgeeTurner;
use super::form::Form;
use super::kernels::Kernels;
use super::measure::{Measure, Place};
use super::measured::Measured;
use super::symmetric::{SymmetricMultiply, SymmetricSubtract};
use super::triangle::{Leverage, Multiply, MultiplyTransposed, Solve};
use super::vectors::{AddScaled, Arrive, Dot};

/// Σ aᵢ bᵢ over the shorter of the two, in 8 (f64) or 16 (f32) partial sums.
#[inline(always)]
pub fn dot<T: Kernels>(a: &[T], b: &[T]) -> T {
    T::dot(Dot { a, b })
}

/// `y` += c·`x`
#[inline(always)]
pub fn add_scaled<T: Kernels>(y: &mut [T], c: T, x: &[T]) {
    T::add_scaled(AddScaled { y, c, x });
}

/// Copies `phi` to `copy`; returns φ·θ and φ·φ. All three are equally long.
#[inline(always)]
pub fn arrive<T: Kernels>(phi: &[T], theta: &[T], copy: &mut [T]) -> (T, T) {
    T::arrive(Arrive { phi, theta, copy })
}

/// f·P·fᵀ = Σ_j D_j (Uᵀfᵀ)_j², O(n²/2).
#[inline(always)]
pub fn leverage<T: Kernels>(columns: &[T], diagonal: &[T], f: &[T]) -> T {
    T::leverage(Leverage { columns, diagonal, f })
}

/// Bierman's measurement update with unit variance: P⁻¹ ← P⁻¹ + fᵀf. O(1.5 n²).
///
/// Leaves a times the gain, P·fᵀ with the P of before, in `gain`.
#[inline(always)]
pub fn bierman<T: Kernels>(
    columns: &mut [T],
    diagonal: &mut [T],
    f: &[T],
    gain: &mut [T],
) -> Measured<T> {
    let place = Place { columns, diagonal, scratch: gain, bound: &mut { T::ZERO } };
    let (theta, errors) = (&mut [][..], &[][..]);
    let form = Form::Scale { growth: T::ONE };
    match T::measure(Measure { place, form, f, squares: T::ONE, theta, errors }) {
        Some(measured) => measured,
        None => unreachable!("there is room for what does not grow"),
    }
}

/// Agee and Turner's update: P ← P + c·x·xᵀ with c ≥ 0. Uses up `x`. O(n²).
#[inline(always)]
pub fn agee_turner<T: Kernels>(columns: &mut [T], diagonal: &mut [T], x: &mut [T], c: T) {
    T::agee_turner(AgeeTurner { columns, diagonal, x, c });
}

/// `x` ← U⁻¹·`x`, O(n²/2).
#[inline(always)]
pub fn solve<T: Kernels>(columns: &[T], x: &mut [T]) {
    T::solve(Solve { columns, x });
}

/// `x` ← U·`x`, O(n²/2).
#[inline(always)]
pub fn multiply<T: Kernels>(columns: &[T], x: &mut [T]) {
    T::multiply(Multiply { columns, x });
}

/// `x` ← Uᵀ·`x`, O(n²/2).
#[inline(always)]
pub fn multiply_transposed<T: Kernels>(columns: &[T], x: &mut [T]) {
    T::multiply_transposed(MultiplyTransposed { columns, x });
}

/// `product` ← A·`x` for a symmetric A as [`symmetric`](super::symmetric) keeps it, O(n²).
#[inline(always)]
pub fn symmetric_multiply<T: Kernels>(matrix: &[T], x: &[T], product: &mut [T]) {
    T::symmetric_multiply(SymmetricMultiply { matrix, x, product });
}

/// A ← `scale`·A − `x`·`x`ᵀ for the same A, O(n²).
#[inline(always)]
pub fn symmetric_subtract<T: Kernels>(matrix: &mut [T], scale: T, x: &[T]) {
    T::symmetric_subtract(SymmetricSubtract { matrix, scale, x });
}
