//! The symmetric matrix A beside U D Uᵀ, as numbers.

use crate::memory::state::Visitor;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::kernel::symmetric::stride;
use forgetting_kernels::Real;

/// The numbers of A are multiplied out where their common factor is beyond this or its reciprocal.
const FAR: f64 = 1e6;
/// No element is further beyond the largest of the diagonal than rounding can take it: without rounding,
/// none is beyond it.
const BEYOND: f64 = 1e3;

/// A, as its numbers over a common factor and that factor at the end, so that all of it is scaled in O(1);
/// nothing where all of P is in U D Uᵀ.
#[derive(Clone, Debug)]
pub struct Deferred<M: Memory>(M::Optional);

impl<M: Memory> Deferred<M> {
    /// Nothing.
    pub fn none(memory: M) -> Self {
        Self(memory.optional(0))
    }

    /// A = 0, or nothing in a memory that has no room for it.
    pub fn zeros(memory: M) -> Self {
        let n = memory.parameters();
        let mut deferred = Self(memory.optional(n * stride::<M::Real>(n) + 1));
        deferred.put_factor(M::Real::ONE);
        deferred
    }

    #[inline(always)]
    pub fn is_none(&self) -> bool {
        self.0.as_ref().is_empty()
    }

    /// What the numbers are to be multiplied with.
    #[inline]
    pub fn factor(&self) -> M::Real {
        self.0.as_ref().last().copied().unwrap_or(M::Real::ONE)
    }

    pub fn put_factor(&mut self, factor: M::Real) {
        if let Some(place) = self.0.as_mut().last_mut() {
            *place = factor;
        }
    }

    /// The numbers, row by row.
    #[inline]
    pub fn numbers(&self) -> &[M::Real] {
        self.0.as_ref().split_last().map_or(&[], |(_, numbers)| numbers)
    }

    #[inline]
    pub fn numbers_mut(&mut self) -> &mut [M::Real] {
        self.0.as_mut().split_last_mut().map_or(&mut [], |(_, numbers)| numbers)
    }

    /// The `n` numbers of row i, over the factor.
    pub fn row(&self, i: usize, n: usize) -> &[M::Real] {
        &self.numbers()[i * stride::<M::Real>(n)..][..n]
    }

