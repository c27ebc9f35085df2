//! Covariance that is added to P, and to U D Uᵀ only when it matters: P = U D Uᵀ + A.
//!
//! To add diag(q) to U D Uᵀ takes a dyad for each parameter, O(n³). A sample needs less: what it brings
//! depends on A fᵀ alone, for its row f, and
//!
//! ```text
//! a = A fᵀ,  U D Uᵀ ← U D Uᵀ + a aᵀ/(f a),  A ← A − a aᵀ/(f a)
//! ```
//!
//! moves that with one dyad, O(n²). P is the same before and after, A fᵀ = 0, so that the measurement is
//! one of U D Uᵀ, and what is left of A is positive semidefinite: it is A shorted to the space orthogonal
//! to A f. This is exact, not an approximation of adding diag(q).
//!
//! A is not to grow so large that its rounding counts beside q. Where an element of its diagonal is more than
//! 4 n times what a sample adds to it, the part of A along that parameter is moved in the same way, f being
//! a unit vector: one parameter a sample, so that A ≤ 5 n diag(q), whatever the input. Where
//! samples differ so much that this does not keep up, all of A is moved at once.
//!
//! W. N. Anderson, G. E. Trapp, *Shorted operators II*, SIAM Journal on Applied Mathematics 28, 1975: that
//! what is left is positive semidefinite, and the larger the larger A was.

use super::Factor;
use crate::memory::state::Visitor;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{
    add_scaled, dot, symmetric_multiply, symmetric_subtract,
};
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::kernel::symmetric::stride;
use forgetting_kernels::Real;

/// An element of A's diagonal this many times n what a sample adds is moved to U D Uᵀ.
const LARGE: f64 = 4.0;
/// From this many times n on all of A is.
const TOO_LARGE: f64 = 8.0;

/// The numbers of A are multiplied out where their common factor is beyond this or its reciprocal.
const FAR: f64 = 1e6;

/// A, as its numbers over a common factor and that factor at the end, so that all of it is scaled in O(1);
/// nothing where all of P is in U D Uᵀ.
#[derive(Clone, Debug)]
pub(super) struct Deferred<M: Memory>(M::Optional);

impl<M: Memory> Deferred<M> {
    /// Nothing.
    pub fn none(memory: M) -> Self {
        Self(memory.optional(0))
    }

