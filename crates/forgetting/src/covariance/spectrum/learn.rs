//! What a sample adds to P⁻¹.

use super::Spectrum;
use crate::memory::Memory;
use forgetting_kernels::kernel::eigen::{RankOneUpdate, Rows};
use forgetting_kernels::{Kernels, Real};

impl<M: Memory> Spectrum<M> {
    /// R ← R + fᵀf for n numbers `row`: what a whitened row of a sample adds.
    ///
    /// By the secular equation, each root of which is a new eigenvalue; the eigenvectors are
    /// those of a matrix with exactly these roots, and so orthogonal to working precision.
    ///
    /// J. R. Bunch, C. P. Nielsen, D. C. Sorensen, *Rank-one modification of the symmetric
    /// eigenproblem*, Numerische Mathematik 31, 1978; M. Gu, S. C. Eisenstat, *A stable and
    /// efficient algorithm for the rank-one modification of the symmetric eigenproblem*, SIAM
    /// Journal on Matrix Analysis and Applications 15, 1994.
    pub fn learn(&mut self, row: &[M::Real]) {
        self.sort();
        let active = self.deflate(row);
        if active == 1 {
            let mut components = self.components.as_ref().iter();
            if let Some(i) = components.position(|z| *z != M::Real::ZERO) {
                let added = self.weights.as_ref()[0] * self.weights.as_ref()[0];
                self.set_information(i, self.information.as_ref()[i] + added);
            }
        } else if active > 1 && !self.update(active) {
            self.age = 0; // out of range: compute it from P at the next sample
        }
        if !self.is_spectrum() {
            self.age = 0; // it came from a saved state that was altered
        }
    }

    /// The same for every row of a whitened sample, n numbers each.
    pub fn learn_rows(&mut self, rows: &[M::Real]) {
        for row in rows.chunks_exact(self.memory.parameters()) {
            self.learn(row);
        }
    }

    /// The new eigenvalues and eigenvectors of the `active` ones; false if out of range.
    fn update(&mut self, active: usize) -> bool {
        let n = self.memory.parameters();
        let components = self.components.as_ref();
        let roots = &mut self.roots.as_mut()[..active];
        let sound = M::Real::update_eigenvectors(RankOneUpdate {
            poles: &self.poles.as_ref()[..active],
            weights: &self.weights.as_ref()[..active],
            rows: Rows { vectors: self.vectors.as_ref(), n, components },
            turn: &mut self.square.as_mut()[..active * active],
            roots,
            product: self.product.as_mut(),
        });
        if !sound {
            return false;
        }
        let mut combined = self.product.as_ref().chunks_exact(n).zip(roots.iter());
        for (i, vector) in self.vectors.as_mut().chunks_exact_mut(n).enumerate() {
            if components[i] != M::Real::ZERO {
                if let Some((row, &root)) = combined.next() {
                    vector.copy_from_slice(row);
                    self.information.as_mut()[i] = root.max(M::Real::FLOOR).min(M::Real::CEILING);
                }
            }
        }
        true
    }
}
