//! Forgetting along a regressor and measuring it, in two sweeps over U: for more than eight
//! parameters.
//!
//! P ← P + c·fᵀf is Agee and Turner's update (see [`super::agee_turner`]). Its x starts with f and
//! loses z_j u_j at column j, from the last to the first; as f = U z, the x of column j is also
//! the sum of z_i u_i over the columns before it, and can be built from the first to the last,
//! as Bierman's gain is. So both updates are one sweep, after one that finds z = U⁻¹f and w = Uᵀf:
//!
//! ```text
//! from the last block:   z, w, q = z / D;  fᵀP⁻¹f = Σ z q;  t_j = 1/c + Σ_{i>j} z_i q_i
//! from the first:        D'_j = D_j + z_j² / t_j,  widening_j = q_j / (t_j + z_j q_j)
//!                        w'_j = w_j + widening_j p,  p ← p + z_j w_j                  (w' = U'ᵀf)
//!                        u' = u + widening x,  x ← x + z u,  then Bierman with u' and w'
//! ```
//!
//! O(3 n²), twice Bierman's update alone.

#![allow(clippy::needless_range_loop, reason = "constant bounds unroll")]

use super::bierman::Chain;
use super::layout::BLOCK;
use super::tile::{
    block, block_mut, eight, put_eight, solve_and_dot, widen_and_rotate, Long, LongMut, Slopes,
};
use super::triangular::solve_triangle;
use crate::vector::Vector;
use crate::Real;

/// Buffers of n numbers each.
pub struct Scratch<'a, T> {
    /// P·fᵀ, at the end
    pub k: &'a mut [T],
    pub x: &'a mut [T],
    pub z: &'a mut [T],
    pub w: &'a mut [T],
    /// z / D
    q: &'a mut [T],
    /// the sum of z q over the columns after each
    later: &'a mut [T],
}

impl<'a, T> Scratch<'a, T> {
    /// How many numbers each parameter takes.
    pub const EACH: usize = 6;

    /// From [`Scratch::EACH`]·n numbers.
    #[inline(always)]
    pub fn of(numbers: &'a mut [T], n: usize) -> Self {
        let (k, rest) = numbers.split_at_mut(n);
        let (x, rest) = rest.split_at_mut(n);
        let (z, rest) = rest.split_at_mut(n);
        let (w, rest) = rest.split_at_mut(n);
        let (q, rest) = rest.split_at_mut(n);
        Self { k, x, z, w, q, later: &mut rest[..n] }
    }
}

/// Finds z and w; returns fᵀP⁻¹f.
#[inline(always)]
pub fn look<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &[T],
    diagonal: &[T],
    f: &[T],
    scratch: &mut Scratch<'_, T>,
) -> T {
    let Scratch { z, w, q, later, .. } = scratch;
    z.copy_from_slice(f);
    let (f, mut z, mut sum) = (Long::new(f), LongMut::new(z), T::ZERO);
    for b in (0..diagonal.len().div_ceil(BLOCK)).rev() {
        let block = block(columns, b);
        let (solved, factors) = solve_triangle(block, b, z.eight(b));
        let dots = solve_and_dot::<T, V, GROUP>(block, (&mut z, &factors), &f);
        *z.eight(b) = solved;
        put_eight(w, b, &dots);
        let d = eight(diagonal, b, T::FLOOR);
        let [mut quotients, mut sums] = [[T::ZERO; BLOCK]; 2];
        for c in 0..BLOCK {
            quotients[c] = solved[c] / d[c];
        }
        for c in (0..BLOCK).rev() {
            sums[c] = sum;
            sum = solved[c].mul_add(quotients[c], sum);
        }
        put_eight(q, b, &quotients);
        put_eight(later, b, &sums);
    }
    z.finish();
    sum
}

/// P ← P + c·fᵀf with t = 1/c and P⁻¹ ← P⁻¹ + fᵀf, after [`look`].
#[inline(always)]
pub fn add_and_measure<T: Real, V: Vector<T>>(
    columns: &mut [T],
    diagonal: &mut [T],
    t: T,
    scratch: &mut Scratch<'_, T>,
) -> Chain<T> {
    let Scratch { k, x, z, w, q, later } = scratch;
    let (mut k, mut x) = (LongMut::zeros(k), LongMut::zeros(x));
    let (mut chain, mut p) = (Chain::START, T::ZERO);
    for b in 0..diagonal.len().div_ceil(BLOCK) {
        let [z, w, q, later] = [&*z, &*w, &*q, &*later].map(|of| eight(of, b, T::ZERO));
        let mut d = eight(diagonal, b, T::FLOOR);
        let [mut widening, mut widened] = [[T::ZERO; BLOCK]; 2];
        for c in 0..BLOCK {
            let before = t + later[c];
            widening[c] = q[c] / z[c].mul_add(q[c], before);
            d[c] = (z[c] / before).mul_add(z[c], d[c]);
        }
        for c in 0..BLOCK {
            widened[c] = widening[c].mul_add(p, w[c]);
            p = z[c].mul_add(w[c], p);
        }
        let (slope, v) = chain.pass(&mut d, &widened);
        put_eight(diagonal, b, &d);
        let slopes = Slopes { widening, z, slope, v };
        widen_and_rotate::<T, V>(block_mut(columns, b), &mut x, &mut k, &slopes);
    }
    k.finish();
    chain
}
