//! What a rank-one change leaves alone is left out of the secular equation.

use super::rows::{rotate, two_rows};
use super::Spectrum;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::Real;

impl<M: Memory> Spectrum<M> {
    /// Leaves the components of `row` in `components`, 0 where it changes nothing, and those
    /// that are not 0 with their eigenvalues in `weights` and `poles`; returns their number.
    pub(super) fn deflate(&mut self, row: &[M::Real]) -> usize {
        let n = self.memory.parameters();
        let length = dot(row, row).sqrt();
        let (mut active, mut last) = (0, 0);
        for i in 0..n {
            let value = self.information.as_ref()[i];
            let mut z = dot(&self.vectors.as_ref()[i * n..(i + 1) * n], row);
            if negligible(z, value, length) {
                self.components.as_mut()[i] = M::Real::ZERO;
                continue;
            }
            if active > 0 && value - self.poles.as_ref()[active - 1] <= same(value) {
                z = self.merge(last, i, z);
                active -= 1;
            }
            self.components.as_mut()[i] = z;
            self.poles.as_mut()[active] = value;
            self.weights.as_mut()[active] = z;
            active += 1;
            last = i;
        }
        active
    }

    /// Turns the vectors of two equal eigenvalues so that the row has no component along the
    /// first; returns its component along the second.
    fn merge(&mut self, first: usize, second: usize, z: M::Real) -> M::Real {
        let n = self.memory.parameters();
        let before = self.components.as_ref()[first];
        let both = (before * before + z * z).sqrt();
        let (x, y) = two_rows(self.vectors.as_mut(), n, first, second);
        rotate(x, y, z / both, before / both);
        self.components.as_mut()[first] = M::Real::ZERO;
        both
    }
}

/// Whether z²/(r + z²) is beyond the precision: then neither the eigenvalue nor, against the
/// rounding of a row of this length, the eigenvector changes.
fn negligible<T: Real>(z: T, value: T, length: T) -> bool {
    let square = z * z;
    square <= T::EPSILON * T::EPSILON * value
        || (z.abs() <= T::EPSILON * length && square <= T::EPSILON * value)
}

/// The difference below which two eigenvalues of this size are the same.
fn same<T: Real>(value: T) -> T {
    value * (T::EPSILON * T::from_f64(4.0))
}
