//! The spectrum from the factor, by Jacobi rotations.

use super::rows::{rotate, two_rows};
use super::Spectrum;
use crate::covariance::Factor;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{add_scaled, dot, multiply_transposed};
use forgetting_kernels::Kernels;
use forgetting_kernels::Real;

const SWEEPS: usize = 40;

impl<M: Memory> Spectrum<M> {
    /// Computes the spectrum of P⁻¹ from the factor of P, starting from the vectors it has.
    ///
    /// With V the vectors as rows, V·U·D^(1/2) has orthogonal rows, of squared lengths 1/r_i,
    /// exactly when V holds eigenvectors: the rows are rotated until they are (one-sided
    /// Jacobi). P is never inverted, nor its condition squared. O(n³) a sweep; few are needed
    /// from a good start.
    pub fn renew(&mut self, factor: &Factor<M>) {
        let n = self.memory.parameters();
        if !orthonormalize(self.vectors.as_mut(), n) {
            axes(self.vectors.as_mut(), n);
        }
        let rows = self.square.as_mut();
        rows.copy_from_slice(self.vectors.as_ref());
        for row in rows.chunks_exact_mut(n) {
            multiply_transposed(factor.packed_columns(), row);
            for (x, &d) in row.iter_mut().zip(factor.diagonal_elements()) {
                *x *= d.sqrt();
            }
        }
        make_orthogonal(rows, self.vectors.as_mut(), n);
        for i in 0..n {
            let row = &self.square.as_ref()[i * n..(i + 1) * n];
            let variance = dot(row, row);
            self.set_information(i, M::Real::ONE / variance.max(M::Real::FLOOR));
        }
        self.sort();
    }
}

/// Rotates n rows of n numbers until they are orthogonal, and `vectors` with them (one-sided
/// Jacobi).
pub(crate) fn make_orthogonal<T: Kernels>(rows: &mut [T], vectors: &mut [T], n: usize) {
    let tolerance = T::EPSILON * T::from_f64(4.0 * n as f64).sqrt();
    for _ in 0..SWEEPS {
        if !sweep(rows, vectors, n, tolerance) {
            break;
        }
    }
}

/// The rows of the identity.
pub(super) fn axes<T: Real>(rows: &mut [T], n: usize) {
    rows.fill(T::ZERO);
    rows.iter_mut().step_by(n + 1).for_each(|x| *x = T::ONE);
}

/// One rotation of each pair of rows that needs it; whether any did.
fn sweep<T: Kernels>(rows: &mut [T], vectors: &mut [T], n: usize, tolerance: T) -> bool {
    let mut rotated = false;
    for i in 0..n {
        for k in i + 1..n {
            let (x, y) = two_rows(rows, n, i, k);
            let (a, b, c) = (dot(x, x), dot(y, y), dot(x, y));
            // what is left turns the eigenvectors by less than the tolerance
            if c.abs() <= tolerance * a.max(b) {
                continue;
            }
            let (cosine, sine) = rotation(a, b, c);
            rotate(x, y, cosine, sine);
            let (v, w) = two_rows(vectors, n, i, k);
            rotate(v, w, cosine, sine);
            rotated = true;
        }
    }
    rotated
}

/// The rotation that makes c zero in [[a, c], [c, b]].
pub(super) fn rotation<T: Kernels>(a: T, b: T, c: T) -> (T, T) {
    let zeta = (b - a) / (c + c);
    let sign = if zeta < T::ZERO { -T::ONE } else { T::ONE };
    let tangent = sign / (zeta.abs() + (T::ONE + zeta * zeta).sqrt());
    let cosine = T::ONE / (T::ONE + tangent * tangent).sqrt();
    (cosine, cosine * tangent)
}

/// Makes nearly orthonormal rows orthonormal; false if they were far from it.
fn orthonormalize<T: Kernels>(rows: &mut [T], n: usize) -> bool {
    for i in 0..n {
        let (done, rest) = rows.split_at_mut(i * n);
        let row = &mut rest[..n];
        for before in done.chunks_exact(n) {
            add_scaled(row, -dot(before, row), before);
        }
        let length = dot(row, row).sqrt();
        if !(length > T::from_f64(0.5) && length < T::from_f64(2.0)) {
            return false;
        }
        row.iter_mut().for_each(|x| *x *= T::ONE / length);
    }
    true
}
