//! Bierman's update with unit variance: P⁻¹ ← P⁻¹ + fᵀf, for more than eight parameters.
//!
//! ```text
//! for each column j of U:   w = f_j + u·f,  v = D_j w,  a' = a + w v
//!                           D_j ← D_j a / a',  u ← u − (w / a) k,  k ← k + v u (the u of before)
//! then                      P₊fᵀ = k / a'
//! ```
//!
//! The columns are taken in blocks of eight, so that the divisions of a block do not wait for each other
//! and the gain k passes once through the registers for several columns. O(1.5 n²).
//!
//! G. J. Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V.

#![allow(clippy::needless_range_loop, reason = "constant bounds unroll")]

use super::layout::BLOCK;
use super::tile::{block, block_mut, dots, eight, put_eight, rotate, Long, LongMut, PerColumn};
use crate::factor::Measured;
use crate::vector::Vector;
use crate::Real;

/// What passes from column to column: s = a − 1, and 1/a.
#[derive(Clone, Copy)]
pub struct Chain<T> {
    s: T,
    pub inverse_a: T,
}

impl<T: Real> Chain<T> {
    pub const START: Self = Self { s: T::ZERO, inverse_a: T::ONE };

    /// Goes through the columns of a block; returns the slope and v of each.
    ///
    /// Only the sum s passes from block to block; all else is done for all columns side by side.
    #[inline(always)]
    pub fn pass(&mut self, d: &mut PerColumn<T>, w: &PerColumn<T>) -> (PerColumn<T>, PerColumn<T>) {
        let [mut v, mut a, mut product] = [[T::ZERO; BLOCK]; 3];
        for c in 0..BLOCK {
            v[c] = d[c] * w[c];
            product[c] = w[c] * v[c];
        }
        let sums = running_sums(&product);
        for c in 0..BLOCK {
            a[c] = T::ONE + (self.s + sums[c]);
        }
        let (mut a_before, mut inverse_before) = (T::ONE + self.s, self.inverse_a);
        let mut slope = [T::ZERO; BLOCK];
        for c in 0..BLOCK {
            let inverse_a = T::ONE / a[c];
            slope[c] = -(w[c] * inverse_before);
            d[c] = (d[c] * (a_before * inverse_a)).max(T::FLOOR);
            (a_before, inverse_before) = (a[c], inverse_a);
        }
        *self = Self { s: self.s + sums[BLOCK - 1], inverse_a: inverse_before };
        (slope, v)
    }

    /// At the end.
    #[inline(always)]
    pub fn measured(self, d: &[T], forgot: bool) -> Measured<T> {
        self.with_largest(largest(d), forgot)
    }

    /// The same with the largest element of D known.
    #[inline(always)]
    pub fn with_largest(self, largest: T, forgot: bool) -> Measured<T> {
        let Self { s, inverse_a } = self;
        Measured { leverage: s, variance: T::ONE + s, inverse_variance: inverse_a, largest, forgot }
    }
}

/// The sums of the first one, two, … of eight numbers, none of more than three additions.
#[inline(always)]
fn running_sums<T: Real>(x: &PerColumn<T>) -> PerColumn<T> {
    let (ab, cd, ef, gh) = (x[0] + x[1], x[2] + x[3], x[4] + x[5], x[6] + x[7]);
    let abcd = ab + cd;
    [x[0], ab, ab + x[2], abcd, abcd + x[4], abcd + ef, abcd + (ef + x[6]), abcd + (ef + gh)]
}

/// The largest of positive numbers, eight side by side.
#[inline(always)]
pub fn largest<T: Real>(numbers: &[T]) -> T {
    let (eights, rest) = numbers.as_chunks::<BLOCK>();
    let mut most = [T::ZERO; BLOCK];
    for eight in eights {
        for lane in 0..BLOCK {
            most[lane] = most[lane].max(eight[lane]);
        }
    }
    most.iter().chain(rest).fold(T::ZERO, |most, &x| most.max(x))
}

/// The D of block `b`, grown.
#[inline(always)]
pub fn grown<T: Real>(diagonal: &[T], b: usize, growth: T) -> PerColumn<T> {
    eight(diagonal, b, T::FLOOR).map(|d| d * growth)
}

/// P ← `growth`·P and P⁻¹ ← P⁻¹ + fᵀf; leaves P·fᵀ, with the P between the two, in `k`.
#[inline(always)]
pub fn scale_and_measure<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    diagonal: &mut [T],
    growth: T,
    f: &[T],
    k: &mut [T],
) -> Chain<T> {
    let (f, mut k, blocks) = (Long::new(f), LongMut::zeros(k), diagonal.len().div_ceil(BLOCK));
    let mut chain = Chain::START;
    let mut ahead = dots::<T, V, GROUP>(block(columns, 0), &f);
    for b in 0..blocks {
        let w = ahead;
        if b + 1 < blocks {
            // needs nothing of this block: the machine does both at once
            ahead = dots::<T, V, GROUP>(block(columns, b + 1), &f);
        }
        let mut d = grown(diagonal, b, growth);
        let (slope, v) = chain.pass(&mut d, &w);
        put_eight(diagonal, b, &d);
        rotate::<T, V, GROUP>(block_mut(columns, b), &mut k, (&slope, &v));
    }
    k.finish();
    chain
}
