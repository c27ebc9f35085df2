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

use super::bierman::Chain;
use super::block::{solve_and_dot, widen_and_rotate, with_width, Slopes};
use super::layout::BLOCK;
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
    /// z q of each column
    energy: &'a mut [T],
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
        let (energy, rest) = rest.split_at_mut(n);
        Self { k, x, z, w, energy, later: &mut rest[..n] }
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
    let n = diagonal.len();
    let Scratch { z, w, energy, later, .. } = scratch;
    z.copy_from_slice(f);
    let mut sum = T::ZERO;
    for j in (0..n).step_by(BLOCK).rev() {
        let width = BLOCK.min(n - j);
        let factors = with_width!(width, solve_triangle::<T>(columns, j, z));
        let dots = solve_and_dot::<T, V, GROUP>(columns, j, width, (z, &factors), f);
        w[j..j + width].copy_from_slice(&dots[..width]);
        for c in 0..width {
            energy[j + c] = z[j + c] * (z[j + c] / diagonal[j + c]);
        }
        for c in (j..j + width).rev() {
            later[c] = sum;
            sum += energy[c];
        }
    }
    sum
}

/// P ← P + c·fᵀf with t = 1/c and P⁻¹ ← P⁻¹ + fᵀf, after [`look`].
#[inline(always)]
pub fn add_and_measure<T: Real, V: Vector<T>, const GROUP: usize>(
    columns: &mut [T],
    diagonal: &mut [T],
    t: T,
    scratch: &mut Scratch<'_, T>,
) -> Chain<T> {
    let n = diagonal.len();
    let (mut chain, mut p) = (Chain::START, T::ZERO);
    for j in (0..n).step_by(BLOCK) {
        let width = BLOCK.min(n - j);
        let d = &mut diagonal[j..j + width];
        let slopes = with_width!(width, widen::<T>(d, t, scratch, j, (&mut chain, &mut p)));
        let vectors = (&mut *scratch.x, &mut *scratch.k);
        widen_and_rotate::<T, V, GROUP>(columns, j, width, vectors, &slopes);
    }
    chain
}

/// The scalars of a block.
#[inline(always)]
fn widen<T: Real, const C: usize>(
    d: &mut [T],
    t: T,
    scratch: &Scratch<'_, T>,
    j: usize,
    (chain, p): (&mut Chain<T>, &mut T),
) -> Slopes<T> {
    let [mut widening, mut z, mut w] = [[T::ZERO; BLOCK]; 3];
    for c in 0..C {
        z[c] = scratch.z[j + c];
        let (energy, before) = (scratch.energy[j + c], t + scratch.later[j + c]);
        widening[c] = (z[c] / d[c]) / (before + energy);
        d[c] = (z[c] / before).mul_add(z[c], d[c]);
    }
    for c in 0..C {
        let before = scratch.w[j + c];
        w[c] = widening[c].mul_add(*p, before);
        *p = z[c].mul_add(before, *p);
    }
    let (slope, v) = chain.pass(d, &w);
    Slopes { widening, z, slope, v }
}
