//! Adding information: P⁻¹ ← P⁻¹ + fᵀf. P can only shrink, and never below D ≥ floor.

use super::kernel::{self, Step, Stepped};
use super::Factor;
use crate::{Error, Memory, Real};

/// What one scalar measurement with unit variance brings.
#[derive(Clone, Copy, Debug)]
pub struct Measured<T> {
    /// s = f·P·fᵀ, with the P of before
    pub leverage: T,
    /// a = 1 + s
    pub variance: T,
    /// 1 / a
    pub inverse_variance: T,
    /// the largest element of D after it
    pub largest: T,
}

impl<M: Memory> Factor<M> {
    /// P⁻¹ ← P⁻¹ + fᵀf for n numbers `f`; leaves P·fᵀ (with the P of before, that is a times the
    /// gain) in `gain`.
    #[inline]
    pub fn add_information(&mut self, f: &[M::Real], gain: &mut [M::Real]) -> Measured<M::Real> {
        kernel::bierman(self.columns.as_mut(), self.diagonal.as_mut(), f, gain)
    }

    /// P ← `growth`·P, then [`Factor::add_information`], then θ ← θ + P·fᵀe for the n numbers of
    /// `theta` that belong to each e of `errors`: all of it in one pass over U.
    ///
    /// Call [`Factor::reserve`] first.
    #[inline]
    pub(crate) fn measure(
        &mut self,
        growth: M::Real,
        f: &[M::Real],
        gain: &mut [M::Real],
        correct: (&mut [M::Real], &[M::Real]),
    ) -> Measured<M::Real> {
        let factor = (self.columns.as_mut(), self.diagonal.as_mut(), growth);
        kernel::measure(factor, f, gain, correct)
    }

    /// e = y − φθ, P ← `growth`·P, [`Factor::add_information`] and θ ← θ + P·φᵀe, all or nothing:
    /// the error, ‖φ‖² and what was measured, unless the sample or `growth` is too large.
    ///
    /// # Errors
    /// [`Error::Range`] as for [`Factor::reserve`], if the sample itself is one to accept.
    #[inline]
    pub(crate) fn step(
        &mut self,
        growth: M::Real,
        (phi, y): (&[M::Real], M::Real),
        gain: &mut [M::Real],
        theta: &mut [M::Real],
    ) -> (Stepped<M::Real>, Result<(), Error>) {
        let before = self.trace_bound;
        let room = self.reserve(growth, M::Real::ZERO);
        let (columns, diagonal) = (self.columns.as_mut(), self.diagonal.as_mut());
        let refused = room.is_err();
        let stepped =
            M::Real::compute(Step { columns, diagonal, growth, phi, y, gain, theta, refused });
        if stepped.measured.is_none() {
            self.trace_bound = before;
        }
        (stepped, room)
    }

    /// f·P·fᵀ for n numbers `f`.
    #[inline]
    pub fn leverage(&self, f: &[M::Real]) -> M::Real {
        kernel::leverage(self.columns.as_ref(), self.diagonal.as_ref(), f)
    }

    /// D^(−1/2)·U⁻¹·fᵀ in place of `f`: its squared length is f·P⁻¹·fᵀ.
    ///
    /// Gives the vector without the square roots of D; divide products of elements by D.
    #[inline]
    pub fn solve(&self, f: &mut [M::Real]) {
        kernel::solve(self.columns.as_ref(), f);
    }

    /// f·P⁻¹·fᵀ, the information that P⁻¹ holds along `f`, by one triangular solve in `work`.
    #[inline]
    pub fn information_along(&self, f: &[M::Real], work: &mut [M::Real]) -> M::Real {
        work.copy_from_slice(f);
        self.solve(work);
        let diagonal = self.diagonal.as_ref();
        work.iter().zip(diagonal).fold(M::Real::ZERO, |sum, (&z, &d)| sum + z * z / d)
    }

    /// x ← D^(1/2)·Uᵀ·x: the squared length is then xᵀ·P·x. O(n²/2).
    #[inline]
    pub fn apply_root_transposed(&self, x: &mut [M::Real]) {
        kernel::multiply_transposed(self.columns.as_ref(), x);
        for (x, &d) in x.iter_mut().zip(self.diagonal.as_ref()) {
            *x *= d.sqrt();
        }
    }

    /// x ← U·D^(1/2)·x, with the root of which P is the square. O(n²/2).
    #[inline]
    pub fn apply_root(&self, x: &mut [M::Real]) {
        for (x, &d) in x.iter_mut().zip(self.diagonal.as_ref()) {
            *x *= d.sqrt();
        }
        kernel::multiply(self.columns.as_ref(), x);
    }

    /// x ← P·x
    pub fn multiply(&self, x: &mut [M::Real]) {
        kernel::multiply_transposed(self.columns.as_ref(), x);
        for (x, &d) in x.iter_mut().zip(self.diagonal.as_ref()) {
            *x *= d;
        }
        kernel::multiply(self.columns.as_ref(), x);
    }

    /// P⁻¹ as n x n numbers, written to `dense`; uses `work`, of as many. O(n³/2).
    pub fn reconstruct_information(&self, dense: &mut [M::Real], work: &mut [M::Real]) {
        let n = self.parameters();
        for (i, row) in work.chunks_exact_mut(n).enumerate() {
            row.fill(M::Real::ZERO);
            row[i] = M::Real::ONE;
            self.solve(row);
            for (x, &d) in row.iter_mut().zip(self.diagonal.as_ref()) {
                *x /= d.sqrt();
            }
        }
        for i in 0..n {
            for j in 0..=i {
                let (a, b) = (&work[i * n..(i + 1) * n], &work[j * n..(j + 1) * n]);
                let element = kernel::dot(a, b);
                dense[i * n + j] = element;
                dense[j * n + i] = element;
            }
        }
    }
}