    /// The diagonal, of `n` elements; none where there is no A.
    #[inline]
    pub fn variances(&self, n: usize) -> impl Iterator<Item = M::Real> + '_ {
        let factor = self.factor();
        self.numbers().iter().step_by(stride::<M::Real>(n) + 1).map(move |&x| factor * x)
    }

    /// A_ii, 0 where there is no A.
    pub fn variance(&self, i: usize, n: usize) -> M::Real {
        self.variances(n).nth(i).unwrap_or(M::Real::ZERO)
    }

    /// The largest element of the diagonal, 0 where there is no A.
    pub fn largest(&self, n: usize) -> M::Real {
        self.variances(n).fold(M::Real::ZERO, M::Real::max)
    }

    /// Σ_i A_ii
    pub fn trace(&self, n: usize) -> M::Real {
        self.variances(n).fold(M::Real::ZERO, |sum, x| sum + x)
    }

    /// A ← c A
    #[inline]
    pub fn scale(&mut self, c: M::Real) {
        if self.is_none() {
            return;
        }
        let (factor, far) = (c * self.factor(), M::Real::from_f64(FAR));
        if factor * far >= M::Real::ONE && factor <= far {
            return self.put_factor(factor);
        }
        self.numbers_mut().iter_mut().for_each(|x| *x *= factor);
        self.put_factor(M::Real::ONE);
    }

    /// A ← S A S with S = diag(`scale`).
    pub fn scale_each(&mut self, scale: &[M::Real]) {
        let stride = stride::<M::Real>(scale.len());
        for (row, &s) in self.numbers_mut().chunks_exact_mut(stride).zip(scale) {
            row.iter_mut().zip(scale).for_each(|(x, &t)| *x *= s * t);
        }
    }

    /// `x` ← `x` + A·`f`
    pub fn add_product(&self, f: &[M::Real], x: &mut [M::Real]) {
        if !self.is_none() {
            let (n, factor) = (f.len(), self.factor());
            for (i, &f) in f.iter().enumerate() {
                add_scaled(x, factor * f, self.row(i, n));
            }
        }
    }

    /// f·A·fᵀ
    pub fn leverage(&self, f: &[M::Real]) -> M::Real {
        if self.is_none() {
            return M::Real::ZERO;
        }
        let n = f.len();
        let rows = (0..n).map(|i| f[i] * dot(self.row(i, n), f));
        self.along(self.factor() * rows.fold(M::Real::ZERO, |sum, x| sum + x), f)
    }

    /// Adds c A to `n` x `n` numbers.
    pub fn add_to(&self, dense: &mut [M::Real], n: usize, c: M::Real) {
        if !self.is_none() {
            for (i, numbers) in dense.chunks_exact_mut(n).enumerate() {
                add_scaled(numbers, c * self.factor(), self.row(i, n));
            }
        }
    }

    /// Adds the elements of the diagonal to n numbers.
    pub fn add_variances(&self, variances: &mut [M::Real]) {
        let n = variances.len();
        variances.iter_mut().zip(self.variances(n)).for_each(|(sum, x)| *sum += x);
    }

    /// A ← that of `other`.
    pub fn copy_from(&mut self, other: &Self) {
        if self.0.as_ref().len() == other.0.as_ref().len() {
            self.0.as_mut().copy_from_slice(other.0.as_ref());
        } else {
            self.0 = other.0.clone();
        }
    }

    /// Shows the upper triangle to `visitor`.
    pub fn visit(&mut self, n: usize, visitor: &mut dyn Visitor<M::Real>) {
        if self.is_none() {
            return;
        }
        let (matrix, stride) = (self.numbers_mut(), stride::<M::Real>(n));
        for i in 0..n {
            visitor.reals(&mut matrix[i * stride + i..i * stride + n]);
            for j in i + 1..n {
                matrix[j * stride + i] = matrix[i * stride + j];
            }
        }
        visitor.reals(self.0.as_mut().last_mut().map_or(&mut [], core::slice::from_mut));
    }

    /// Whether the diagonal is in range and not negative, and the other elements can go with it.
    pub fn is_sound(&self, n: usize) -> bool {
        let (factor, far) = (self.factor(), M::Real::from_f64(FAR));
        let variances = M::Real::ZERO..=M::Real::CEILING;
        let most = M::Real::from_f64(BEYOND) * self.largest(n);
        factor * far >= M::Real::ONE
            && factor <= far
            && self.variances(n).all(|x| variances.contains(&x))
            && self.numbers().iter().all(|&x| (factor * x).abs() <= most)
    }

    /// A_ij ← 0 and A_ji ← 0 for all j.
    pub fn clear(&mut self, i: usize, n: usize) {
        let (matrix, stride) = (self.numbers_mut(), stride::<M::Real>(n));
        matrix[i * stride..(i + 1) * stride].fill(M::Real::ZERO);
        matrix.iter_mut().skip(i).step_by(stride).for_each(|x| *x = M::Real::ZERO);
    }

    /// f·A·fᵀ, of which this is a sum: nothing where that is no more than rounding.
    pub fn along(&self, sum: M::Real, f: &[M::Real]) -> M::Real {
        let parts = f.iter().zip(self.variances(f.len()));
        let spread = parts.fold(M::Real::ZERO, |sum, (&f, x)| sum + f * f * x);
        let rounding = M::Real::EPSILON * M::Real::from_f64(f.len() as f64) * spread;
        if sum > rounding {
            sum
        } else {
            M::Real::ZERO
        }
    }
}
