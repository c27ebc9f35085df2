//! Measure and correct: R₊ = R̄ + φᵀΓ⁻¹φ and θ₊ = θ + R₊⁻¹φᵀΓ⁻¹(y − φθ).

use super::Sample;
use crate::covariance::Factor;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Real;

/// tr φ̄Pφ̄ᵀ
#[inline]
pub fn leverage<M: Memory>(factor: &Factor<M>, sample: &Sample<'_, M>) -> M::Real {
    (0..sample.rows()).fold(M::Real::ZERO, |sum, i| sum + factor.leverage(sample.row(i)))
}

/// Measures and corrects, row by row; returns the leverage with the P before the sample.
///
/// Whitened rows are independent, so they are measured one after the other. After each, the
/// innovations of the later ones are reduced by what its correction of θ explains.
pub fn measure_rows<M: Memory>(
    factor: &mut Factor<M>,
    sample: &Sample<'_, M>,
    gain: &mut [M::Real],
    theta: &mut [M::Real],
    remaining: &mut M::Errors,
) -> M::Real {
    let n = factor.parameters();
    let mut leverage = M::Real::ZERO;
    for i in 0..sample.rows() {
        factor.expose(sample.row(i), gain);
    }
    for i in 0..sample.rows() {
        leverage += factor.exposed_leverage(sample.row(i));
    }
    let (m, remaining) = (sample.error(0).len(), remaining.as_mut());
    remaining[..sample.errors().len()].copy_from_slice(sample.errors());
    for i in 0..sample.rows() {
        let measured = factor.add_exposed(sample.row(i), gain);
        let (used, later) = remaining.split_at_mut((i + 1) * m);
        let used = &mut used[i * m..];
        used.iter_mut().for_each(|error| *error *= measured.inverse_variance);
        for (theta, &step) in theta.chunks_exact_mut(n).zip(used.iter()) {
            add_scaled(theta, step, gain);
        }
        for (k, errors) in (i + 1..sample.rows()).zip(later.chunks_exact_mut(m)) {
            add_scaled(errors, -dot(sample.row(k), gain), used);
        }
    }
    leverage
}
