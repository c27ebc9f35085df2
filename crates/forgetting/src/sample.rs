//! One sample on its way through the estimator: whitened, possibly rotated, possibly thinned.

use crate::{Error, Memory, Real};
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Kernels;

/// The whitened sample φ̄ = Γ^(−1/2)φ and ē = Γ^(−1/2)(y − φθ).
///
/// A rule may rotate its rows, scale them or drop some; it does not see θ.
#[derive(Debug)]
pub struct Sample<'a, M: Memory> {
    memory: M,
    rows: usize,
    regressors: &'a mut [M::Real],
    errors: &'a mut [M::Real],
    scaled: M::Real,
}

impl<'a, M: Memory> Sample<'a, M> {
    /// The sample of `memory.rows()` rows in these two buffers.
    #[inline]
    pub fn new(memory: M, regressors: &'a mut [M::Real], errors: &'a mut [M::Real]) -> Self {
        Self { memory, rows: memory.rows(), regressors, errors, scaled: M::Real::ONE }
    }

    /// What the sample was multiplied with by [`Sample::scale`], in all.
    #[inline]
    pub(crate) fn scaled(&self) -> M::Real {
        self.scaled
    }

    /// Takes back into use the rows that were dropped, if all were.
    #[inline]
    pub(crate) fn restore(&mut self) {
        if self.rows == 0 {
            self.rows = self.memory.rows();
        }
    }

    /// The sizes it was made for.
    pub fn memory(&self) -> M {
        self.memory
    }

    /// Rows still in use.
    #[inline]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Row i of φ̄, n numbers.
    #[inline]
    pub fn row(&self, i: usize) -> &[M::Real] {
        let n = self.memory.parameters();
        &self.regressors[i * n..(i + 1) * n]
    }

    /// Row i of ē, one number a target.
    #[inline]
    pub fn error(&self, i: usize) -> &[M::Real] {
        let m = self.memory.targets();
        &self.errors[i * m..(i + 1) * m]
    }

    /// All rows of φ̄ still in use, row by row.
    #[inline]
    pub fn regressors(&self) -> &[M::Real] {
        &self.regressors[..self.rows * self.memory.parameters()]
    }

    /// All rows of ē still in use, row by row.
    #[inline]
    pub fn errors(&self) -> &[M::Real] {
        &self.errors[..self.rows * self.memory.targets()]
    }

    /// ‖φ̄‖² (Frobenius).
    #[inline]
    pub fn squared_regressors(&self) -> M::Real {
        dot(self.regressors(), self.regressors())
    }

    /// The length of the longest row of φ̄: its largest singular value, once the rows are
    /// orthogonal.
    #[inline]
    pub fn longest_row(&self) -> M::Real {
        let squared = (0..self.rows)
            .fold(M::Real::ZERO, |longest, i| longest.max(dot(self.row(i), self.row(i))));
        squared.sqrt()
    }

    /// ‖ē‖² over rows and targets.
    #[inline]
    pub fn squared_error(&self) -> M::Real {
        match self.errors() {
            [error] => *error * *error,
            errors => dot(errors, errors),
        }
    }

    /// Multiplies the sample by c: Γ ← Γ/c².
    #[inline]
    pub fn scale(&mut self, c: M::Real) {
        for x in self.regressors.iter_mut().chain(self.errors.iter_mut()) {
            *x *= c;
        }
        self.scaled *= c;
    }

    /// Whitens the sample by the p x p matrix `gamma` = L Lᵀ: φ̄ = L⁻¹φ, ē = L⁻¹e.
    ///
    /// `gamma` becomes L. The sample is untouched if that fails.
    ///
    /// # Errors
    /// [`Error::Indefinite`] unless `gamma` is positive definite.
    pub fn whiten(&mut self, gamma: &mut [M::Real]) -> Result<(), Error> {
        let p = self.rows;
        cholesky(gamma, p, "gamma")?;
        for i in 0..p {
            for k in 0..i {
                self.subtract_row(i, gamma[i * p + k], k);
            }
            self.scale_row(i, M::Real::ONE / gamma[i * p + i]);
        }
        Ok(())
    }

