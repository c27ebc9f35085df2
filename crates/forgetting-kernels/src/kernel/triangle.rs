//! Products and solutions with U and Uᵀ, and f·P·fᵀ. O(n²/2) each.

use super::layout::{place, BLOCK, COMPACT, FEW};
use super::registers::Small;
use super::tiles::{
    add_columns, block, dots, load_per_column, store_per_column, triangle, Long, LongMut,
    PerColumn, Tile,
};
use crate::kernel::dispatch::Kernel;
use crate::number::block_vector::BlockVector;
use crate::number::lane::Lane;
use crate::number::vector::Vector;
use crate::number::{copy_some, Real};

/// f·P·fᵀ = Σ_j D_j (Uᵀfᵀ)_j²
pub struct Leverage<'a, T> {
    /// U, in tiles
    pub columns: &'a [T],
    /// D
    pub diagonal: &'a [T],
    /// the regressor, n numbers
    pub f: &'a [T],
}

impl<T: Real> Kernel<T> for Leverage<'_, T> {
    type Output = T;

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> T {
        let Self { columns, diagonal, f } = self;
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP < 8 && f.len() <= FEW {
            if COMPACT {
                return some_leverage(columns, diagonal, f);
            }
            with_few!(f.len(), few_leverage::<T>(columns, diagonal, f))
        } else {
            leverage_of::<T, V, GROUP>(columns, diagonal, f)
        }
    }
}

/// f·P·fᵀ for many parameters, inside another kernel.
#[inline(always)]
pub fn leverage_of<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    diagonal: &[T],
    f: &[T],
) -> T {
    let (long, mut sum) = (Long::new(f), V::BlockVector::splat(T::ZERO));
    for b in 0..f.len().div_ceil(BLOCK) {
        let w = dots::<T, V, GROUP>(block(columns, b), &long);
        let d = load_per_column::<T, V::BlockVector>(diagonal, b, T::ZERO);
        sum = (d * w).mul_add(w, sum);
    }
    sum.running_sums().last().numbers()[0]
}

#[inline(always)]
fn few_leverage<T: Real, const N: usize>(columns: &[T], diagonal: &[T], f: &[T]) -> T {
    match (diagonal.first_chunk::<N>(), f.first_chunk::<N>()) {
        (Some(d), Some(f)) => Small::<T, N>::load(columns, d).leverage(f),
        _ => T::ZERO,
    }
}

/// The same for any number of them, where programs are to be small.
fn some_leverage<T: Real>(columns: &[T], diagonal: &[T], f: &[T]) -> T {
    let (n, mut padded, mut d) = (f.len(), [T::ZERO; FEW], [T::ZERO; FEW]);
    copy_some(&mut padded, f);
    copy_some(&mut d, diagonal);
    let mut small = Small { u: [[T::ZERO; FEW]; FEW], d };
    for c in 0..n {
        for i in 0..c {
            small.u[c][i] = columns[place::<T>(i, c)];
        }
    }
    small.leverage(&padded)
}

/// `x` ← Uᵀ·`x`
pub struct MultiplyTransposed<'a, T> {
    /// U, in tiles
    pub columns: &'a [T],
    /// the vector
    pub x: &'a mut [T],
}

impl<T: Real> Kernel<T> for MultiplyTransposed<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, x } = self;
        if GROUP < 8 && x.len() <= BLOCK {
            if COMPACT {
                return some_products(columns, x);
            }
            return with_width!(x.len(), few_products::<T>(columns, x));
        }
        for b in (0..x.len().div_ceil(BLOCK)).rev() {
            let w = dots::<T, V, GROUP>(block(columns, b), &Long::new(x));
            store_per_column(x, b, w);
        }
    }
}

/// For any number of them, where programs are to be small.
fn some_products<T: Real>(columns: &[T], x: &mut [T]) {
    for c in (0..x.len()).rev() {
        for i in 0..c {
            x[c] = columns[place::<T>(i, c)].mul_add(x[i], x[c]);
        }
    }
}

