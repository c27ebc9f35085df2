//! Adding information: P⁻¹ ← P⁻¹ + fᵀf. P can only shrink, and never below D ≥ floor.

use super::Factor;
use crate::memory::Memory;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::functions;
use forgetting_kernels::kernel::measure::{Measure, Place};
use forgetting_kernels::kernel::measured::Measured;
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::kernel::runs::Steps;
use forgetting_kernels::Kernels;
use forgetting_kernels::Real;

impl<M: Memory> Factor<M> {
    /// P⁻¹ ← P⁻¹ + fᵀf for n numbers `f`; leaves P·fᵀ (with the P of before, that is a times the
    /// gain) in `gain`.
    #[inline]
    pub fn add_information(&mut self, f: &[M::Real], gain: &mut [M::Real]) -> Measured<M::Real> {
        self.expose(f, gain);
        self.add_exposed(f, gain)
    }

    /// The same where nothing of P along `f` is deferred.
    #[inline]
    pub(crate) fn add_exposed(&mut self, f: &[M::Real], gain: &mut [M::Real]) -> Measured<M::Real> {
        functions::bierman(self.columns.as_mut(), self.diagonal.as_mut(), f, gain)
    }

    /// Forgets as `form` says, then [`Factor::add_information`], then θ ← θ + P·fᵀe for the n numbers
    /// of `theta` that belong to each e of `errors`: all of it in one pass over U.
    ///
    /// `squares` is ‖f‖²; `scratch` holds [`kernel::scratch`] numbers. Nothing is forgotten where P would
    /// leave the range of the number type.
    #[inline]
    pub(crate) fn measure(
        &mut self,
        form: Form<M::Real>,
        (f, squares): (&[M::Real], M::Real),
        scratch: &mut [M::Real],
        (theta, errors): (&mut [M::Real], &[M::Real]),
    ) -> Measured<M::Real> {
        self.expose(f, &mut scratch[..f.len()]);
        let mut measure = |place: Place<'_, M::Real>, form| {
            M::Real::measure(Measure { place, form, f, squares, theta: &mut *theta, errors })
        };
        if let Some(measured) = measure(self.place(scratch), form) {
            return measured;
        }
        let before = self.trace_bound;
        self.tighten();
        if let Some(measured) = measure(self.place(scratch), form) {
            return measured;
        }
        self.trace_bound = before;
        let place = Place { bound: &mut { M::Real::ZERO }, ..self.place(scratch) };
        match measure(place, Form::NOTHING) {
            Some(measured) => measured,
            None => unreachable!("there is room for what does not grow"),
        }
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
        (outcomes, thetas): (&mut [Outcome<M::Real>], &mut [M::Real]),
    ) -> usize {
        let place = self.place(scratch);
        M::Real::advance(&mut Steps { place, form, phi, y, theta, outcomes, thetas })
    }

    #[inline]
    fn place<'a>(&'a mut self, scratch: &'a mut [M::Real]) -> Place<'a, M::Real> {
        let (columns, diagonal) = (self.columns.as_mut(), self.diagonal.as_mut());
        Place { columns, diagonal, scratch, bound: &mut self.trace_bound }
    }

    /// f·P·fᵀ for n numbers `f`.
    #[inline]
    pub fn leverage(&self, f: &[M::Real]) -> M::Real {
        let leverage = self.exposed_leverage(f);
        if self.is_deferring() {
            leverage + self.deferred.leverage(f)
        } else {
            leverage
        }
    }

    /// The same where nothing of P along `f` is deferred.
    #[inline]
    pub(crate) fn exposed_leverage(&self, f: &[M::Real]) -> M::Real {
        functions::leverage(self.columns.as_ref(), self.diagonal.as_ref(), f)
    }

    /// D^(−1/2)·U⁻¹·fᵀ in place of `f`: its squared length is f·P⁻¹·fᵀ.
    ///
    /// Gives the vector without the square roots of D; divide products of elements by D.
    #[inline]
    pub fn solve(&self, f: &mut [M::Real]) {
        functions::solve(self.columns.as_ref(), f);
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
        functions::multiply_transposed(self.columns.as_ref(), x);
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
        functions::multiply(self.columns.as_ref(), x);
    }

    /// `x` ← P·`f`
    pub fn multiply(&self, f: &[M::Real], x: &mut [M::Real]) {
        x.copy_from_slice(f);
        functions::multiply_transposed(self.columns.as_ref(), x);
        for (x, &d) in x.iter_mut().zip(self.diagonal.as_ref()) {
            *x *= d;
        }
        functions::multiply(self.columns.as_ref(), x);
        self.deferred.add_product(f, x);
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
                let element = functions::dot(a, b);
                dense[i * n + j] = element;
                dense[j * n + i] = element;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Factor;
    use crate::memory::Dynamic;
    use forgetting_kernels::kernel::layout::place;
    use forgetting_kernels::Real;

    /// P with these columns above the diagonal and this D.
    fn factor<const N: usize>(columns: &[&[f64]], diagonal: [f64; N]) -> Factor<Dynamic<f64>> {
        let mut factor = Factor::scalar(Dynamic::new(N, 1, 1).unwrap(), 1.0).unwrap();
        factor.diagonal.as_mut().copy_from_slice(&diagonal);
        for (j, column) in columns.iter().enumerate() {
            for (i, &u) in column.iter().enumerate() {
                factor.columns.as_mut()[place::<f64>(i, j)] = u;
            }
        }
        factor
    }

    #[test]
    fn a_measurement_adds_nothing_where_d_is_at_its_floor() {
        let diagonal = [1.4058341593762096e-138, 0.008440921232922291, 4.440109184476592e-149];
        let columns: [&[f64]; 3] = [&[], &[0.0], &[4.3556142965880123e40, 1.7335898988465585e73]];
        let mut p = factor(&columns, diagonal);
        p.add_information(&[1.5369708694062383e67, 7.561495892025367e19, 0.0], &mut [0.0; 3]);
        // in exact arithmetic; the last D is then 1e-178, and its column 9e87 long
        assert!((p.trace() / 0.008440921232922258 - 1.0).abs() < 1e-12, "{p:?}");
        assert!(p.is_sound());
    }

    #[test]
    fn d_at_its_floor_may_stay_where_nothing_is_measured() {
        let floor = f64::FLOOR;
        for size in [3.0, 7.0, 1e10, 3e60] {
            let mut p = factor(&[&[], &[2.0], &[-2.0, 3.0]], [1.0, floor, floor]);
            p.add_information(&[size, 0.0, 0.0], &mut [0.0; 3]);
            assert!(p.is_sound() && p.trace() < 1.0, "{p:?}");
        }
    }

    #[test]
    fn products_within_a_measurement_are_finite() {
        let mut p = factor(&[&[], &[0.0]], [f64::CEILING / 4.0; 2]);
        for row in [[1e-75, 1e75], [1e75, 0.0], [0.0, 1e75]] {
            p.add_information(&row, &mut [0.0; 2]);
            assert!(p.is_sound(), "{p:?}");
        }
    }
}