    /// Row i −= c·row k, k < i, in φ̄ and ē.
    fn subtract_row(&mut self, i: usize, c: M::Real, k: usize) {
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        for (block, width) in [(&mut *self.regressors, n), (&mut *self.errors, m)] {
            let (above, from) = block.split_at_mut(i * width);
            add_scaled(&mut from[..width], -c, &above[k * width..(k + 1) * width]);
        }
    }

    fn scale_row(&mut self, i: usize, c: M::Real) {
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        for (block, width) in [(&mut *self.regressors, n), (&mut *self.errors, m)] {
            block[i * width..(i + 1) * width].iter_mut().for_each(|x| *x *= c);
        }
    }

    /// Rotates the rows until they are orthogonal (one-sided Jacobi): with the compact singular
    /// value decomposition φ̄ = W S Vᵀ, φ̄ becomes S Vᵀ and ē becomes Wᵀē.
    pub fn orthogonalize(&mut self) {
        const SWEEPS: usize = 30;
        for _ in 0..SWEEPS {
            let mut rotated = false;
            for i in 0..self.rows {
                for k in i + 1..self.rows {
                    rotated |= self.rotate(i, k);
                }
            }
            if !rotated {
                break;
            }
        }
    }

    /// Makes rows i < k orthogonal; says whether they were not.
    fn rotate(&mut self, i: usize, k: usize) -> bool {
        let (a, b) = (dot(self.row(i), self.row(i)), dot(self.row(k), self.row(k)));
        let c = dot(self.row(i), self.row(k));
        if c.abs() <= M::Real::EPSILON * (a * b).sqrt() {
            return false;
        }
        let zeta = (b - a) / (c + c);
        let sign = if zeta < M::Real::ZERO { -M::Real::ONE } else { M::Real::ONE };
        let t = sign / (zeta.abs() + (M::Real::ONE + zeta * zeta).sqrt());
        let cosine = M::Real::ONE / (M::Real::ONE + t * t).sqrt();
        let sine = cosine * t;
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        for (block, width) in [(&mut *self.regressors, n), (&mut *self.errors, m)] {
            let (above, from) = block.split_at_mut(k * width);
            for (x, y) in above[i * width..].iter_mut().zip(&mut from[..width]) {
                let (before_x, before_y) = (*x, *y);
                *x = cosine * before_x - sine * before_y;
                *y = sine * before_x + cosine * before_y;
            }
        }
        true
    }

    /// Sets the rows of φ̄ that are not longer than `least` to zero.
    pub fn clear_shorter_than(&mut self, least: M::Real) {
        for row in self.regressors.chunks_exact_mut(self.memory.parameters()) {
            if !(dot(row, row).sqrt() > least) {
                row.fill(M::Real::ZERO);
            }
        }
    }

    /// Keeps the rows that are at least `threshold` long, in their order; drops the others.
    pub fn keep_longer_than(&mut self, threshold: M::Real) {
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        let mut kept = 0;
        for i in 0..self.rows {
            if dot(self.row(i), self.row(i)).sqrt() >= threshold {
                self.regressors.copy_within(i * n..(i + 1) * n, kept * n);
                self.errors.copy_within(i * m..(i + 1) * m, kept * m);
                kept += 1;
            }
        }
        self.rows = kept;
    }
}

/// A = L Lᵀ of the p x p matrix `a`, L in its lower triangle.
///
/// # Errors
/// [`Error::Indefinite`] names `parameter`.
pub(crate) fn cholesky<T: Kernels>(
    a: &mut [T],
    p: usize,
    parameter: &'static str,
) -> Result<(), Error> {
    for j in 0..p {
        let (done, _) = a[j * p..].split_at(j);
        let pivot = a[j * p + j] - dot(done, done);
        if !(pivot > T::ZERO && pivot.is_finite()) {
            let pivot = pivot.to_f64();
            return Err(Error::Indefinite { parameter, pivot, allowed: "positive definite" });
        }
        let diagonal = pivot.sqrt();
        a[j * p + j] = diagonal;
        for i in j + 1..p {
            let sum = dot(&a[i * p..i * p + j], &a[j * p..j * p + j]);
            a[i * p + j] = (a[i * p + j] - sum) / diagonal;
        }
    }
    Ok(())
}
