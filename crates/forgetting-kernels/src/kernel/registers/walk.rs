//! Adding the same variance to every parameter: P ← shrink·P + noise·I, in registers.
//!
//! The rows of [U, I] are made orthogonal in the metric of diag(shrink·D, noise·I), from the last to
//! the first (the modified weighted Gram-Schmidt update of Thornton and Bierman):
//!
//! ```text
//! for each row w_j, from the last:   D_j ← w_j Δ w_jᵀ
//!     for i < j:                     U_ij ← w_i Δ w_jᵀ / D_j,  w_i ← w_i − U_ij w_j
//! ```
//!
//! U_ij changes by the share of noise in D_j: where that is the smaller share, it is this change that is
//! computed, so that a little noise changes U by little more than rounding. Where nearly all of a long
//! column goes, U_ij is computed as a whole.
//!
//! It takes 2n³/3 products and n divisions; one dyad after the other would take half the products and
//! n²/2 divisions. Row j is 0 before its diagonal in both halves and 1 on it until its own turn, and
//! row i of the second half is 0 at j > i until the turn of row j.
//!
//! [`Small::walk`] goes along rows, for streams side by side; `columns` along columns, for a single one.
//! Both take the same sums in the same order: what is added to D_j in four parts, that to U_ij in two.

use super::{Small, Unit};
use crate::kernel::layout::COMPACT;
use crate::number::lane::Lane;
use crate::number::Real;

/// Calls `$step::<J>` for the rows J, from the last of at most ten.
macro_rules! from_the_last {
    ($rows:ident.$step:ident::<$($T:ident),+>($($argument:expr),*)) => {
        $rows.$step::<$($T,)+ 9>($($argument),*);
        $rows.$step::<$($T,)+ 8>($($argument),*);
        $rows.$step::<$($T,)+ 7>($($argument),*);
        $rows.$step::<$($T,)+ 6>($($argument),*);
        $rows.$step::<$($T,)+ 5>($($argument),*);
        $rows.$step::<$($T,)+ 4>($($argument),*);
        $rows.$step::<$($T,)+ 3>($($argument),*);
        $rows.$step::<$($T,)+ 2>($($argument),*);
        $rows.$step::<$($T,)+ 1>($($argument),*);
        $rows.$step::<$($T,)+ 0>($($argument),*);
    };
}
pub(super) use from_the_last;

/// [U, I], and Δ.
struct Rows<A, const N: usize> {
    left: [[A; N]; N],
    right: [[A; N]; N],
    weights: [A; N],
    noise: A,
}

impl<A: Copy, const N: usize, U: Unit<A, N>> Small<A, N, U> {
    /// P ← `shrink`·P + `noise`·I.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    #[cfg_attr(target_arch = "wasm32", inline(never))]
    pub fn walk<T: Real>(&mut self, shrink: A, noise: A)
    where
        A: Lane<T>,
    {
        // anything but zeros, which would be a call; nothing is read before it is written
        let mut rows =
            Rows { left: [[noise; N]; N], right: [[noise; N]; N], weights: self.d, noise };
        let n = self.u.count();
        for m in 0..n {
            rows.weights[m] = self.d[m] * shrink;
            for i in 0..m {
                rows.left[i][m] = self.u.get(m, i);
            }
        }
        if COMPACT {
            (0..n).rev().for_each(|j| rows.turn_of::<T>(j, self));
        } else {
            from_the_last!(rows.step::<T>(self));
        }
    }
}

impl<A: Copy, const N: usize> Rows<A, N> {
    /// Row J, a constant, and its part in those before it.
    #[inline(always)]
    fn step<T: Real, const J: usize>(&mut self, small: &mut Small<A, N, impl Unit<A, N>>)
    where
        A: Lane<T>,
    {
        if J < N {
            self.turn_of::<T>(J, small);
        }
    }

