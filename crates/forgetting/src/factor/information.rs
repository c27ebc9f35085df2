//! Adding information: P⁻¹ ← P⁻¹ + fᵀf. P can only shrink, and never below D ≥ floor.

use super::kernel::{self, Measure, Place, Steps, Told};
use super::{Factor, Form};
use crate::{Error, Memory, Real};

/// What one scalar measurement with unit variance brings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measured<T> {
    /// s = f·P·fᵀ, with the P of before
    pub leverage: T,
    /// a = 1 + s
    pub variance: T,
    /// 1 / a
    pub inverse_variance: T,
    /// the largest element of D after it
    pub largest: T,
    /// whether anything was forgotten on the way
    pub forgot: bool,
}

impl<M: Memory> Factor<M> {
    /// P⁻¹ ← P⁻¹ + fᵀf for n numbers `f`; leaves P·fᵀ (with the P of before, that is a times the
    /// gain) in `gain`.
    #[inline]
    pub fn add_information(&mut self, f: &[M::Real], gain: &mut [M::Real]) -> Measured<M::Real> {
        kernel::bierman(self.columns.as_mut(), self.diagonal.as_mut(), f, gain)
    }

    /// Forgets as `form` says, then [`Factor::add_information`], then θ ← θ + P·fᵀe for the n numbers
    /// of `theta` that belong to each e of `errors`: all of it in one pass over U.
    ///
    /// `squares` is ‖f‖²; `scratch` holds [`kernel::scratch`] numbers.
    ///
    /// # Errors
    /// [`Error::Range`] when P would leave the range of the number type; P is as it was.
    #[inline]
    pub(crate) fn measure(
        &mut self,
        form: Form<M::Real>,
        (f, squares): (&[M::Real], M::Real),
        scratch: &mut [M::Real],
        (theta, errors): (&mut [M::Real], &[M::Real]),
    ) -> Result<Measured<M::Real>, Error> {
        let before = self.trace_bound;
        for tightened in [false, true] {
            if tightened {
                self.tighten();
            }
            let place = self.place(scratch);
            let task = Measure { place, form, f, squares, theta, errors };
            if let Some(measured) = M::Real::compute(task) {
                return Ok(measured);
            }
        }
        let (growth, added) = match form {
            Form::Scale { growth } => (growth, M::Real::ZERO),
            Form::Along { weight, .. } => {
                let information = self.information_along(f, &mut scratch[..f.len()]);
                (M::Real::ONE, weight / information * squares)
            }
        };
        let refused = self.reserve(growth, added);
        self.trace_bound = before;
        refused.map(|()| unreachable!("the kernel found no room"))
    }

    /// Takes samples of one row and one target, until one is to be refused or looked at closely;
    /// returns how many it took.
    ///
    /// The sizes are those of [`Steps`](kernel), `scratch` as above.
    #[inline]
    pub(crate) fn advance(
        &mut self,
        form: Form<M::Real>,
        (phi, y): (&[M::Real], &[M::Real]),
        scratch: &mut [M::Real],
        theta: &mut [M::Real],
        (told, thetas): (&mut [Told<M::Real>], &mut [M::Real]),
    ) -> usize {
        let place = self.place(scratch);
        kernel::advance(&mut Steps { place, form, phi, y, theta, told, thetas })
    }

    #[inline]
    fn place<'a>(&'a mut self, scratch: &'a mut [M::Real]) -> Place<'a, M::Real> {
        let (columns, diagonal) = (self.columns.as_mut(), self.diagonal.as_mut());
        Place { columns, diagonal, scratch, bound: &mut self.trace_bound }
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
