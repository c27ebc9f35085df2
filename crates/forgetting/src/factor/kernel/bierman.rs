//! Bierman's measurement update with unit variance: P⁻¹ ← P⁻¹ + fᵀf. O(1.5 n²).
//!
//! ```text
//! for each column j of U:   w = f_j + u·f,  v = D_j w,  a' = a + w v
//!                           D_j ← D_j a / a',  u ← u − (w / a) k,  k ← k + v u (the u of before)
//! ```
//!
//! The columns are taken in blocks, so that the eight divisions of a block are independent and
//! the gain k passes once through the registers for eight columns. The order of every sum is the
//! same for all sizes and blocks.
//!
//! G. J. Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V.

use super::block::{dots, rectangle, rectangle_mut, rotate, start, BLOCK};
use crate::vector::Vector;
use crate::{Kernel, Real};

/// The update as a kernel: returns (s, a), s = f·P·fᵀ and a = 1 + s, and leaves P·fᵀ with the P
/// of before in `gain`.
pub struct Bierman<'a, T> {
    pub columns: &'a mut [T],
    pub diagonal: &'a mut [T],
    pub f: &'a [T],
    pub gain: &'a mut [T],
}

/// What passes from column to column.
#[derive(Clone, Copy)]
struct Chain<T> {
    s: T,
    a: T,
    inverse_a: T,
}

impl<T: Real> Kernel<T> for Bierman<'_, T> {
    type Output = (T, T);

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> (T, T) {
        let Self { columns, diagonal, f, gain } = self;
        let n = diagonal.len();
        let (f, gain) = (&f[..n], &mut gain[..n]);
        let mut chain = Chain { s: T::ZERO, a: T::ONE, inverse_a: T::ONE };
        let mut j = 0;
        while j < n {
            let width = BLOCK.min(n - j);
            let mut sums = [T::ZERO; BLOCK];
            if j > 0 {
                sweep_dots::<T, V, GROUP>(columns, j, width, f, &mut sums);
            }
            let (slope, v) = corner(columns, diagonal, f, gain, j, width, &sums, &mut chain);
            if j > 0 {
                sweep_rotate::<T, V, GROUP>(columns, j, width, gain, &slope, &v);
            }
            j += width;
        }
        (chain.s, chain.a)
    }
}

#[inline(always)]
fn sweep_dots<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    j: usize,
    width: usize,
    f: &[T],
    sums: &mut [T; BLOCK],
) {
    let f = &f[..j];
    let mut c = 0;
    if GROUP >= 8 && width == 8 {
        *sums = dots::<T, V, 8>(rectangle(columns, j, j), f);
        return;
    }
    while GROUP >= 4 && width - c >= 4 {
        sums[c..c + 4].copy_from_slice(&dots::<T, V, 4>(rectangle(columns, j + c, j), f));
        c += 4;
    }
    while width - c >= 2 {
        sums[c..c + 2].copy_from_slice(&dots::<T, V, 2>(rectangle(columns, j + c, j), f));
        c += 2;
    }
    if c < width {
        sums[c..c + 1].copy_from_slice(&dots::<T, V, 1>(rectangle(columns, j + c, j), f));
    }
}

#[inline(always)]
fn sweep_rotate<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    j: usize,
    width: usize,
    gain: &mut [T],
    slope: &[T; BLOCK],
    v: &[T; BLOCK],
) {
    let k = &mut gain[..j];
    let mut c = 0;
    if GROUP >= 8 && width == 8 {
        rotate::<T, V, 8>(rectangle_mut(columns, j, j), k, *slope, *v);
        return;
    }
    let part = |x: &[T; BLOCK], c: usize| x[c..].first_chunk().copied();
    while GROUP >= 4 && width - c >= 4 {
        let (slope, v) =
            (part(slope, c).unwrap_or([T::ZERO; 4]), part(v, c).unwrap_or([T::ZERO; 4]));
        rotate::<T, V, 4>(rectangle_mut(columns, j + c, j), k, slope, v);
        c += 4;
    }
    while width - c >= 2 {
        rotate::<T, V, 2>(
            rectangle_mut(columns, j + c, j),
            k,
            [slope[c], slope[c + 1]],
            [v[c], v[c + 1]],
        );
        c += 2;
    }
    if c < width {
        rotate::<T, V, 1>(rectangle_mut(columns, j + c, j), k, [slope[c]], [v[c]]);
    }
}

#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn corner<T: Real>(
    columns: &mut [T],
    diagonal: &mut [T],
    f: &[T],
    gain: &mut [T],
    j: usize,
    width: usize,
    sums: &[T; BLOCK],
    chain: &mut Chain<T>,
) -> ([T; BLOCK], [T; BLOCK]) {
    macro_rules! by_width {
        ($($c:literal)*) => {
            match width {
                $($c => triangle::<T, $c>(columns, diagonal, f, gain, j, sums, chain),)*
                _ => triangle::<T, 8>(columns, diagonal, f, gain, j, sums, chain),
            }
        };
    }
    by_width!(1 2 3 4 5 6 7)
}

/// The triangle of a block: returns the slopes and v of its columns.
#[inline(always)]
fn triangle<T: Real, const C: usize>(
    columns: &mut [T],
    diagonal: &mut [T],
    f: &[T],
    gain: &mut [T],
    j: usize,
    sums: &[T; BLOCK],
    chain: &mut Chain<T>,
) -> ([T; BLOCK], [T; BLOCK]) {
    let f: &[T; C] = f[j..].first_chunk().unwrap();
    let d: &mut [T; C] = diagonal[j..].first_chunk_mut().unwrap();
    let gain: &mut [T; C] = gain[j..].first_chunk_mut().unwrap();
    let mut u = [[T::ZERO; C]; C];
    for c in 0..C {
        let from = start(j + c) + j;
        let column = &columns[from..from + c];
        for i in 0..c {
            u[c][i] = column[i];
        }
    }
    let mut w = *f;
    for c in 0..C {
        for i in 0..c {
            w[c] = u[c][i].mul_add(f[i], w[c]);
        }
        w[c] += sums[c];
    }
    let (mut slope, mut v) = ([T::ZERO; BLOCK], [T::ZERO; BLOCK]);
    for c in 0..C {
        v[c] = d[c] * w[c];
    }
    let Chain { mut s, mut a, mut inverse_a } = *chain;
    for c in 0..C {
        slope[c] = -(w[c] * inverse_a);
        s = w[c].mul_add(v[c], s);
        let next = w[c].mul_add(v[c], a);
        inverse_a = T::ONE / next;
        d[c] = (d[c] * (a * inverse_a)).max(T::FLOOR);
        a = next;
    }
    *chain = Chain { s, a, inverse_a };
    let mut k = [T::ZERO; C];
    for c in 0..C {
        for i in 0..c {
            let before = u[c][i];
            u[c][i] = slope[c].mul_add(k[i], before);
            k[i] = v[c].mul_add(before, k[i]);
        }
        k[c] = v[c];
    }
    *gain = k;
    for c in 0..C {
        let from = start(j + c) + j;
        let column = &mut columns[from..from + c];
        for i in 0..c {
            column[i] = u[c][i];
        }
    }
    (slope, v)
}
