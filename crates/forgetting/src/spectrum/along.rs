//! Changes of P along eigenvectors.

use super::Spectrum;
use crate::factor::kernel::add_scaled;
use crate::{Factor, Memory, Real, Work};

impl<M: Memory> Spectrum<M> {
    /// P ← P + `weight`·v_i v_iᵀ with `weight` ≥ 0; uses `work.gain`.
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
        work: &mut Work<M>,
    ) {
        let weight = weight.min(*room);
        *room -= weight;
        let direction = work.gain.as_mut();
        direction.copy_from_slice(self.vector(i));
        factor.add_covariance(direction, weight);
    }

    /// P⁻¹ ← P⁻¹ + `weight`·v_i v_iᵀ with `weight` ≥ 0; uses `work.gain` and `work.first`.
    ///
    /// The spectrum stays as it is.
    #[inline(never)]
    pub fn narrow(&self, i: usize, weight: M::Real, factor: &mut Factor<M>, work: &mut Work<M>) {
        let row = &mut work.first.as_mut()[..self.memory.parameters()];
        row.fill(M::Real::ZERO);
        add_scaled(row, weight.sqrt(), self.vector(i));
        factor.add_information(row, work.gain.as_mut());
    }
}
