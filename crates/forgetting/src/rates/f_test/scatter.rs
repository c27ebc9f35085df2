//! The scatter matrix A = Σ z zᵀ of the errors z of past samples, and a root of its inverse.

use crate::sample::cholesky;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Kernels;

/// xᵀA⁻¹y with A⁻¹ = LᵀL, of which `root` holds the lower triangle L row by row.
#[inline]
pub(super) fn product<T: Kernels>(root: &[T], x: &[T], y: &[T]) -> T {
    let rows = root.chunks_exact(x.len()).enumerate().take(x.len());
    rows.fold(T::ZERO, |sum, (i, row)| {
        let row = &row[..=i];
        sum + dot(row, x) * dot(row, y)
    })
}

/// Σ z zᵀ over the ring, written to `sum`.
pub(super) fn sum_of_squares<T: Kernels>(ring: &[T], sum: &mut [T], d: usize) {
    if d == 1 {
        sum[0] = dot(ring, ring);
        return;
    }
    sum.fill(T::ZERO);
    for z in ring.chunks_exact(d) {
        for (row, &c) in sum.chunks_exact_mut(d).zip(z) {
            add_scaled(row, c, z);
        }
    }
}

/// The d x d matrix A in `a` becomes L with A⁻¹ = LᵀL, or 0 if A is singular.
pub(super) fn inverse_root<T: Kernels>(a: &mut [T], d: usize) {
    let tolerance = T::EPSILON * T::from_f64(64.0 * d as f64);
    let regular = cholesky(a, d, "errors").is_ok()
        && a.chunks_exact(d).enumerate().all(|(i, row)| {
            let row = &row[..=i];
            row[i] * row[i] > tolerance * dot(row, row)
        });
    if !regular {
        a.fill(T::ZERO);
        return;
    }
    for j in 0..d {
        a[j * d + j] = T::ONE / a[j * d + j];
        for i in j + 1..d {
            let sum = (j..i).fold(T::ZERO, |sum, k| sum + a[i * d + k] * a[k * d + j]);
            a[i * d + j] = -sum / a[i * d + i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{inverse_root, product};

    #[test]
    fn the_root_of_the_inverse_is_one() {
        let a: [f64; 9] = [4.0, 2.0, 0.4, 2.0, 5.0, -1.0, 0.4, -1.0, 3.0];
        let mut root = a;
        inverse_root(&mut root, 3);
        // x' A^-1 y for y = a column of A is an element of x
        for (i, column) in a.chunks_exact(3).enumerate() {
            let x = [0.3, -0.7, 1.1];
            assert!((product(&root, &x, column) - x[i]).abs() < 1e-15);
        }
        let mut singular = [1.0, 2.0, 2.0, 4.0];
        inverse_root(&mut singular, 2);
        assert_eq!(singular, [0.0; 4]);
    }
}
