//! The loops over U: one function per operation, on plain slices.
//!
//! `columns` holds U above its unit diagonal, column j (j numbers) from j (j − 1) / 2 on; every
//! inner loop runs along one column, over neighbouring numbers.

mod bierman;
mod block;

use crate::Real;

/// Column j of the packed triangle.
#[inline(always)]
pub fn column<T>(columns: &[T], j: usize) -> &[T] {
    let start = j * j.saturating_sub(1) / 2;
    &columns[start..start + j]
}

/// Column j of the packed triangle, to be written.
#[inline(always)]
pub fn column_mut<T>(columns: &mut [T], j: usize) -> &mut [T] {
    let start = j * j.saturating_sub(1) / 2;
    &mut columns[start..start + j]
}

/// Σ aᵢ bᵢ over the shorter of the two, in eight partial sums.
#[inline(always)]
pub fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    const LANES: usize = 8;
    let length = a.len().min(b.len());
    let (a, b) = (&a[..length], &b[..length]);
    let (mut blocks_a, mut blocks_b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let mut partial = [T::ZERO; LANES];
    for (x, y) in blocks_a.by_ref().zip(blocks_b.by_ref()) {
        for lane in 0..LANES {
            partial[lane] = x[lane].mul_add(y[lane], partial[lane]);
        }
    }
    let mut sum = ((partial[0] + partial[4]) + (partial[1] + partial[5]))
        + ((partial[2] + partial[6]) + (partial[3] + partial[7]));
    for (&x, &y) in blocks_a.remainder().iter().zip(blocks_b.remainder()) {
        sum = x.mul_add(y, sum);
    }
    sum
}

/// `y` += c·`x`
#[inline(always)]
pub fn add_scaled<T: Real>(y: &mut [T], c: T, x: &[T]) {
    for (y, &x) in y.iter_mut().zip(x) {
        *y = c.mul_add(x, *y);
    }
}

/// f·P·fᵀ = Σ_j D_j (Uᵀfᵀ)_j², O(n²/2).
#[inline(always)]
pub fn leverage<T: Real>(columns: &[T], diagonal: &[T], f: &[T]) -> T {
    diagonal.iter().enumerate().fold(T::ZERO, |sum, (j, &d)| {
        let w = f[j] + dot(column(columns, j), f);
        sum + d * w * w
    })
}

/// Bierman's measurement update with unit variance: P⁻¹ ← P⁻¹ + fᵀf.
///
/// Returns `(s, a)`, the leverage s = f·P·fᵀ and the innovation variance a = 1 + s, and leaves
/// a times the gain, P·fᵀ with the P of before, in `gain`. O(1.5 n²).
#[inline(always)]
pub fn bierman<T: Real>(columns: &mut [T], diagonal: &mut [T], f: &[T], gain: &mut [T]) -> (T, T) {
    T::compute(bierman::Bierman { columns, diagonal, f, gain })
}

/// Agee and Turner's update: P ← P + c·x·xᵀ with c ≥ 0. Uses up `x`. O(n²).
///
/// W. S. Agee and R. H. Turner, *Triangular decomposition of a positive definite matrix plus a
/// symmetric dyad with applications to Kalman filtering*, 1972.
#[inline(always)]
pub fn agee_turner<T: Real>(columns: &mut [T], diagonal: &mut [T], x: &mut [T], mut c: T) {
    for j in (0..diagonal.len()).rev() {
        let (above, from) = x.split_at_mut(j);
        let s = from[0];
        let before = diagonal[j];
        let after = (c * s).mul_add(s, before);
        let inverse = T::ONE / after;
        let slope = c * s * inverse;
        for (u, x) in column_mut(columns, j).iter_mut().zip(above) {
            *x = (-s).mul_add(*u, *x);
            *u = slope.mul_add(*x, *u);
        }
        diagonal[j] = after;
        // in this order: c alone may be large, and its product with D overflow
        c *= before * inverse;
    }
}

/// `x` ← U⁻¹·`x`, O(n²/2).
#[inline(always)]
pub fn solve<T: Real>(columns: &[T], x: &mut [T]) {
    for j in (0..x.len()).rev() {
        let (above, from) = x.split_at_mut(j);
        add_scaled(above, -from[0], column(columns, j));
    }
}

/// `x` ← U·`x`, O(n²/2).
#[inline(always)]
pub fn multiply<T: Real>(columns: &[T], x: &mut [T]) {
    for j in 0..x.len() {
        let (above, from) = x.split_at_mut(j);
        add_scaled(above, from[0], column(columns, j));
    }
}

/// `x` ← Uᵀ·`x`, O(n²/2).
#[inline(always)]
pub fn multiply_transposed<T: Real>(columns: &[T], x: &mut [T]) {
    for j in (0..x.len()).rev() {
        x[j] += dot(column(columns, j), x);
    }
}
