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

mod matrix;

pub(super) use matrix::Deferred;

use super::Factor;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{dot, symmetric_multiply, symmetric_subtract};
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::kernel::symmetric::stride;
use forgetting_kernels::Real;

/// An element of A's diagonal this many times n what a sample adds is moved to U D Uᵀ.
const LARGE: f64 = 4.0;
/// From this many times n on all of A is.
const TOO_LARGE: f64 = 8.0;

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
