//! Rows in units of their own for each column, and what these units are made from.

use crate::kernel::dispatch::Kernel;
use crate::kernel::layout::UNROLLED;
use crate::number::lane::Lane;
use crate::number::vector::Vector;
use crate::number::Real;

/// Each of `rows` becomes the product, number by number, with `factors`.
pub struct ScaleRows<'a, T> {
    /// n numbers a row
    pub rows: &'a mut [T],
    /// n numbers
    pub factors: &'a [T],
}

impl<T: Real> Kernel<T> for ScaleRows<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.factors.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let n = self.factors.len();
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP < 8 && n <= UNROLLED {
            with_few!(n, scale_few::<T>(self.rows, self.factors));
        } else {
            scale_many::<T, V>(self.rows, self.factors);
        }
    }
}

#[inline(always)]
fn scale_few<T: Real, const N: usize>(rows: &mut [T], factors: &[T]) {
    let Some(factors) = factors.first_chunk::<N>() else { return };
    for row in rows.as_chunks_mut::<N>().0 {
        for i in 0..N {
            row[i] *= factors[i];
        }
    }
}

#[inline(always)]
fn scale_many<T: Real, V: Vector<T>>(rows: &mut [T], factors: &[T]) {
    let (chunks, rest) = T::chunks(factors);
    for row in rows.chunks_exact_mut(factors.len()) {
        let (row, row_rest) = T::chunks_mut(row);
        for i in 0..row.len().min(chunks.len()) {
            (V::load(&row[i]) * V::load(&chunks[i])).store(&mut row[i]);
        }
        for i in 0..row_rest.len().min(rest.len()) {
            row_rest[i] *= rest[i];
        }
    }
}

/// Adds the roots of the sizes of `rows` up for each column, and counts the numbers other than 0.
pub struct SumRoots<'a, T> {
    /// n numbers a row
    pub rows: &'a [T],
    /// n sums
    pub roots: &'a mut [T],
    /// n counts
    pub counts: &'a mut [T],
}

impl<T: Real> Kernel<T> for SumRoots<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.roots.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let n = self.roots.len();
        if GROUP < 8 && n <= UNROLLED {
            with_few!(n, sum_few::<T>(self.rows, self.roots, self.counts));
        } else {
            sum_many::<T, V>(self.rows, self.roots, self.counts);
        }
    }
}

/// 1, or 0 where x is 0.
#[inline(always)]
pub fn one_unless_zero<T: Real, A: Lane<T>>(x: A) -> A {
    let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
    A::select(zero.less_than(x.abs()), one, zero)
}

#[inline(always)]
fn sum_few<T: Real, const N: usize>(rows: &[T], roots: &mut [T], counts: &mut [T]) {
    let (Some(to_roots), Some(to_counts)) =
        (roots.first_chunk_mut::<N>(), counts.first_chunk_mut::<N>())
    else {
        return;
    };
    let (mut roots, mut counts) = (*to_roots, *to_counts);
    for row in rows.as_chunks::<N>().0 {
        for i in 0..N {
            roots[i] += row[i].abs().sqrt();
            counts[i] += one_unless_zero(row[i]);
        }
    }
    (*to_roots, *to_counts) = (roots, counts);
}

#[inline(always)]
fn sum_many<T: Real, V: Vector<T>>(rows: &[T], roots: &mut [T], counts: &mut [T]) {
    let n = roots.len();
    let (roots, roots_rest) = T::chunks_mut(roots);
    let (counts, counts_rest) = T::chunks_mut(counts);
    for row in rows.chunks_exact(n) {
        let (row, row_rest) = T::chunks(row);
        for i in 0..row.len().min(roots.len()).min(counts.len()) {
            let x = V::load(&row[i]);
            (V::load(&roots[i]) + x.abs().sqrt()).store(&mut roots[i]);
            (V::load(&counts[i]) + one_unless_zero(x)).store(&mut counts[i]);
        }
        for i in 0..row_rest.len().min(roots_rest.len()).min(counts_rest.len()) {
            let x = row_rest[i];
            roots_rest[i] += x.abs().sqrt();
            counts_rest[i] += one_unless_zero(x);
        }
    }
}
