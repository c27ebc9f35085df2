//! The covariance P as U D Uᵀ: U unit upper triangular, D diagonal and positive.
//!
//! Nothing here subtracts from P. Each operation scales it, adds covariance, adds information,
//! transforms it by congruence or replaces it, and keeps every element of D at or above
//! [`Real::FLOOR`]: P stays positive definite whatever is asked of it. A part of what a rule adds may be kept
//! beside U D Uᵀ until a sample needs it ([`deferred`]).

mod blocks;
mod bounded;
mod deferred;
pub(crate) mod dense;
mod grow;
mod measure;
mod prior;
pub mod spectrum;
mod units;

#[cfg(feature = "alloc")]
pub use bounded::bounded;
pub use bounded::{bounded_in, bounded_room};
pub use prior::{Prior, DIFFUSE};
pub(crate) use units::{scale_each, Above};

use crate::error::Error;
use crate::memory::state::Visitor;
use crate::memory::Memory;
use core::cmp::Ordering;
use deferred::Deferred;
use forgetting_kernels::kernel::functions;
use forgetting_kernels::kernel::layout;
use forgetting_kernels::kernel::variances::{Trace, Variances};
use forgetting_kernels::Kernels;
use forgetting_kernels::Real;
use units::{put_diagonal, Tiles};

/// P = U D Uᵀ, n x n and positive definite.
#[derive(Clone, Debug)]
pub struct Factor<M: Memory> {
    memory: M,
    /// the columns of U, in tiles; see [`layout::place`]
    columns: M::Packed,
    diagonal: M::Vector,
    /// at least the trace of P; kept in O(1), tightened when it matters
    trace_bound: M::Real,
    /// what of P is not in U D Uᵀ yet, if anything may be
    deferred: Deferred<M>,
}

impl<M: Memory> Factor<M> {
    /// P = `variance`·I.
    ///
    /// # Errors
    /// [`Error::Value`] unless `variance` is positive and in range.
    pub fn scalar(memory: M, variance: M::Real) -> Result<Self, Error> {
        let mut diagonal = memory.vector();
        diagonal.as_mut().fill(variance);
        Self::diagonal(memory, diagonal.as_ref())
    }

    /// P = diag(`variances`), n numbers.
    ///
    /// # Errors
    /// [`Error::Length`], or [`Error::Value`] unless every variance is positive and in range.
    pub fn diagonal(memory: M, variances: &[M::Real]) -> Result<Self, Error> {
        const NAME: &str = "initial_covariance";
        Error::check_length(NAME, variances.len(), memory.parameters())?;
        for (index, &variance) in variances.iter().enumerate() {
            if !(variance >= M::Real::FLOOR && variance <= M::Real::CEILING) {
                return Err(Error::Value {
                    parameter: NAME,
                    index: Some(index),
                    value: variance.to_f64(),
                    allowed: allowed_variances::<M::Real>(),
                });
            }
        }
        Ok(Self::of(memory, |i| variances[i]))
    }

    /// P diagonal with these elements, each within [floor, ceiling].
    pub(crate) fn of(memory: M, variance: impl Fn(usize) -> M::Real) -> Self {
        let mut diagonal = memory.vector();
        for (i, d) in diagonal.as_mut().iter_mut().enumerate() {
            *d = variance(i);
        }
        let columns = memory.packed();
        let deferred = Deferred::none(memory);
        let mut factor = Self { memory, columns, diagonal, trace_bound: M::Real::ZERO, deferred };
        factor.tighten();
        factor
    }

    /// Whether U is triangular, and D and P are within range: whether this is a positive definite P.
    /// O(n²).
    pub fn is_sound(&self) -> bool {
        let in_range = |d: &M::Real| *d >= M::Real::FLOOR && *d <= M::Real::CEILING;
        let n = M::Real::from_f64(self.parameters() as f64);
        self.diagonal.as_ref().iter().all(in_range)
            && self.trace() <= n * M::Real::CEILING
            && layout::is_unit_triangular(self.columns.as_ref(), self.parameters())
            && self.trace_bound.is_finite()
            && self.deferred.is_sound(self.parameters())
    }

    /// Recomputes the bound of P's trace where the one that was read cannot be a bound.
    pub(crate) fn check_bound(&mut self) {
        // half of it, for rounding
        if !(self.trace_bound >= M::Real::from_f64(0.5) * self.trace()) {
            self.tighten();
        }
    }

    /// n
    #[inline(always)]
    pub fn parameters(&self) -> usize {
        self.memory.parameters()
    }

    /// The sizes this factor was made for.
    #[inline(always)]
    pub fn memory(&self) -> M {
        self.memory
    }

    /// D, n positive numbers.
    #[inline(always)]
    pub fn diagonal_elements(&self) -> &[M::Real] {
        self.diagonal.as_ref()
    }

    /// The columns of U as the kernels take them.
    #[inline(always)]
    pub fn packed_columns(&self) -> &[M::Real] {
        &self.columns.as_ref()[..layout::length::<M::Real>(self.parameters())]
    }

    /// The largest element of D: at most the largest eigenvalue of P, and of its order when
    /// one direction dominates. The same of what is deferred.
    #[inline(always)]
    pub fn largest(&self) -> M::Real {
        let deferred = self.deferred.largest(self.parameters());
        self.diagonal.as_ref().iter().fold(deferred, |largest, &d| largest.max(d))
    }

