//! Measure and correct: Bierman's update with unit variance, P⁻¹ ← P⁻¹ + fᵀf, and θ ← θ + P₊fᵀe.
//!
//! ```text
//! for each column j of U:   w = f_j + u·f,  v = D_j w,  a' = a + w v
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
        let (mut v, mut a, mut product) = ([T::ZERO; C], [T::ZERO; C], [T::ZERO; C]);
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

    #[inline(always)]
    fn measured(self, d: &[T]) -> Measured<T> {
        let Self { s, inverse_a } = self;
        let largest = largest(d);
        Measured { leverage: s, variance: T::ONE + s, inverse_variance: inverse_a, largest }
    }
}

/// The largest of positive numbers, eight side by side.
#[inline(always)]
fn largest<T: Real>(numbers: &[T]) -> T {
    let (eights, rest) = numbers.as_chunks::<BLOCK>();
    let mut most = [T::ZERO; BLOCK];
    for eight in eights {
        for lane in 0..BLOCK {
            most[lane] = most[lane].max(eight[lane]);
        }
    }
    most.iter().chain(rest).fold(T::ZERO, |most, &x| most.max(x))
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
            with_width!(n, small::<T>(self))
        } else {
            blocks::<T, V, GROUP>(self)
        }
    }
}

/// All of it for more than eight parameters.
#[inline(always)]
pub fn blocks<T: Real, V: Vector<T>, const GROUP: usize>(task: Bierman<'_, T>) -> Measured<T> {
    let Bierman { columns, diagonal, growth, f, gain, theta, errors } = task;
    let n = diagonal.len();
    let mut chain = Chain::START;
    let mut ahead = dots::<T, V, GROUP>(columns, 0, BLOCK, f);
    for j in (0..n).step_by(BLOCK) {
        let (w, width, next) = (ahead, BLOCK.min(n - j), j + BLOCK);
        if next < n {
            // needs nothing of this block: the machine does both at once
            ahead = dots::<T, V, GROUP>(columns, next, BLOCK.min(n - next), f);
        }
        let d = &mut diagonal[j..j + width];
        let (slope, v) = with_width!(width, extend::<T>(&mut chain, d, growth, &w));
        rotate::<T, V, GROUP>(columns, j, width, gain, (&slope, &v));
    }
    for (t, &error) in errors.iter().enumerate() {
        let theta = &mut theta[t * n..(t + 1) * n];
        add_scaled_by::<T, V>(theta, error * chain.inverse_a, gain);
    }
    chain.measured(diagonal)
}

/// [`Chain::extend`] for the last of the columns, or eight: the slope and v of each.
#[inline(always)]
fn extend<T: Real, const C: usize>(
    chain: &mut Chain<T>,
    d: &mut [T],
    growth: T,
    w: &PerColumn<T>,
) -> (PerColumn<T>, PerColumn<T>) {
    let (mut slope, mut v) = ([T::ZERO; BLOCK], [T::ZERO; BLOCK]);
    if let (Some(d), Some(w)) = (d.first_chunk_mut::<C>(), w.first_chunk::<C>()) {
        let found = chain.extend(d, growth, w);
        slope[..C].copy_from_slice(&found.0);
        v[..C].copy_from_slice(&found.1);
    }
    (slope, v)
}

/// All of it for N parameters, at most eight, in registers.
#[inline(always)]
pub fn small<T: Real, const N: usize>(task: Bierman<'_, T>) -> Measured<T> {
    let Bierman { columns, diagonal, growth, f, gain, theta, errors } = task;
    let (Some(d), Some(f), Some(gain)) =
        (diagonal.first_chunk_mut::<N>(), f.first_chunk::<N>(), gain.first_chunk_mut::<N>())
    else {
        return Chain::START.measured(&[]);
    };
    let mut u = load_triangle::<T, N>(columns, 0);
    let (w, mut v, mut s, mut largest) = (transposed(&u, f), [T::ZERO; N], T::ZERO, T::ZERO);
    // 1/a before each column
    let (mut a, mut inverse_a, mut inverse) = (T::ONE, T::ONE, [T::ONE; N]);
    for c in 0..N {
        let grown = d[c] * growth;
        v[c] = grown * w[c];
        let next = w[c].mul_add(v[c], a);
        inverse[c] = inverse_a;
        inverse_a = T::ONE / next;
        d[c] = (grown * (a * inverse_a)).max(T::FLOOR);
        largest = largest.max(d[c]);
        a = next;
    }
    for c in (0..N).rev() {
        s = w[c].mul_add(v[c], s);
    }
    let mut k = [T::ZERO; N];
    for c in 0..N {
        for i in 0..c {
            let before = u[c][i];
            // the reciprocal comes last
            u[c][i] = (-(w[c] * k[i])).mul_add(inverse[c], before);
            k[i] = v[c].mul_add(before, k[i]);
        }
        k[c] = v[c];
    }
    store_triangle(columns, 0, &u);
    for (t, &error) in errors.iter().enumerate() {
        let step = error * inverse_a;
        if let Some(theta) = theta[t * N..].first_chunk_mut::<N>() {
            for i in 0..N {
                theta[i] = step.mul_add(k[i], theta[i]);
            }
        }
    }
    *gain = k;
    Measured { leverage: s, variance: a, inverse_variance: inverse_a, largest }
}

/// Uᵀf, in two sums of which neither waits for the other.
#[inline(always)]
fn transposed<T: Real, const N: usize>(u: &[[T; N]; N], f: &[T; N]) -> [T; N] {
    let mut w = *f;
    for c in 0..N {
        let mut odd = T::ZERO;
        for i in 0..c {
            if i % 2 == 0 {
                w[c] = u[c][i].mul_add(f[i], w[c]);
            } else {
                odd = u[c][i].mul_add(f[i], odd);
            }
        }
        if c > 1 {
            w[c] += odd;
        }
    }
    w
}
