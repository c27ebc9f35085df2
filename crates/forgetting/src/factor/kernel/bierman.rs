//! Measure and correct: Bierman's update with unit variance, P⁻¹ ← P⁻¹ + fᵀf, and θ ← θ + P₊fᵀe.
//!
//! ```text
//! for each column j of U:   w = f_j + u·f,  v = D_j w,  s' = s + w v,  a = 1 + s
//!                           D_j ← D_j a / a',  u ← u − (w / a) k,  k ← k + v u (the u of before)
//! then                      θ ← θ + k e / a'
//! ```
//!
//! The columns are taken in blocks, so that the divisions of a block do not wait for each other
//! and the gain k passes once through the registers for several columns. O(1.5 n²).
//!
//! G. J. Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V.

use super::block::{dots, load_triangle, rotate, store_triangle, with_width, PerColumn};
use super::layout::BLOCK;
use super::long::add_scaled_by;
use crate::factor::Measured;
use crate::vector::Vector;
use crate::{Kernel, Real};

/// The update, with P ← `growth`·P before it; leaves P·fᵀ in `gain`, with the P before the
/// measurement. `theta` holds n numbers for every number of `errors`.
pub struct Bierman<'a, T> {
    pub columns: &'a mut [T],
    pub diagonal: &'a mut [T],
    pub growth: T,
    pub f: &'a [T],
    pub gain: &'a mut [T],
    pub theta: &'a mut [T],
    pub errors: &'a [T],
}

/// What passes from column to column: s = a − 1, and 1/a.
#[derive(Clone, Copy)]
struct Chain<T> {
    s: T,
    inverse_a: T,
}

impl<T: Real> Chain<T> {
    const START: Self = Self { s: T::ZERO, inverse_a: T::ONE };

    /// Goes through C columns; returns the slope and v of each.
    ///
    /// Only the sum s passes from one column to the next; all else is done for all side by side.
    #[inline(always)]
    fn extend<const C: usize>(
        &mut self,
        d: &mut [T; C],
        growth: T,
        w: &[T; C],
    ) -> ([T; C], [T; C]) {
        let (mut v, mut a, mut inverse) = ([T::ZERO; C], [T::ZERO; C], [T::ZERO; C]);
        let mut product = [T::ZERO; C];
        for c in 0..C {
            d[c] *= growth;
            v[c] = d[c] * w[c];
            product[c] = w[c] * v[c];
        }
        let mut s = self.s;
        for c in 0..C {
            s += product[c];
            a[c] = T::ONE + s;
        }
        for c in 0..C {
            inverse[c] = T::ONE / a[c];
        }
        let mut slope = [T::ZERO; C];
        let (mut a_before, mut inverse_before) = (T::ONE + self.s, self.inverse_a);
        for c in 0..C {
            slope[c] = -(w[c] * inverse_before);
            d[c] = (d[c] * (a_before * inverse[c])).max(T::FLOOR);
            (a_before, inverse_before) = (a[c], inverse[c]);
        }
        *self = Self { s, inverse_a: inverse_before };
        (slope, v)
    }

    #[inline(always)]
    fn measured(self) -> Measured<T> {
        Measured { leverage: self.s, variance: T::ONE + self.s, inverse_variance: self.inverse_a }
    }
}

impl<T: Real> Kernel<T> for Bierman<'_, T> {
    type Output = Measured<T>;

    #[inline(always)]
    fn size(&self) -> usize {
        self.diagonal.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> Measured<T> {
        let n = self.diagonal.len();
        if n <= BLOCK {
            return with_width!(n, small::<T>(self));
        }
        let mut chain = Chain::START;
        let mut ahead = dots::<T, V, GROUP>(self.columns, 0, BLOCK, self.f);
        for j in (0..n).step_by(BLOCK) {
            let (w, width, next) = (ahead, BLOCK.min(n - j), j + BLOCK);
            if next < n {
                // needs nothing of this block: the machine does both at once
                ahead = dots::<T, V, GROUP>(self.columns, next, BLOCK.min(n - next), self.f);
            }
            let d = &mut self.diagonal[j..j + width];
            let (slope, v) = with_width!(width, extend::<T>(&mut chain, d, self.growth, &w));
            rotate::<T, V, GROUP>(self.columns, j, width, self.gain, (&slope, &v));
        }
        for (t, &error) in self.errors.iter().enumerate() {
            let theta = &mut self.theta[t * n..(t + 1) * n];
            add_scaled_by::<T, V>(theta, error * chain.inverse_a, self.gain);
        }
        chain.measured()
    }
}

/// [`Chain::extend`] for the last of the columns, or eight.
#[inline(always)]
fn extend<T: Real, const C: usize>(
    chain: &mut Chain<T>,
    d: &mut [T],
    growth: T,
    w: &PerColumn<T>,
) -> (PerColumn<T>, PerColumn<T>) {
    let mut all = ([T::ZERO; BLOCK], [T::ZERO; BLOCK]);
    if let (Some(d), Some(w)) = (d.first_chunk_mut::<C>(), w.first_chunk::<C>()) {
        let (slope, v) = chain.extend(d, growth, w);
        all.0[..C].copy_from_slice(&slope);
        all.1[..C].copy_from_slice(&v);
    }
    all
}

/// All of it for N parameters, at most eight.
#[inline(always)]
fn small<T: Real, const N: usize>(task: Bierman<'_, T>) -> Measured<T> {
    let Bierman { columns, diagonal, growth, f, gain, theta, errors } = task;
    let mut chain = Chain::START;
    let (Some(d), Some(f), Some(gain)) =
        (diagonal.first_chunk_mut::<N>(), f.first_chunk::<N>(), gain.first_chunk_mut::<N>())
    else {
        return chain.measured();
    };
    let mut u = load_triangle::<T, N>(columns, 0);
    let mut w = [T::ZERO; N];
    for c in 0..N {
        w[c] = f[c];
        for i in 0..c {
            w[c] = u[c][i].mul_add(f[i], w[c]);
        }
    }
    let (slope, v) = chain.extend(d, growth, &w);
    let mut k = [T::ZERO; N];
    for c in 0..N {
        for i in 0..c {
            let before = u[c][i];
            u[c][i] = slope[c].mul_add(k[i], before);
            k[i] = v[c].mul_add(before, k[i]);
        }
        k[c] = v[c];
    }
    store_triangle(columns, 0, &u);
    for (t, &error) in errors.iter().enumerate() {
        let step = error * chain.inverse_a;
        if let Some(theta) = theta[t * N..].first_chunk_mut::<N>() {
            for i in 0..N {
                theta[i] = step.mul_add(k[i], theta[i]);
            }
        }
    }
    *gain = k;
    chain.measured()
}