    /// Whether an element of D is larger than `limit`, or of the diagonal of what is deferred.
    #[inline(always)]
    pub(crate) fn exceeds(&self, limit: M::Real) -> bool {
        // without a branch in the loop
        let any = self.diagonal.as_ref().iter().fold(false, |any, &d| any | (d > limit));
        any || self.deferred.largest(self.parameters()) > limit
    }

    /// The smallest element of D: at least the smallest eigenvalue of P. Where something is deferred that of
    /// all of P, O(n³).
    #[inline(always)]
    pub fn smallest(&self) -> M::Real {
        if self.is_deferring() {
            return self.settled().smallest();
        }
        self.diagonal.as_ref().iter().fold(M::Real::CEILING, |smallest, &d| smallest.min(d))
    }

    /// Copies column j of U above the diagonal to `copy`, j numbers or more.
    pub fn get_column(&self, j: usize, copy: &mut [M::Real]) {
        layout::get_column(self.columns.as_ref(), j, copy);
    }

    /// The element of U at row i and column j.
    #[inline]
    pub fn unit(&self, i: usize, j: usize) -> M::Real {
        match i.cmp(&j) {
            Ordering::Less => self.columns.as_ref()[layout::place::<M::Real>(i, j)],
            Ordering::Equal => M::Real::ONE,
            Ordering::Greater => M::Real::ZERO,
        }
    }

    /// The trace of P, O(n²).
    pub fn trace(&self) -> M::Real {
        trace(self.columns.as_ref(), self.diagonal.as_ref())
            + self.deferred.trace(self.parameters())
    }

    /// P as n x n numbers, written to `dense` (of n² elements, else left alone). O(n³/3).
    ///
    /// U is written there first: P_ij = Σ_k≥j U_ik D_k U_jk of its rows i ≤ j, of which the part
    /// before place j is of no use any more.
    pub fn reconstruct(&self, dense: &mut [M::Real]) {
        let n = self.parameters();
        if dense.len() != n * n {
            return;
        }
        for (i, row) in dense.chunks_exact_mut(n).enumerate() {
            for (j, u) in row.iter_mut().enumerate().skip(i) {
                *u = self.unit(i, j);
            }
        }
        for i in 0..n {
            let (above, below) = dense.split_at_mut((i + 1) * n);
            let row = &mut above[i * n..];
            for (u, &d) in row[i..].iter_mut().zip(&self.diagonal.as_ref()[i..]) {
                *u *= d;
            }
            // with U_ii = 1: Σ_k U_ik (D U_ik)
            let own = (i + 1..n).fold(row[i], |sum, k| sum + row[k] * self.unit(i, k));
            for (j, other) in (i + 1..n).zip(below.chunks_exact_mut(n)) {
                let element = functions::dot(&row[j..], &other[j..]);
                row[j] = element;
                other[i] = element;
            }
            row[i] = own;
        }
        self.deferred.add_to(dense, n, M::Real::ONE);
    }

    /// P_ii, O(n).
    pub fn variance(&self, i: usize) -> M::Real {
        let own = self.diagonal.as_ref()[i] + self.deferred.variance(i, self.parameters());
        (i + 1..self.parameters()).fold(own, |sum, k| {
            let u = self.unit(i, k);
            sum + u * u * self.diagonal.as_ref()[k]
        })
    }

    /// The diagonal of P, written to `variances` (n elements), O(n²).
    pub fn variances(&self, variances: &mut [M::Real]) {
        let (columns, diagonal) = (self.columns.as_ref(), self.diagonal.as_ref());
        M::Real::variances(Variances { columns, diagonal, variances: &mut *variances });
        self.deferred.add_variances(variances);
    }

    /// D_j ← `d`, or the floor where that is below it, and column j of U with it.
    pub(crate) fn put_diagonal(&mut self, j: usize, d: M::Real) {
        let (mut u, place) = (Tiles(self.columns.as_mut()), &mut self.diagonal.as_mut()[j]);
        put_diagonal(&mut u, place, j, d);
    }

    /// By how much the trace may grow after room was reserved for P/λ.
    pub(crate) fn room(&self, lambda: M::Real) -> M::Real {
        (M::Real::ONE - lambda) * self.trace_bound
    }

    /// Replaces the trace's bound by the trace itself.
    pub(crate) fn tighten(&mut self) {
        self.trace_bound = self.trace();
    }

    /// Visits every number of the state, to save or restore it.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visit_columns(self.columns.as_mut(), self.memory.parameters(), visitor);
        visitor.reals(self.diagonal.as_mut());
        self.deferred.visit(self.memory.parameters(), visitor);
        visitor.reals(core::slice::from_mut(&mut self.trace_bound));
    }
}

/// The trace of U D Uᵀ for the packed `columns` of U and the elements of D.
pub(crate) fn trace<T: Kernels>(columns: &[T], diagonal: &[T]) -> T {
    T::trace(Trace { columns, diagonal })
}

/// Shows the numbers of U above the diagonal, column by column.
fn visit_columns<T: Kernels>(columns: &mut [T], n: usize, visitor: &mut dyn Visitor<T>) {
    for j in 0..n {
        for i in (0..j).step_by(T::ROWS) {
            let start = layout::place::<T>(i, j);
            visitor.reals(&mut columns[start..start + T::ROWS.min(j - i)]);
        }
    }
}

/// The elements that D may have, in words.
pub(crate) fn allowed_variances<T: Real>() -> &'static str {
    match T::CEILING.to_f64() > 1e100 {
        true => "positive, 3.1e-151 to 3.2e150",
        false => "positive, 2.2e-19 to 4.6e18",
    }
}
