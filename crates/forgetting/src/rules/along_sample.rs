//! Forgetting along the rows of a sample, for the rules that decompose the information matrix.

use super::Step;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Real;

/// P ← P + (1 − λ)/λ · φ̄ᵀ (φ̄ R φ̄ᵀ)⁺ φ̄ over the rows of the sample; returns the rank of φ̄ R φ̄ᵀ.
///
/// By Gram–Schmidt in the inner product of R: with z_i = D^(−1/2)U⁻¹φ̄_i, orthonormalizing the z_i
/// turns the rows φ̄_i into vectors w_i with w_iᵀ R w_j = δ_ij, and the covariance to add is the
/// sum of w_i w_iᵀ. A row that depends on those before it adds nothing.
///
/// # Errors
/// [`Error::Range`] when P would overflow; P is as it was.
#[inline]
pub fn forget_along_sample<M: Memory>(step: &mut Step<'_, '_, M>) -> Result<usize, Error> {
    forget_along_rows(step, M::Real::ZERO)
}

/// The same along those rows of the sample that are longer than `least`.
///
/// # Errors
/// [`Error::Range`] when P would overflow; P is as it was.
#[inline]
pub fn forget_along_rows<M: Memory>(
    step: &mut Step<'_, '_, M>,
    least: M::Real,
) -> Result<usize, Error> {
    let lambda = step.forgetting_factor;
    if lambda >= M::Real::ONE {
        return Ok(0);
    }
    let weight = (M::Real::ONE - lambda) / lambda;
    if step.sample.rows() == 1 {
        return forget_along_row(step, weight);
    }
    let n = step.factor.parameters();
    let rank = orthonormalize(step, least);
    let directions = &mut step.work.first.as_mut()[..rank * n];
    step.factor.reserve(M::Real::ONE, weight * dot(directions, directions))?;
    for direction in directions.chunks_exact_mut(n) {
        step.factor.add_covariance(direction, weight);
    }
    Ok(rank)
}

#[inline]
fn forget_along_row<M: Memory>(
    step: &mut Step<'_, '_, M>,
    weight: M::Real,
) -> Result<usize, Error> {
    let n = step.factor.parameters();
    let row = step.sample.row(0);
    let information = step.factor.information_along(row, &mut step.work.first.as_mut()[..n]);
    let c = weight / information;
    if !(c > M::Real::ZERO && c.is_finite()) {
        return Ok(0); // φ = 0, or more information than the number type can hold
    }
    let direction = &mut step.work.first.as_mut()[..n];
    direction.copy_from_slice(row);
    step.factor.reserve(M::Real::ONE, c * dot(row, row))?;
    step.factor.add_covariance(direction, c);
    Ok(1)
}

/// Leaves the w_i in `work.first`, one after the other, and returns their number.
fn orthonormalize<M: Memory>(step: &mut Step<'_, '_, M>, least: M::Real) -> usize {
    let n = step.factor.parameters();
    let (first, second) = (step.work.first.as_mut(), step.work.second.as_mut());
    let mut rank = 0;
    for i in 0..step.sample.rows() {
        if !(dot(step.sample.row(i), step.sample.row(i)).sqrt() > least) {
            continue;
        }
        let (done_w, w) = first.split_at_mut(rank * n);
        let (done_z, z) = second.split_at_mut(rank * n);
        let (w, z) = (&mut w[..n], &mut z[..n]);
        w.copy_from_slice(step.sample.row(i));
        z.copy_from_slice(w);
        step.factor.solve(z);
        for (z, &d) in z.iter_mut().zip(step.factor.diagonal_elements()) {
            *z /= d.sqrt();
        }
        let before = dot(z, z);
        // twice is enough: the second pass removes what rounding left
        for _ in 0..2 {
            for (u, v) in done_w.chunks_exact(n).zip(done_z.chunks_exact(n)) {
                let overlap = dot(v, z);
                add_scaled(z, -overlap, v);
                add_scaled(w, -overlap, u);
            }
        }
        let after = dot(z, z);
        let tolerance = M::Real::EPSILON * M::Real::from_f64(64.0 * n as f64);
        if after > tolerance * tolerance * before && after.is_finite() && after > M::Real::ZERO {
            let scale = M::Real::ONE / after.sqrt();
            w.iter_mut().chain(z.iter_mut()).for_each(|x| *x *= scale);
            rank += 1;
        }
    }
    rank
}
