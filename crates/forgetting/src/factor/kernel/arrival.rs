//! Samples that arrive together, and what they do to θ.

use crate::vector::Vector;
use crate::Real;

/// What has to be known of `S` samples before they are used.
pub struct Arrival<T, const S: usize> {
    /// φθ
    pub predicted: [T; S],
    /// ‖φ‖²
    pub squares: [T; S],
}

/// Puts the n numbers of each sample, which come one after the other at the beginning of `phi`, side
/// by side in `f`, and zeros after them.
#[inline(always)]
pub fn arrive<T: Real, V: Vector<T>, const S: usize>(
    phi: &[T],
    theta: &[T],
    f: &mut [[T::Chunk; S]],
) -> Arrival<T, S> {
    let n = theta.len();
    let (full, rest) = T::chunks(theta);
    let [mut predicted, mut squares] = [[V::splat(T::ZERO); S]; 2];
    for (t, theta) in full.iter().enumerate() {
        let theta = V::load(theta);
        for l in 0..S {
            f[t][l] = T::chunks(&phi[l * n + t * T::ROWS..]).0[0];
            let f = V::load(&f[t][l]);
            predicted[l] = f.mul_add(theta, predicted[l]);
            squares[l] = f.mul_add(f, squares[l]);
        }
    }
    if !rest.is_empty() {
        let (theta, last) = (V::load(&T::chunk(rest)), full.len());
        for l in 0..S {
            let numbers = &phi[l * n + last * T::ROWS..];
            let lanes = match T::chunks(numbers).0.first() {
                // what follows are numbers of other samples
                Some(chunk) => V::load(chunk).first(rest.len()),
                None => V::load(&T::chunk(&numbers[..rest.len()])),
            };
            lanes.store(&mut f[last][l]);
            predicted[l] = lanes.mul_add(theta, predicted[l]);
            squares[l] = lanes.mul_add(lanes, squares[l]);
        }
    }
    Arrival { predicted: V::sums(predicted), squares: V::sums(squares) }
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
    let (n, steps) = (theta.len(), steps.map(V::splat));
    let (chunks, rest) = T::chunks_mut(theta);
    let mut last = T::chunk(rest);
    for t in 0..n.div_ceil(T::ROWS) {
        let chunk = chunks.get_mut(t).unwrap_or(&mut last);
        let mut now = V::load(chunk);
        for l in 0..S {
            now = steps[l].mul_add(V::load(gain(l, t)), now);
            if !thetas.is_empty() {
                now.store(chunk);
                let after = &mut thetas[l * n + t * T::ROWS..(l + 1) * n];
                after.iter_mut().zip(chunk.as_ref()).for_each(|(to, &x)| *to = x);
            }
        }
        now.store(chunk);
    }
    rest.iter_mut().zip(last.as_ref()).for_each(|(to, &x)| *to = x);
}