#[inline(always)]
fn few_products<T: Real, const N: usize>(columns: &[T], x: &mut [T]) {
    if let Some(x) = x.first_chunk_mut::<N>() {
        let u = Small::<T, N>::load(columns, x).u;
        for c in (0..N).rev() {
            for i in 0..c {
                x[c] = u[c][i].mul_add(x[i], x[c]);
            }
        }
    }
}

/// `x` ← U⁻¹·`x`
pub struct Solve<'a, T> {
    /// U, in tiles
    pub columns: &'a [T],
    /// the vector
    pub x: &'a mut [T],
}

impl<T: Real> Kernel<T> for Solve<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, x } = self;
        if GROUP < 8 && x.len() <= BLOCK {
            if COMPACT {
                return some_solutions(columns, x);
            }
            return with_width!(x.len(), few_solutions::<T>(columns, x));
        }
        let blocks = x.len().div_ceil(BLOCK);
        let mut x = LongMut::new(x);
        for b in (0..blocks).rev() {
            let block = block(columns, b);
            let solved = solve_triangle(block, b, x.per_column(b));
            let mut factors = solved;
            for c in 0..BLOCK {
                factors[c] = -factors[c];
            }
            add_columns::<T, V>(block, &mut x, &factors);
            *x.per_column(b) = solved;
        }
        x.finish();
    }
}

/// For any number of them, where programs are to be small.
fn some_solutions<T: Real>(columns: &[T], x: &mut [T]) {
    for c in (0..x.len()).rev() {
        let less = -x[c];
        for i in 0..c {
            x[i] = less.mul_add(columns[place::<T>(i, c)], x[i]);
        }
    }
}

#[inline(always)]
fn few_solutions<T: Real, const N: usize>(columns: &[T], x: &mut [T]) {
    if let Some(x) = x.first_chunk_mut::<N>() {
        *x = solve(&Small::<T, N>::load(columns, x).u, *x);
    }
}

/// The solution in the triangle of a block.
#[inline(always)]
pub fn solve_triangle<T: Real>(block: &[Tile<T>], b: usize, x: &PerColumn<T>) -> PerColumn<T> {
    solve(&triangle(block, b), *x)
}

#[inline(always)]
fn solve<T: Real, const C: usize>(u: &[[T; C]; C], mut x: [T; C]) -> [T; C] {
    for c in (0..C).rev() {
        let less = -x[c];
        for i in 0..c {
            x[i] = less.mul_add(u[c][i], x[i]);
        }
    }
    x
}

/// `x` ← U·`x`
pub struct Multiply<'a, T> {
    /// U, in tiles
    pub columns: &'a [T],
    /// the vector
    pub x: &'a mut [T],
}

impl<T: Real> Kernel<T> for Multiply<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        let Self { columns, x } = self;
        if GROUP < 8 && x.len() <= BLOCK {
            if COMPACT {
                return some_sums(columns, x);
            }
            return with_width!(x.len(), few_sums::<T>(columns, x));
        }
        let blocks = x.len().div_ceil(BLOCK);
        let mut x = LongMut::new(x);
        for b in 0..blocks {
            // the diagonal puts them back
            let factors = core::mem::replace(x.per_column(b), [T::ZERO; BLOCK]);
            add_columns::<T, V>(block(columns, b), &mut x, &factors);
        }
        x.finish();
    }
}

/// For any number of them, where programs are to be small.
fn some_sums<T: Real>(columns: &[T], x: &mut [T]) {
    for c in 0..x.len() {
        for i in 0..c {
            x[i] = x[c].mul_add(columns[place::<T>(i, c)], x[i]);
        }
    }
}

#[inline(always)]
fn few_sums<T: Real, const N: usize>(columns: &[T], x: &mut [T]) {
    if let Some(x) = x.first_chunk_mut::<N>() {
        let u = Small::<T, N>::load(columns, x).u;
        for c in 0..N {
            for i in 0..c {
                x[i] = x[c].mul_add(u[c][i], x[i]);
            }
        }
    }
}
