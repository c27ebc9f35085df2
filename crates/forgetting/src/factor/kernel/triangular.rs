//! Products and solutions with U and Uᵀ, and f·P·fᵀ. O(n²/2) each.

use super::block::{add_columns, dots, load_triangle, with_width, PerColumn};
use super::layout::BLOCK;
use super::small::Small;
use crate::vector::Vector;
use crate::{Kernel, Real};

/// f·P·fᵀ = Σ_j D_j (Uᵀfᵀ)_j²
pub struct Leverage<'a, T> {
    pub columns: &'a [T],
    pub diagonal: &'a [T],
    pub f: &'a [T],
}

impl<T: Real> Kernel<T> for Leverage<'_, T> {
    type Output = T;

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> T {
        leverage_of::<T, V, GROUP>(self.columns, self.diagonal, self.f)
    }
}

/// f·P·fᵀ, inside another kernel.
#[inline(always)]
pub fn leverage_of<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    diagonal: &[T],
    f: &[T],
) -> T {
    if f.len() <= BLOCK {
        return with_width!(f.len(), few::<T>(columns, diagonal, f));
    }
    let mut sum = T::ZERO;
    for j in (0..diagonal.len()).step_by(BLOCK) {
        let d = &diagonal[j..diagonal.len().min(j + BLOCK)];
        let w = dots::<T, V, GROUP>(columns, j, d.len(), f);
        for (&d, &w) in d.iter().zip(&w) {
            sum = (d * w).mul_add(w, sum);
        }
    }
    sum
}

#[inline(always)]
fn few<T: Real, const N: usize>(columns: &[T], diagonal: &[T], f: &[T]) -> T {
    match (diagonal.first_chunk::<N>(), f.first_chunk::<N>()) {
        (Some(d), Some(f)) => Small::<T, N>::load(columns, d).leverage(f),
        _ => T::ZERO,
    }
}

/// `x` ← Uᵀ·`x`
pub struct MultiplyTransposed<'a, T> {
    pub columns: &'a [T],
    pub x: &'a mut [T],
}

impl<T: Real> Kernel<T> for MultiplyTransposed<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, x } = self;
        for j in (0..x.len()).step_by(BLOCK).rev() {
            let width = BLOCK.min(x.len() - j);
            let w = dots::<T, V, GROUP>(columns, j, width, x);
            x[j..j + width].copy_from_slice(&w[..width]);
        }
    }
}

/// `x` ← U⁻¹·`x`
pub struct Solve<'a, T> {
    pub columns: &'a [T],
    pub x: &'a mut [T],
}

impl<T: Real> Kernel<T> for Solve<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, x } = self;
        for j in (0..x.len()).step_by(BLOCK).rev() {
            let width = BLOCK.min(x.len() - j);
            let factors = with_width!(width, solve_triangle::<T>(columns, j, x));
            add_columns::<T, V, GROUP>(columns, j, width, x, &factors);
        }
    }
}

/// The triangle of a block: `x` from j on solved; returns it with the opposite sign.
#[inline(always)]
pub fn solve_triangle<T: Real, const C: usize>(
    columns: &[T],
    j: usize,
    x: &mut [T],
) -> PerColumn<T> {
    let mut factors = [T::ZERO; BLOCK];
    let Some(x) = x[j..].first_chunk_mut::<C>() else { return factors };
    let u = load_triangle::<T, C>(columns, j);
    let mut rest = *x;
    for c in (0..C).rev() {
        factors[c] = -rest[c];
        for i in 0..c {
            rest[i] = factors[c].mul_add(u[c][i], rest[i]);
        }
    }
    *x = rest;
    factors
}

/// `x` ← U·`x`
pub struct Multiply<'a, T> {
    pub columns: &'a [T],
    pub x: &'a mut [T],
}

impl<T: Real> Kernel<T> for Multiply<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, x } = self;
        for j in (0..x.len()).step_by(BLOCK) {
            let width = BLOCK.min(x.len() - j);
            let factors = with_width!(width, multiply_triangle::<T>(columns, j, x));
            add_columns::<T, V, GROUP>(columns, j, width, x, &factors);
        }
    }
}

/// The triangle of a block: `x` from j on multiplied; returns it as it was.
#[inline(always)]
fn multiply_triangle<T: Real, const C: usize>(
    columns: &[T],
    j: usize,
    x: &mut [T],
) -> PerColumn<T> {
    let mut factors = [T::ZERO; BLOCK];
    let Some(x) = x[j..].first_chunk_mut::<C>() else { return factors };
    let u = load_triangle::<T, C>(columns, j);
    for c in 0..C {
        factors[c] = x[c];
        for i in 0..c {
            x[i] = factors[c].mul_add(u[c][i], x[i]);
        }
    }
    factors
}
