//! Bierman's update with unit variance: P⁻¹ ← P⁻¹ + fᵀf, for more than eight parameters.
//!
//! ```text
//! for each column j of U:   w = f_j + u·f,  v = D_j w,  a' = a + w v
//!                           D_j ← D_j a / a',  u ← u − (w / a) k,  k ← k + v u (the u of before)
//! then                      P₊fᵀ = k / a'
//! ```
//!
//! The columns are taken in blocks, so that the divisions of a block do not wait for each other
//! and the gain k passes once through the registers for several columns. O(1.5 n²).
//!
//! G. J. Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V.

use super::block::{dots, rotate, with_width, PerColumn};
use super::layout::BLOCK;
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
    #[inline(always)]
    pub fn pass(&mut self, d: &mut [T], w: &PerColumn<T>) -> (PerColumn<T>, PerColumn<T>) {
        with_width!(d.len(), pass::<T>(self, d, w))
    }

    /// Only the sum s passes from one column to the next; all else is done for all side by side.
    #[inline(always)]
    fn extend<const C: usize>(&mut self, d: &mut [T; C], w: &[T; C]) -> ([T; C], [T; C]) {
        let (mut v, mut a, mut product) = ([T::ZERO; C], [T::ZERO; C], [T::ZERO; C]);
        for c in 0..C {
            v[c] = d[c] * w[c];
            product[c] = w[c] * v[c];
        }
        let mut s = self.s;
        for c in 0..C {
            s += product[c];
            a[c] = T::ONE + s;
        }
        let (mut a_before, mut inverse_before) = (T::ONE + self.s, self.inverse_a);
        let mut slope = [T::ZERO; C];
        for c in 0..C {
            let inverse_a = T::ONE / a[c];
            slope[c] = -(w[c] * inverse_before);
            d[c] = (d[c] * (a_before * inverse_a)).max(T::FLOOR);
            (a_before, inverse_before) = (a[c], inverse_a);
        }
        *self = Self { s, inverse_a: inverse_before };
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

#[inline(always)]
fn pass<T: Real, const C: usize>(
    chain: &mut Chain<T>,
    d: &mut [T],
    w: &PerColumn<T>,
) -> (PerColumn<T>, PerColumn<T>) {
    let (mut slope, mut v) = ([T::ZERO; BLOCK], [T::ZERO; BLOCK]);
    if let (Some(d), Some(w)) = (d.first_chunk_mut::<C>(), w.first_chunk::<C>()) {
        let found = chain.extend(d, w);
        slope[..C].copy_from_slice(&found.0);
        v[..C].copy_from_slice(&found.1);
    }
    (slope, v)
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

/// D ← `growth`·D of a block.
#[inline(always)]
pub fn grow<T: Real>(d: &mut [T], growth: T) {
    match d.first_chunk_mut::<BLOCK>() {
        Some(d) => d.iter_mut().for_each(|d| *d *= growth),
        None => d.iter_mut().for_each(|d| *d *= growth),
    }
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
    let n = diagonal.len();
    let mut chain = Chain::START;
    let mut ahead = dots::<T, V, GROUP>(columns, 0, BLOCK.min(n), f);
    for j in (0..n).step_by(BLOCK) {
        let (w, width, next) = (ahead, BLOCK.min(n - j), j + BLOCK);
        if next < n {
            // needs nothing of this block: the machine does both at once
            ahead = dots::<T, V, GROUP>(columns, next, BLOCK.min(n - next), f);
        }
        let d = &mut diagonal[j..j + width];
        grow(d, growth);
        let (slope, v) = chain.pass(d, &w);
        rotate::<T, V, GROUP>(columns, j, width, k, (&slope, &v));
    }
    chain
}
