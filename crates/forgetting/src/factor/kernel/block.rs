//! Blocks of up to eight neighbouring columns of U: a rectangle of whole rows above a triangle.
//!
//! ```text
//! columns   j  j+1 ... j+C−1          j is a multiple of 8
//!           ┌──────────────┐
//! rows 0    │              │
//!  ⋮        │  rectangle   │          swept in vectors of 8 or 16 rows
//! rows j−1  │              │
//!           └──────────────┤
//! rows j      ╲  triangle  │          C (C − 1)/2 numbers, in registers
//!               ╲          │
//! ```

use crate::vector::Vector;
use crate::Real;

/// Columns of a block, and rows of its vectors: eight.
pub const BLOCK: usize = 8;

/// The part of the packed columns where column j starts.
#[inline(always)]
pub fn start(j: usize) -> usize {
    j * j.saturating_sub(1) / 2
}

/// Columns j to j + C of the packed triangle, each with the rows above j only.
#[inline(always)]
pub fn rectangle<T, const C: usize>(columns: &[T], first: usize, j: usize) -> [&[T]; C] {
    let mut rest = &columns[start(first)..];
    let mut column = first;
    core::array::from_fn(|_| {
        let (this, next) = rest.split_at(column);
        rest = next;
        column += 1;
        &this[..j]
    })
}

/// The same, to be written.
#[inline(always)]
pub fn rectangle_mut<T, const C: usize>(
    columns: &mut [T],
    first: usize,
    j: usize,
) -> [&mut [T]; C] {
    let mut rest = &mut columns[start(first)..];
    let mut column = first;
    core::array::from_fn(|_| {
        let (this, next) = core::mem::take(&mut rest).split_at_mut(column);
        rest = next;
        column += 1;
        &mut this[..j]
    })
}

/// u_c · f for `C` columns of equal length, a multiple of eight: one pass over `f`.
#[inline(always)]
pub fn dots<T: Real, V: Vector<T>, const C: usize>(columns: [&[T]; C], f: &[T]) -> [T; C] {
    let (f, f_half) = T::chunks(f);
    let columns = columns.map(|u| {
        let (chunks, half) = T::chunks(u);
        (&chunks[..f.len()], half)
    });
    let mut sums = [V::splat(T::ZERO); C];
    for i in 0..f.len() {
        let x = V::load(&f[i]);
        for c in 0..C {
            sums[c] = V::load(&columns[c].0[i]).mul_add(x, sums[c]);
        }
    }
    if let Some(f) = f_half.first_chunk() {
        let x = V::load_half(f);
        for c in 0..C {
            if let Some(u) = columns[c].1.first_chunk() {
                sums[c] = V::load_half(u).mul_add(x, sums[c]);
            }
        }
    }
    sums.map(V::sum)
}

/// For c from 0 to C: `k` += v_c u_c and u_c += slope_c `k`, each with the other of before.
#[inline(always)]
pub fn rotate<T: Real, V: Vector<T>, const C: usize>(
    columns: [&mut [T]; C],
    k: &mut [T],
    slope: [T; C],
    v: [T; C],
) {
    let (k, k_half) = T::chunks_mut(k);
    let columns = columns.map(|u| {
        let (chunks, half) = T::chunks_mut(u);
        (&mut chunks[..k.len()], half)
    });
    let (slope, v) = (slope.map(V::splat), v.map(V::splat));
    for i in 0..k.len() {
        let mut gain = V::load(&k[i]);
        for c in 0..C {
            let before = V::load(&columns[c].0[i]);
            slope[c].mul_add(gain, before).store(&mut columns[c].0[i]);
            gain = v[c].mul_add(before, gain);
        }
        gain.store(&mut k[i]);
    }
    if let Some(k) = k_half.first_chunk_mut() {
        let mut gain = V::load_half(k);
        for c in 0..C {
            if let Some(u) = columns[c].1.first_chunk_mut() {
                let before = V::load_half(u);
                slope[c].mul_add(gain, before).store_half(u);
                gain = v[c].mul_add(before, gain);
            }
        }
        gain.store_half(k);
    }
}
