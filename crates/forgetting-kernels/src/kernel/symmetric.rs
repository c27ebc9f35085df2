//! A symmetric matrix beside P, with all its numbers: row by row, each row in whole chunks of
//! [`Real::ROWS`] numbers, of which those past the last column are 0.

use super::tiles::{Long, LongMut};
use crate::kernel::dispatch::Kernel;
use crate::number::vector::Vector;
use crate::number::Real;

/// How many numbers a row takes.
#[inline(always)]
pub const fn stride<T: Real>(n: usize) -> usize {
    n.next_multiple_of(T::ROWS)
}

/// The numbers of the matrix and one more, of any number type.
#[inline(always)]
pub const fn most(n: usize) -> usize {
    n * n.next_multiple_of(16) + 1
}

/// `product` ← A·`x`. O(n²).
pub struct SymmetricMultiply<'a, T> {
    /// A
    pub matrix: &'a [T],
    /// n numbers
    pub x: &'a [T],
    /// n numbers
    pub product: &'a mut [T],
}

impl<T: Real> Kernel<T> for SymmetricMultiply<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { matrix, x, product } = self;
        let (rows, across) = (T::chunks(matrix).0, x.len().div_ceil(T::ROWS));
        let mut product = LongMut::new(product);
        let mut first = 0;
        while GROUP >= 8 && across - first >= 8 {
            columns::<T, V, 8>((rows, across), first, x, &mut product);
            first += 8;
        }
        while across - first >= 4 {
            columns::<T, V, 4>((rows, across), first, x, &mut product);
            first += 4;
        }
        while across - first >= 2 {
            columns::<T, V, 2>((rows, across), first, x, &mut product);
            first += 2;
        }
        if first < across {
            columns::<T, V, 1>((rows, across), first, x, &mut product);
        }
        product.finish();
    }
}

/// `C` chunks of A·x from chunk `first` on: the rows one after the other, each times its number of x.
#[inline(always)]
fn columns<T: Real, V: Vector<T>, const C: usize>(
    (rows, across): (&[T::Chunk], usize),
    first: usize,
    x: &[T],
    product: &mut LongMut<'_, T>,
) {
    let mut sums = [V::splat(T::ZERO); C];
    for (k, &x) in x.iter().enumerate() {
        let Some(row) = rows.get(k * across + first..) else { return };
        let Some(row) = row.first_chunk::<C>() else { return };
        let x = V::splat(x);
        for c in 0..C {
            sums[c] = x.mul_add(V::load(&row[c]), sums[c]);
        }
    }
    for c in 0..C {
        sums[c].store(product.chunk_mut(first + c));
    }
}

/// A ← c A − x·xᵀ, which leaves it as symmetric as it was, bit for bit. O(n²).
pub struct SymmetricSubtract<'a, T> {
    /// A
    pub matrix: &'a mut [T],
    /// c
    pub scale: T,
    /// n numbers
    pub x: &'a [T],
}

impl<T: Real> Kernel<T> for SymmetricSubtract<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let (rows, across) = (T::chunks_mut(self.matrix).0, self.x.len().div_ceil(T::ROWS));
        let (x, scale) = (Long::new(self.x), V::splat(self.scale));
        let (full, tail) = x.first(across);
        for (k, &own) in self.x.iter().enumerate() {
            let Some(row) = rows.get_mut(k * across..(k + 1) * across) else { return };
            let own = V::splat(-own);
            for c in 0..full.len().min(row.len()) {
                own.mul_add(V::load(&full[c]), scale * V::load(&row[c])).store(&mut row[c]);
            }
            if let (Some(x), Some(last)) = (tail, row.last_mut()) {
                own.mul_add(V::load(x), scale * V::load(last)).store(last);
            }
        }
    }
}
