//! The diagonal of P, and its sum.

use super::copies::put_first;
use super::layout::{place, COMPACT, FEW};
use crate::kernel::dispatch::Kernel;
use crate::number::vector::Vector;
use crate::number::Real;

/// Writes P_ii = Σ_k U_ik D_k U_ik to `variances`, column by column, rounded as single elements
/// of P are.
pub struct Variances<'a, T> {
    /// U, in tiles
    pub columns: &'a [T],
    /// D
    pub diagonal: &'a [T],
    /// become P_ii
    pub variances: &'a mut [T],
}

impl<T: Real> Kernel<T> for Variances<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, diagonal, variances } = self;
        for (t, variances) in variances.chunks_mut(T::ROWS).enumerate() {
            let (first, mut sum) = (t * T::ROWS, V::splat(T::ZERO));
            // there are zeros below the diagonal
            for (k, &d) in diagonal.iter().enumerate().skip(first) {
                let u = V::load(&T::chunks(&columns[place::<T>(first, k)..]).0[0]);
                sum = sum + u * V::splat(d) * u;
            }
            put_first(variances, sum);
        }
    }
}

/// tr P = Σ_k D_k Σ_i U_ik².
pub struct Trace<'a, T> {
    /// U, in tiles
    pub columns: &'a [T],
    /// D
    pub diagonal: &'a [T],
}

impl<T: Real> Kernel<T> for Trace<'_, T> {
    type Output = T;

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> T {
        match self.diagonal.len() {
            _ if COMPACT => self.of_few(),
            0..=FEW => self.of_few(),
            _ => self.of_many::<V>(),
        }
    }
}

impl<T: Real> Trace<'_, T> {
    /// In the order of [`Small::trace`](crate::kernel::registers::Small::trace); also of many, where programs are
    /// to be small.
    #[inline(always)]
    fn of_few(self) -> T {
        let mut trace = T::ZERO;
        for (k, &d) in self.diagonal.iter().enumerate() {
            let mut squares = T::ZERO;
            for i in 0..k {
                let u = self.columns[place::<T>(i, k)];
                squares = u.mul_add(u, squares);
            }
            trace += d * (T::ONE + squares);
        }
        trace
    }

    /// In four sums of vectors, none of which waits for the others.
    #[inline(always)]
    fn of_many<V: Vector<T>>(self) -> T {
        let Self { columns, diagonal } = self;
        let mut sums = [V::splat(T::ZERO); 4];
        for first in (0..diagonal.len()).step_by(T::ROWS) {
            // there are zeros below the diagonal
            let (fours, rest) = diagonal[first..].as_chunks::<4>();
            for (b, d) in fours.iter().enumerate() {
                for l in 0..4 {
                    sums[l] = squared::<T, V>(columns, (first, first + 4 * b + l), d[l], sums[l]);
                }
            }
            for (l, &d) in rest.iter().enumerate() {
                sums[0] =
                    squared::<T, V>(columns, (first, first + 4 * fours.len() + l), d, sums[0]);
            }
        }
        let mut chunk = T::chunk(&[]);
        ((sums[0] + sums[1]) + (sums[2] + sums[3])).store(&mut chunk);
        let mut trace = T::ZERO;
        for l in 0..T::ROWS {
            trace += chunk.as_ref()[l];
        }
        trace
    }
}

/// `sum` + d·u² for the rows from `i` on of column k.
#[inline(always)]
fn squared<T: Real, V: Vector<T>>(columns: &[T], (i, k): (usize, usize), d: T, sum: V) -> V {
    let u = V::load(&T::chunks(&columns[place::<T>(i, k)..]).0[0]);
    (u * V::splat(d)).mul_add(u, sum)
}
