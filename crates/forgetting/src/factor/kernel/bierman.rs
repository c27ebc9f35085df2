//! Measure and correct: Bierman's update with unit variance, P⁻¹ ← P⁻¹ + fᵀf, and θ ← θ + P₊fᵀe.
//!
//! ```text
//! for each column j of U:   w = f_j + u·f,  v = D_j w,  a' = a + w v
//!                           D_j ← D_j a / a',  u ← u − (w / a) k,  k ← k + v u (the u of before)
//! then                      θ ← θ + k e / a
//! ```
//!
//! The columns are taken in blocks, so that the divisions of a block do not wait for each other
//! and the gain k passes once through the registers for several columns. O(1.5 n²).
//!
//! G. J. Bierman, *Factorization Methods for Discrete Sequential Estimation*, 1977, chapter V.

use super::block::{dots, load_triangle, rotate, store_triangle, with_width, PerColumn, BLOCK};
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

/// What passes from column to column.
#[derive(Clone, Copy)]
struct Chain<T> {
    s: T,
    a: T,
    inverse_a: T,
}

impl<T: Real> Chain<T> {
    const START: Self = Self { s: T::ZERO, a: T::ONE, inverse_a: T::ONE };

    /// Goes through `width` columns; returns the slope and v of each.
    #[inline(always)]
    fn extend(
        &mut self,
        d: &mut [T],
        growth: T,
        w: &PerColumn<T>,
        width: usize,
    ) -> (PerColumn<T>, PerColumn<T>) {
        let (mut slope, mut v) = ([T::ZERO; BLOCK], [T::ZERO; BLOCK]);
        let (d, Self { mut s, mut a, mut inverse_a }) = (&mut d[..width], *self);
        for c in 0..width {
            let grown = d[c] * growth;
            v[c] = grown * w[c];
            slope[c] = -(w[c] * inverse_a);
            s = w[c].mul_add(v[c], s);
            let next = w[c].mul_add(v[c], a);
            inverse_a = T::ONE / next;
            d[c] = (grown * (a * inverse_a)).max(T::FLOOR);
            a = next;
        }
        *self = Self { s, a, inverse_a };
        (slope, v)
    }

    #[inline(always)]
    fn measured(self) -> Measured<T> {
        Measured { leverage: self.s, variance: self.a, inverse_variance: self.inverse_a }
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
        for j in (0..n).step_by(BLOCK) {
            let width = BLOCK.min(n - j);
            let w = dots::<T, V, GROUP>(self.columns, j, width, self.f);
            let d = &mut self.diagonal[j..j + width];
            let factors = if width == BLOCK {
                chain.extend(d, self.growth, &w, BLOCK)
            } else {
                chain.extend(d, self.growth, &w, width)
            };
            rotate::<T, V, GROUP>(self.columns, j, width, self.gain, (&factors.0, &factors.1));
        }
        for (t, &error) in self.errors.iter().enumerate() {
            let theta = &mut self.theta[t * n..(t + 1) * n];
            add_scaled_by::<T, V>(theta, error * chain.inverse_a, self.gain);
        }
        chain.measured()
    }
}

/// All of it for N parameters, at most eight.
#[inline(always)]
fn small<T: Real, const N: usize>(task: Bierman<'_, T>) -> Measured<T> {
    let Bierman { columns, diagonal, growth, f, gain, theta, errors } = task;
    let (Some(d), Some(f), Some(gain)) =
        (diagonal.first_chunk_mut::<N>(), f.first_chunk::<N>(), gain.first_chunk_mut::<N>())
    else {
        return Chain::START.measured();
    };
    let mut u = load_triangle::<T, N>(columns, 0);
    let mut w = [T::ZERO; BLOCK];
    for c in 0..N {
        w[c] = f[c];
        for i in 0..c {
            w[c] = u[c][i].mul_add(f[i], w[c]);
        }
    }
    let mut chain = Chain::START;
    let (slope, v) = chain.extend(d, growth, &w, N);
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
