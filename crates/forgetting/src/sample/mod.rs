//! One sample on its way through the estimator: checked, whitened, possibly rotated or thinned by
//! the rule, judged by gate, weighting and rate, measured, and reported.

mod answer;
mod buffers;
mod check;
mod cholesky;
mod elapsed;
mod evidence;
mod innovation;
mod measure;
mod noise;
mod noise_variance;
mod orthogonalize;
mod skip;
mod update;

use crate::memory::Memory;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::Real;

pub use answer::Answer;
pub(crate) use buffers::SampleBuffers;
pub use buffers::Work;
pub(crate) use check::{blame, check_theta, not_finite, out_of_range};
pub(crate) use cholesky::cholesky;
pub(crate) use elapsed::{check_elapsed, factor_after};
pub use evidence::{Evidence, Needs};
pub(crate) use innovation::whiten_errors;
pub(crate) use measure::{leverage, measure_rows};
pub use noise::Noise;
pub(crate) use noise::{check_gamma, whiten};
pub(crate) use noise_variance::NoiseVariance;
pub use skip::Skip;
pub use update::Update;
pub(crate) use update::Whitened;

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

    /// The product of all factors of [`Sample::scale`].
    #[inline]
    pub(crate) fn scaled(&self) -> M::Real {
        self.scaled
    }

    /// Brings all rows back if all were dropped.
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
