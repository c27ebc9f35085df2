//! Changes of P along eigenvectors.

use super::Spectrum;
use crate::covariance::Factor;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::add_scaled;
use forgetting_kernels::Real;

impl<M: Memory> Spectrum<M> {
    /// P ← P + `weight`·v_i v_iᵀ with `weight` ≥ 0; uses n numbers `direction`.
    ///
    /// Call [`Factor::reserve`] first: `room` is what is left of it. What r_i is known to, next to a
    /// much larger one, may be nothing, and 1/r_i then be more than all of P. The spectrum stays
    /// as it is.
    #[inline(never)]
    pub fn widen(
        &self,
        i: usize,
        (weight, room): (M::Real, &mut M::Real),
        factor: &mut Factor<M>,
        direction: &mut [M::Real],
    ) {
        let weight = weight.min(*room);
        *room -= weight;
        direction.copy_from_slice(self.vector(i));
        factor.add_covariance(direction, weight);
    }

    /// P⁻¹ ← P⁻¹ + `weight`·v_i v_iᵀ with `weight` ≥ 0; uses n numbers
    /// each of `row` and `gain`.
    ///
    /// The spectrum stays as it is.
    #[inline(never)]
    pub fn narrow(
        &self,
        i: usize,
        weight: M::Real,
        factor: &mut Factor<M>,
        (row, gain): (&mut [M::Real], &mut [M::Real]),
    ) {
        let row = &mut row[..self.memory.parameters()];
        row.fill(M::Real::ZERO);
        add_scaled(row, weight.sqrt(), self.vector(i));
        factor.add_information(row, gain);
    }
}
