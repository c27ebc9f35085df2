//! A root of a block on the diagonal of P: what adds a multiple of that block to P.

use crate::covariance::Factor;
use crate::memory::Memory;
use core::ops::Range;
use forgetting_kernels::kernel::{functions, layout};
use forgetting_kernels::Real;

/// Room for V and d of one block, P_bb = V diag(d) Vᵀ.
#[derive(Clone, Debug)]
pub struct BlockRoot<M: Memory> {
    columns: M::Packed,
    diagonal: M::Vector,
}

impl<M: Memory> BlockRoot<M> {
    /// Room for any block.
    pub fn new(memory: M) -> Self {
        Self { columns: memory.packed(), diagonal: memory.vector() }
    }

    /// P_bb = V diag(d) Vᵀ: the block's own triangle of U, and a dyad for each later column; of a
    /// block of one, its element of `variances`, the diagonal of P. Uses n numbers `x`.
    pub fn compute(
        &mut self,
        factor: &Factor<M>,
        range: Range<usize>,
        variances: &[M::Real],
        x: &mut [M::Real],
    ) {
        let (size, start) = (range.len(), range.start);
        if size == 1 {
            self.diagonal.as_mut()[0] = variances[start];
            return;
        }
        let columns = &mut self.columns.as_mut()[..layout::length::<M::Real>(size)];
        let diagonal = &mut self.diagonal.as_mut()[..size];
        diagonal.copy_from_slice(&factor.diagonal_elements()[range.clone()]);
        for j in 0..size {
            for i in 0..j {
                columns[layout::place::<M::Real>(i, j)] = factor.unit(start + i, start + j);
            }
        }
        for k in range.end..factor.parameters() {
            let x = &mut x[..size];
            for (x, i) in x.iter_mut().zip(range.clone()) {
                *x = factor.unit(i, k);
            }
            functions::agee_turner(columns, diagonal, x, factor.diagonal_elements()[k]);
        }
    }

    /// P ← P + `weight`·P_bb; uses n numbers `direction`.
    ///
    /// Call [`Factor::reserve`] first.
    pub fn add_to(
        &self,
        factor: &mut Factor<M>,
        range: Range<usize>,
        weight: M::Real,
        direction: &mut [M::Real],
    ) {
        if range.len() == 1 {
            return factor.add_variance(range.start, weight * self.diagonal.as_ref()[0], direction);
        }
        for (j, &d) in self.diagonal.as_ref()[..range.len()].iter().enumerate() {
            direction.fill(M::Real::ZERO);
            layout::get_column(self.columns.as_ref(), j, &mut direction[range.start..]);
            direction[range.start + j] = M::Real::ONE;
            factor.add_covariance(direction, weight * d);
        }
    }
}
