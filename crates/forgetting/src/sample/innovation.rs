//! The innovation of several rows, whitened: L⁻¹ē with L Lᵀ = I + φ̄Pφ̄ᵀ.

use crate::covariance::Factor;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{add_scaled, dot, multiply_transposed};
use forgetting_kernels::Real;

/// ē ← L⁻¹ē for p x n numbers `regressors` and p x m numbers `errors`; returns its squared length,
/// tr ēᵀ(I + φ̄Pφ̄ᵀ)⁻¹ē. Uses p x n numbers `directions` and p x p numbers `identity`.
///
/// I + φ̄Pφ̄ᵀ = V Vᵀ with V = [I, φ̄ U √D]. Gram–Schmidt makes the rows of V orthogonal, and the same
/// steps on ē solve for L⁻¹ē. Each row has an element of I that no other has, so that none becomes
/// shorter than 1, however large P is. Where something of P is deferred, a copy is made first.
pub(crate) fn whiten_errors<M: Memory>(
    factor: &Factor<M>,
    regressors: &[M::Real],
    directions: &mut [M::Real],
    errors: &mut [M::Real],
    identity: &mut [M::Real],
) -> M::Real {
    if factor.is_deferring() {
        let factor = factor.settled();
        return whiten_errors(&factor, regressors, directions, errors, identity);
    }
    let n = factor.parameters();
    let p = regressors.len() / n;
    let m = errors.len() / p;
    let directions = &mut directions[..p * n];
    identity.fill(M::Real::ZERO);
    directions.copy_from_slice(regressors);
    for (i, direction) in directions.chunks_exact_mut(n).enumerate() {
        multiply_transposed(factor.packed_columns(), direction);
        for (x, &d) in direction.iter_mut().zip(factor.diagonal_elements()) {
            *x *= d.sqrt();
        }
        identity[i * p + i] = M::Real::ONE;
    }
    let mut sum = M::Real::ZERO;
    for i in 0..p {
        let (v, later_v) = directions[i * n..].split_at_mut(n);
        let (w, later_w) = identity[i * p..].split_at_mut(p);
        let (e, later_e) = errors[i * m..].split_at_mut(m);
        let length = dot(v, v) + dot(w, w);
        sum += dot(e, e) / length;
        let later = later_v.chunks_exact_mut(n).zip(later_w.chunks_exact_mut(p));
        for ((x, y), z) in later.zip(later_e.chunks_exact_mut(m)) {
            let overlap = (dot(v, x) + dot(w, y)) / length;
            add_scaled(x, -overlap, v);
            add_scaled(y, -overlap, w);
            add_scaled(z, -overlap, e);
        }
        let deviation = length.sqrt();
        e.iter_mut().for_each(|e| *e /= deviation);
    }
    sum
}
