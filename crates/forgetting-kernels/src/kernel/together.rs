//! Samples that arrive together, and what they do to θ.

use super::copies::{first_of, put_first};
use crate::number::block_vector::BlockVector;
use crate::number::vector::Vector;
use crate::number::Real;

/// Puts the n numbers of each sample, which come one after the other at the beginning of `phi`, side
/// by side in `f`, and zeros after them.
#[inline(always)]
pub fn arrive<T: Real, V: Vector<T>, const S: usize>(phi: &[T], n: usize, f: &mut [[T::Chunk; S]]) {
    let (full, rest) = (n / T::ROWS, n % T::ROWS);
    for (t, f) in f[..full].iter_mut().enumerate() {
        for l in 0..S {
            V::load(&T::chunks(&phi[l * n + t * T::ROWS..]).0[0]).store(&mut f[l]);
        }
    }
    if rest > 0 {
        for l in 0..S {
            let numbers = &phi[l * n + full * T::ROWS..];
            let lanes: V = match T::chunks(numbers).0.first() {
                // what follows are numbers of other samples
                Some(chunk) => V::load(chunk).first(rest),
                None => V::load(&T::chunk(&numbers[..rest])),
            };
            lanes.store(&mut f[full][l]);
        }
    }
}

/// φθ and ‖φ‖² of each, at most four.
#[inline(always)]
pub fn predict<T: Real, V: Vector<T>, const S: usize>(
    theta: &[T],
    f: &[[T::Chunk; S]],
) -> ([T; S], [T; S]) {
    let mut sums = [V::splat(T::ZERO); 8];
    for (t, theta) in theta.chunks(T::ROWS).enumerate() {
        let theta: V = first_of(theta);
        for l in 0..S {
            let f = V::load(&f[t][l]);
            sums[l] = f.mul_add(theta, sums[l]);
            sums[4 + l] = f.mul_add(f, sums[4 + l]);
        }
    }
    let numbers = V::eight_sums(sums).numbers();
    let (mut predicted, mut squares) = ([T::ZERO; S], [T::ZERO; S]);
    for l in 0..S {
        (predicted[l], squares[l]) = (numbers[l], numbers[4 + l]);
    }
    (predicted, squares)
}

/// θ ← θ + Σ_l step_l k_l, one after the other; `gain` gives k_l for the rows of a tile, `thetas`
/// has room for θ after each sample, or is empty.
#[inline(always)]
pub fn correct<'a, T: Real, V: Vector<T>, const S: usize>(
    theta: &mut [T],
    steps: &[T; S],
    gain: impl Fn(usize, usize) -> &'a T::Chunk,
    thetas: &mut [T],
) {
    let (n, mut factors) = (theta.len(), [V::splat(T::ZERO); S]);
    for l in 0..S {
        factors[l] = V::splat(steps[l]);
    }
    for (t, theta) in theta.chunks_mut(T::ROWS).enumerate() {
        let mut now = first_of(theta);
        for l in 0..S {
            now = factors[l].mul_add(V::load(gain(l, t)), now);
            if !thetas.is_empty() {
                put_first(&mut thetas[l * n + t * T::ROWS..(l + 1) * n], now);
            }
        }
        put_first(theta, now);
    }
}
