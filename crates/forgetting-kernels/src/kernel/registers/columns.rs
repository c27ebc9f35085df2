//! [`Small::walk`] of a single stream, with vectors along the columns of [U, I].

use super::walk::{from_the_last, turn, Parts};
use super::{Small, Unit};
use crate::kernel::layout::COMPACT;
use crate::number::lane::One;
use crate::number::vector::StreamVector;
use crate::number::Real;

/// Blocks of rows: two of four numbers or more hold all but the ninth row of ten parameters.
const BLOCKS: usize = 2;
const ROWS: usize = 8;

/// [U, I] above its last row, by columns, and Δ.
struct Columns<A, const N: usize> {
    left: [[A; BLOCKS]; N],
    right: [[A; BLOCKS]; N],
    /// what row 8 holds at column 9
    ninth: [A; 2],
    weights: [A; N],
    noise: A,
}

impl<O: Copy, const N: usize, U: Unit<O, N>> Small<O, N, U> {
    /// P ← `shrink`·P + `noise`·I, bit for bit as [`Small::walk`].
    #[inline(always)]
    pub fn walk_by_columns<T: Real, A: StreamVector<T>>(&mut self, shrink: T, noise: T)
    where
        O: One<T>,
    {
        // a row of four or less has no use for vectors
        if COMPACT || N <= 4 || A::COUNT * BLOCKS < ROWS {
            return self.walk(O::splat(shrink), O::splat(noise));
        }
        let splat = A::splat(noise);
        // anything but zeros, which would be a call; nothing is read before it is written
        let mut columns = Columns {
            left: [[splat; BLOCKS]; N],
            right: [[splat; BLOCKS]; N],
            ninth: [splat; 2],
            weights: [splat; N],
            noise: splat,
        };
        for m in 0..N {
            columns.weights[m] = A::splat(self.d[m].get() * shrink);
            for block in 0..BLOCKS {
                if block * A::COUNT < m {
                    let first = block * A::COUNT;
                    columns.left[m][block] = A::at(|lane| self.u.get(m, first + lane).get());
                }
            }
        }
        if N > ROWS + 1 {
            columns.ninth[0] = A::splat(self.u.get(ROWS + 1, ROWS).get());
        }
        from_the_last!(columns.step::<T, O>(self));
    }
}

impl<A: Copy, const N: usize> Columns<A, N> {
    /// Column m of row J, in every lane.
    #[inline(always)]
    fn row<T: Real, const J: usize>(&self, m: usize) -> (A, A)
    where
        A: StreamVector<T>,
    {
        if J >= ROWS {
            return (self.ninth[0], self.ninth[1]);
        }
        let (block, lane) = (J / A::COUNT, J % A::COUNT);
        (lane_of(self.left[m][block], lane), lane_of(self.right[m][block], lane))
    }

    /// Row J and its part in those before it.
    #[inline(always)]
    fn step<T: Real, O, const J: usize>(&mut self, small: &mut Small<O, N, impl Unit<O, N>>)
    where
        A: StreamVector<T>,
        O: One<T>,
    {
        if J >= N {
            return;
        }
        let (mut heavy, mut light) = ([self.noise; N], [self.noise; N]);
        let (mut left, mut right) = (heavy, light);
        let mut parts = Parts::of(self.noise);
        for m in J + 1..N {
            (left[m], right[m]) = self.row::<T, J>(m);
            heavy[m] = self.weights[m] * left[m];
            light[m] = self.noise * right[m];
            parts.add::<T>(m - J, (heavy[m], left[m]), (light[m], right[m]));
        }
        let added = parts.sum::<T>();
        let d = self.weights[J] + added;
        small.d[J] = O::splat(first_of(d));
        let inverse = A::splat(T::ONE) / d;
        if J > ROWS {
            let of_d = (self.weights[J], added, inverse);
            let (u, left_over) = turn(self.ninth[0], A::splat(T::ZERO), of_d);
            small.u.set(J, ROWS, O::splat(first_of(u)));
            self.ninth = [left_over, -u];
        }
        for block in 0..BLOCKS {
            if block * A::COUNT < J {
                let mut rest = A::splat(T::ZERO);
                if J + 1 < N {
                    let mut sum = self.left[J + 1][block] * heavy[J + 1];
                    let mut of_noise = self.right[J + 1][block] * light[J + 1];
                    for m in J + 2..N {
                        sum = self.left[m][block].mul_add(heavy[m], sum);
                        of_noise = self.right[m][block].mul_add(light[m], of_noise);
                    }
                    rest = sum + of_noise;
                }
                let of_d = (self.weights[J], added, inverse);
                let (u, left_over) = turn(self.left[J][block], rest, of_d);
                put(small, (J, block * A::COUNT), u);
                let less = -u;
                self.left[J][block] = left_over;
                self.right[J][block] = less;
                for m in J + 1..N {
                    self.left[m][block] = less.mul_add(left[m], self.left[m][block]);
                    self.right[m][block] = less.mul_add(right[m], self.right[m][block]);
                }
            }
        }
    }
}

/// The numbers of a vector.
#[inline(always)]
fn numbers<T: Real, A: StreamVector<T>>(vector: A) -> [T; 16] {
    let mut numbers = [T::ZERO; 16];
    vector.write(&mut numbers);
    numbers
}

#[inline(always)]
fn first_of<T: Real, A: StreamVector<T>>(vector: A) -> T {
    numbers(vector)[0]
}

/// The number of one lane, in every lane.
#[inline(always)]
fn lane_of<T: Real, A: StreamVector<T>>(vector: A, lane: usize) -> A {
    A::splat(numbers(vector)[lane])
}

/// Writes the rows of column c of U from `first` on that are above the diagonal.
#[inline(always)]
fn put<T: Real, O: One<T>, A: StreamVector<T>, const N: usize>(
    small: &mut Small<O, N, impl Unit<O, N>>,
    (c, first): (usize, usize),
    u: A,
) {
    let numbers = numbers(u);
    for lane in 0..A::COUNT {
        if first + lane < c.min(ROWS) {
            small.u.set(c, first + lane, O::splat(numbers[lane]));
        }
    }
}
