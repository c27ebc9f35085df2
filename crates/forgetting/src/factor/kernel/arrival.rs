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

/// Puts the n numbers a sample of `phi` side by side in `f`, and zeros after them.
#[inline(always)]
pub fn arrive<T: Real, V: Vector<T>, const S: usize>(
    phi: &[T],
    theta: &[T],
    f: &mut [[T::Chunk; S]],
) -> Arrival<T, S> {
    let (chunks, rest) = T::chunks(theta);
    let last = T::chunk(rest);
    let [mut predicted, mut squares] = [[V::splat(T::ZERO); S]; 2];
    for (t, f) in f.iter_mut().enumerate() {
        let theta_t = V::load(chunks.get(t).unwrap_or(&last));
        for l in 0..S {
            let (chunks, rest) = T::chunks(&phi[l * theta.len()..(l + 1) * theta.len()]);
            f[l] = chunks.get(t).copied().unwrap_or_else(|| T::chunk(rest));
            let f = V::load(&f[l]);
            predicted[l] = f.mul_add(theta_t, predicted[l]);
            squares[l] = f.mul_add(f, squares[l]);
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