    /// A = 0, or nothing in a memory that has no room for it.
    fn zeros(memory: M) -> Self {
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
    fn factor(&self) -> M::Real {
        self.0.as_ref().last().copied().unwrap_or(M::Real::ONE)
    }

    fn put_factor(&mut self, factor: M::Real) {
        if let Some(place) = self.0.as_mut().last_mut() {
            *place = factor;
        }
    }

    /// The numbers, row by row.
    #[inline]
    fn numbers(&self) -> &[M::Real] {
        self.0.as_ref().split_last().map_or(&[], |(_, numbers)| numbers)
    }

    #[inline]
    fn numbers_mut(&mut self) -> &mut [M::Real] {
        self.0.as_mut().split_last_mut().map_or(&mut [], |(_, numbers)| numbers)
    }

    /// The `n` numbers of row i, over the factor.
    fn row(&self, i: usize, n: usize) -> &[M::Real] {
        &self.numbers()[i * stride::<M::Real>(n)..][..n]
    }

    /// The diagonal, of `n` elements; none where there is no A.
    #[inline]
    fn variances(&self, n: usize) -> impl Iterator<Item = M::Real> + '_ {
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

    /// Whether all elements are in range, and none on the diagonal negative.
    pub fn is_sound(&self, n: usize) -> bool {
        let (factor, far) = (self.factor(), M::Real::from_f64(FAR));
        let in_range = |x: M::Real| x.abs() <= M::Real::CEILING;
        factor * far >= M::Real::ONE
            && factor <= far
            && self.variances(n).all(|x| x >= M::Real::ZERO)
            && self.numbers().iter().all(|&x| in_range(x) && in_range(factor * x))
    }

    /// A_ij ← 0 and A_ji ← 0 for all j.
    fn clear(&mut self, i: usize, n: usize) {
        let (matrix, stride) = (self.numbers_mut(), stride::<M::Real>(n));
        matrix[i * stride..(i + 1) * stride].fill(M::Real::ZERO);
        matrix.iter_mut().skip(i).step_by(stride).for_each(|x| *x = M::Real::ZERO);
    }

    /// f·A·fᵀ, of which this is a sum: nothing where that is no more than rounding.
    fn along(&self, sum: M::Real, f: &[M::Real]) -> M::Real {
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

impl<M: Memory> Factor<M> {
    /// From here on [`Factor::defer_diagonal`] may be used, where there are many parameters and the memory has
    /// room for A.
    pub(crate) fn start_deferring(&mut self) {
        if self.parameters() > FEW {
            self.deferred = Deferred::zeros(self.memory);
        }
    }

    /// Whether it may be used.
    #[inline(always)]
    pub(crate) fn is_deferring(&self) -> bool {
        !self.deferred.is_none()
    }

    /// P ← P + diag(q), q ≥ 0, in A; uses n numbers `work`. O(n²).
    ///
    /// Call [`Factor::reserve`] first.
    pub(crate) fn defer_diagonal(&mut self, q: impl Fn(usize) -> M::Real, work: &mut [M::Real]) {
        let (n, stride) = (self.parameters(), stride::<M::Real>(self.parameters()));
        let [large, too_large] =
            [LARGE, TOO_LARGE].map(|times| M::Real::from_f64(times * n as f64));
        let (factor, mut due, mut all) = (self.deferred.factor(), None, false);
        for (i, row) in self.deferred.numbers_mut().chunks_exact_mut(stride).enumerate() {
            let added = q(i);
            row[i] += added / factor;
            let sum = factor * row[i];
            if sum > large * added {
                due = due.or(Some(i));
                all |= sum > too_large * added;
            }
        }
        match due {
            Some(_) if all => self.settle(work),
            Some(i) => self.settle_one(i, work),
            None => {}
        }
    }

    /// Moves the part of A along n numbers `f` to U D Uᵀ; uses n numbers `a`. O(n²).
    #[inline]
    pub(crate) fn expose(&mut self, f: &[M::Real], a: &mut [M::Real]) {
        if !self.deferred.is_none() {
            self.expose_along(f, a);
        }
    }

    fn expose_along(&mut self, f: &[M::Real], a: &mut [M::Real]) {
        symmetric_multiply(self.deferred.numbers(), f, a);
        let factor = self.deferred.factor();
        a.iter_mut().for_each(|a| *a *= factor);
        let along = self.deferred.along(dot(f, a), f);
        if along > M::Real::ZERO {
            self.move_dyad(a, along);
        }
    }

    /// The same along parameter i, of which A_ii > 0; uses n numbers `a`.
    fn settle_one(&mut self, i: usize, a: &mut [M::Real]) {
        let (n, factor) = (self.parameters(), self.deferred.factor());
        for (a, &x) in a.iter_mut().zip(self.deferred.row(i, n)) {
            *a = factor * x;
        }
        self.move_dyad(a, a[i]);
        self.deferred.clear(i, n);
    }

    /// U D Uᵀ ← U D Uᵀ + a aᵀ/`along`, A ← A − a aᵀ/`along`, for `along` > 0.
    ///
    /// A is positive semidefinite, so that a_j² ≤ `along` A_jj: what is far more than that is rounding, and so is
    /// what is left of an element of the diagonal that becomes as small as its rounding was.
    fn move_dyad(&mut self, a: &mut [M::Real], along: M::Real) {
        let (n, deviation, two) = (a.len(), along.sqrt(), M::Real::from_f64(2.0));
        for (a, variance) in a.iter_mut().zip(self.deferred.variances(n)) {
            *a = if *a * *a <= two * along * variance { *a / deviation } else { M::Real::ZERO };
        }
        let factor = self.deferred.factor();
        symmetric_subtract(self.deferred.numbers_mut(), factor, a);
        self.deferred.put_factor(M::Real::ONE);
        let rounding = M::Real::EPSILON * M::Real::from_f64(n as f64);
        for (j, &a) in a.iter().enumerate() {
            if self.deferred.row(j, n)[j] < rounding * a * a {
                self.deferred.clear(j, n);
            }
        }
        self.add_covariance(a, M::Real::ONE);
    }

    /// Moves all of A to U D Uᵀ; uses n numbers `work`. O(n³).
    pub(crate) fn settle(&mut self, work: &mut [M::Real]) {
        if self.deferred.is_none() {
            return;
        }
        let n = self.parameters();
        for i in 0..n {
            if self.deferred.row(i, n)[i] > M::Real::ZERO {
                self.settle_one(i, work);
            }
        }
        self.deferred.numbers_mut().fill(M::Real::ZERO);
        self.deferred.put_factor(M::Real::ONE);
    }

    /// Subtracts what is deferred from n x n numbers.
    pub(crate) fn subtract_deferred(&self, dense: &mut [M::Real]) {
        self.deferred.add_to(dense, self.parameters(), -M::Real::ONE);
    }

    /// The same P with all of it in U D Uᵀ. O(n³) where something was deferred.
    #[must_use]
    pub fn settled(&self) -> Self {
        let mut factor = self.clone();
        factor.settle(self.memory.vector().as_mut());
        factor.deferred = Deferred::none(self.memory);
        factor
    }
}

#[cfg(test)]
mod tests;