    /// Row j and its part in those before it.
    #[inline(always)]
    fn turn_of<T: Real>(&mut self, j: usize, small: &mut Small<A, N, impl Unit<A, N>>)
    where
        A: Lane<T>,
    {
        let (Self { left, right, weights, noise }, n) = (self, small.u.count());
        let (mut heavy, mut light) = ([*noise; N], [*noise; N]);
        let mut parts = Parts::of(*noise);
        for m in j + 1..n {
            heavy[m] = weights[m] * left[j][m];
            light[m] = *noise * right[j][m];
            parts.add::<T>(m - j, (heavy[m], left[j][m]), (light[m], right[j][m]));
        }
        let added = parts.sum::<T>();
        let d = weights[j] + added;
        small.d[j] = d;
        let inverse = A::splat(T::ONE) / d;
        for i in 0..j {
            let mut rest = A::splat(T::ZERO);
            if j + 1 < n {
                let mut sum = left[i][j + 1] * heavy[j + 1];
                let mut of_noise = right[i][j + 1] * light[j + 1];
                for m in j + 2..n {
                    sum = left[i][m].mul_add(heavy[m], sum);
                    of_noise = right[i][m].mul_add(light[m], of_noise);
                }
                rest = sum + of_noise;
            }
            let (u, left_over) = turn(left[i][j], rest, (weights[j], added, inverse));
            small.u.set(j, i, u);
            let less = -u;
            left[i][j] = left_over;
            right[i][j] = less;
            for m in j + 1..n {
                left[i][m] = less.mul_add(left[j][m], left[i][m]);
                right[i][m] = less.mul_add(right[j][m], right[i][m]);
            }
        }
    }
}

/// U_ij after the turn of row j, and what row i keeps at column j: from U_ij `before`, from the `rest` of
/// w_i Δ w_jᵀ, and from D_j, which is `weight` + `added` and has this `inverse`.
#[inline(always)]
pub(super) fn turn<T: Real, A: Lane<T>>(
    before: A,
    rest: A,
    (weight, added, inverse): (A, A, A),
) -> (A, A) {
    let little = added.at_most(weight);
    // what is known last comes last
    let change = (-before).mul_add(added, rest) * inverse;
    let whole = before.mul_add(weight, rest) * inverse;
    let u = A::select(little, before + change, whole);
    (u, A::select(little, -change, before - whole))
}

/// What is added to D_j as it is summed: what U and what I bring, each in two parts, so that fewer wait
/// for each other.
pub(super) struct Parts<A> {
    heavy: [A; 2],
    light: [A; 2],
    count: usize,
}

impl<A: Copy> Parts<A> {
    /// What is on the diagonal.
    #[inline(always)]
    pub fn of(noise: A) -> Self {
        Self { heavy: [noise; 2], light: [noise; 2], count: 0 }
    }

    /// The products that are `distance` right of it, from 1 on.
    #[inline(always)]
    pub fn add<T: Real>(&mut self, distance: usize, heavy: (A, A), light: (A, A))
    where
        A: Lane<T>,
    {
        let part = distance % 2;
        match distance {
            1 => (self.heavy[1], self.light[1]) = (heavy.0 * heavy.1, light.0 * light.1),
            2 => {
                self.heavy[0] = heavy.0 * heavy.1;
                self.light[0] = light.0.mul_add(light.1, self.light[0]);
            }
            _ => {
                self.heavy[part] = heavy.0.mul_add(heavy.1, self.heavy[part]);
                self.light[part] = light.0.mul_add(light.1, self.light[part]);
            }
        }
        self.count = distance;
    }

    #[inline(always)]
    pub fn sum<T: Real>(self) -> A
    where
        A: Lane<T>,
    {
        let Self { heavy, light, count } = self;
        match count {
            0 => light[0],
            1 => heavy[1] + (light[0] + light[1]),
            _ => (heavy[0] + heavy[1]) + (light[0] + light[1]),
        }
    }
}
