//! Replacing the factor by one that is block diagonal.

use super::Factor;
use crate::memory::Memory;
use forgetting_kernels::kernel::layout;

impl<M: Memory> Factor<M> {
    /// U ← I: what is left of P is its D. To be followed by [`Factor::put_block`]. O(n²).
    pub fn clear_columns(&mut self) {
        layout::set_identity(self.columns.as_mut(), self.memory.parameters());
    }

    /// The block of P from parameter `start` on becomes the U D Uᵀ of this packed triangle and
    /// this diagonal.
    ///
    /// Call [`Factor::reserve`] first, and keep D within range.
    pub fn put_block(&mut self, start: usize, columns: &[M::Real], diagonal: &[M::Real]) {
        self.diagonal.as_mut()[start..start + diagonal.len()].copy_from_slice(diagonal);
        for j in 0..diagonal.len() {
            for i in 0..j {
                let u = columns[layout::place::<M::Real>(i, j)];
                self.columns.as_mut()[layout::place::<M::Real>(start + i, start + j)] = u;
            }
        }
    }
}
