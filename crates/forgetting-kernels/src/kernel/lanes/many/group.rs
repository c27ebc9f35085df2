//! A few neighbouring columns of U together: what goes along the rows is read and written once for
//! all of them, and none waits for another.

use super::work::{get, put, Work};
use super::{read, write, Line, Real, StreamVector};
use core::marker::PhantomData;

/// Calls the method for one group of columns after the other, from the first.
macro_rules! in_groups {
    ($columns:ident.$method:ident($work:ident)) => {
        let mut first = 0;
        while first + 4 <= $columns.n {
            $columns.group::<4>(first).$method($work);
            first += 4;
        }
        while first < $columns.n {
            $columns.group::<1>(first).$method($work);
            first += 1;
        }
    };
}

/// The same from the last.
macro_rules! in_groups_from_the_last {
    ($columns:ident.$method:ident($work:ident)) => {
        let mut end = $columns.n;
        while end % 4 > 0 {
            end -= 1;
            $columns.group::<1>(end).$method($work);
        }
        while end > 0 {
            end -= 4;
            $columns.group::<4>(end).$method($work);
        }
    };
}

pub(super) use {in_groups, in_groups_from_the_last};

/// Columns `first..first + C`, for the streams from `lane` on.
pub struct Group<'a, T: Real, A, const C: usize> {
    first: usize,
    lane: usize,
    /// the rows that all of them have
    rows: [&'a mut [Line<T>]; C],
    /// the other rows, of which the column at j has j
    corner: [&'a mut [Line<T>]; C],
    lanes: PhantomData<A>,
}

const fn none<'a, T: Real>() -> &'a mut [Line<T>] {
    &mut []
}

impl<'a, T: Real, A: StreamVector<T>, const C: usize> Group<'a, T, A, C> {
    /// `lines` starts with them.
    #[inline(always)]
    pub fn of(mut lines: &'a mut [Line<T>], first: usize, lane: usize) -> Self {
        let (mut rows, mut corner) = ([const { none() }; C], [const { none() }; C]);
        for j in 0..C {
            let (column, rest) = lines.split_at_mut(first + j);
            (rows[j], corner[j]) = column.split_at_mut(first);
            lines = rest;
        }
        Self { first, lane, rows, corner, lanes: PhantomData }
    }

    /// A number for each column.
    #[inline(always)]
    fn several(&self, lines: &[Line<T>]) -> [A; C] {
        let mut numbers = [A::splat(T::ZERO); C];
        for j in 0..C {
            numbers[j] = get(lines, self.first + j);
        }
        numbers
    }

    /// w = Uᵀf
    #[inline(always)]
    pub fn transpose(&self, work: &mut Work<'_, T>) {
        let own = self.several(work.f);
        let (mut w, above) = (own, &work.f[..self.first]);
        for i in 0..self.first {
            let f: A = get(above, i);
            for j in 0..C {
                let u: A = read(&self.rows[j][i], self.lane);
                w[j] = u.mul_add(f, w[j]);
            }
        }
        for j in 0..C {
            for i in 0..j {
                let u: A = read(&self.corner[j][i], self.lane);
                w[j] = u.mul_add(own[i], w[j]);
            }
            put(work.w, self.first + j, w[j]);
        }
    }

    /// What the columns hold of z, and z above them without it.
    #[inline(always)]
    pub fn eliminate(&self, work: &mut Work<'_, T>) {
        let mut less = self.several(work.z);
        for j in (0..C).rev() {
            put(work.z, self.first + j, less[j]);
            less[j] = -less[j];
            for i in 0..j {
                less[i] = less[j].mul_add(read(&self.corner[j][i], self.lane), less[i]);
            }
        }
        let above = &mut work.z[..self.first];
        for i in 0..self.first {
            let mut z: A = get(above, i);
            for j in (0..C).rev() {
                z = less[j].mul_add(read(&self.rows[j][i], self.lane), z);
            }
            put(above, i, z);
        }
    }

    /// The columns and D after U D Uᵀ + z·zᵀ: z loses what they hold of it, and t at the start of
    /// [`Work::q`] becomes that of the columns before.
    #[inline(always)]
    pub fn add(&mut self, work: &mut Work<'_, T>) {
        let (z, d): ([A; C], [A; C]) = (self.several(work.z), self.several(work.d));
        let (mut t, mut rest): (A, [A; C]) = (get(work.q, 0), z);
        let zeros = [A::splat(T::ZERO); C];
        let (mut less, mut slope, mut kept) = (zeros, zeros, zeros);
        for j in (0..C).rev() {
            less[j] = -rest[j];
            for i in 0..j {
                rest[i] = less[j].mul_add(read(&self.corner[j][i], self.lane), rest[i]);
            }
        }
        for j in (0..C).rev() {
            let scaled = less[j] / t;
            let grown = scaled.mul_add(less[j], d[j]);
            t = less[j].mul_add(less[j] / d[j], t);
            slope[j] = -(scaled / grown);
            kept[j] = d[j] / grown;
            put(work.d, self.first + j, grown);
        }
        put(work.q, 0, t);
        let mut least = kept[0];
        for j in 1..C {
            least = least.min(kept[j]);
        }
        let is_difference = A::splat(T::EPSILON.sqrt()).at_most(least);
        if A::all(is_difference) {
            self.add_differences(work, (z, less, slope));
        } else {
            self.add_sums(work, (z, less, slope), kept, is_difference);
        }
    }

    #[inline(always)]
    fn add_differences(
        &mut self,
        work: &mut Work<'_, T>,
        (z, less, slope): ([A; C], [A; C], [A; C]),
    ) {
        let above = &mut work.z[..self.first];
        for i in 0..self.first {
            let mut rest: A = get(above, i);
            for j in (0..C).rev() {
                let u = &mut self.rows[j][i];
                let before: A = read(u, self.lane);
                rest = less[j].mul_add(before, rest);
                write(u, self.lane, slope[j].mul_add(rest, before));
            }
            put(above, i, rest);
        }
        for i in 0..C {
            let mut rest = z[i];
            for j in (i + 1..C).rev() {
                let u = &mut self.corner[j][i];
                let before: A = read(u, self.lane);
                rest = less[j].mul_add(before, rest);
                write(u, self.lane, slope[j].mul_add(rest, before));
            }
        }
    }

    /// The same, each column as a sum of which neither part is larger than P allows, but where it `is` to be a
    /// difference.
    #[cold]
    #[inline(always)]
    fn add_sums(
        &mut self,
        work: &mut Work<'_, T>,
        (z, less, slope): ([A; C], [A; C], [A; C]),
        kept: [A; C],
        is_difference: A::Mask,
    ) {
        for i in 0..self.first + C {
            let own = i.saturating_sub(self.first);
            let mut rest = if i < self.first { get(work.z, i) } else { z[own] };
            let right = if i < self.first { 0 } else { own + 1 };
            for j in (right..C).rev() {
                let u =
                    if i < self.first { &mut self.rows[j][i] } else { &mut self.corner[j][own] };
                let before: A = read(u, self.lane);
                let after = less[j].mul_add(before, rest);
                let sum = slope[j].mul_add(rest, kept[j] * before);
                write(u, self.lane, A::select(is_difference, slope[j].mul_add(after, before), sum));
                rest = after;
            }
            put(work.z, i, rest);
        }
    }

    /// The columns after the measurement.
    #[inline(always)]
    pub fn measure(&mut self, work: &mut Work<'_, T>) {
        let (w, v) = (self.several(work.w), self.several(work.v));
        let inverse = self.several(work.inverse);
        let above = &mut work.k[..self.first];
        for i in 0..self.first {
            let mut k: A = get(above, i);
            for j in 0..C {
                let u = &mut self.rows[j][i];
                let before = read(u, self.lane);
                write(u, self.lane, measured(before, (w[j], v[j], inverse[j]), &mut k));
            }
            put(above, i, k);
        }
        for i in 0..C {
            let mut k = v[i];
            for j in i + 1..C {
                let u = &mut self.corner[j][i];
                let before = read(u, self.lane);
                write(u, self.lane, measured(before, (w[j], v[j], inverse[j]), &mut k));
            }
            put(work.k, self.first + i, k);
        }
    }

    /// The columns after P ← P + c·fᵀf and the measurement.
    #[inline(always)]
    pub fn widen_and_measure(&mut self, work: &mut Work<'_, T>) {
        let (z, slope) = (self.several(work.z), self.several(work.slope));
        let (w, v) = (self.several(work.w), self.several(work.v));
        let inverse = self.several(work.inverse);
        let (above_x, above_k) = (&mut work.x[..self.first], &mut work.k[..self.first]);
        for i in 0..self.first {
            let (mut x, mut k): (A, A) = (get(above_x, i), get(above_k, i));
            for j in 0..C {
                let u = &mut self.rows[j][i];
                let before = widened(read(u, self.lane), (slope[j], z[j]), &mut x);
                write(u, self.lane, measured(before, (w[j], v[j], inverse[j]), &mut k));
            }
            put(above_x, i, x);
            put(above_k, i, k);
        }
        for i in 0..C {
            let (mut x, mut k) = (z[i], v[i]);
            for j in i + 1..C {
                let u = &mut self.corner[j][i];
                let before = widened(read(u, self.lane), (slope[j], z[j]), &mut x);
                write(u, self.lane, measured(before, (w[j], v[j], inverse[j]), &mut k));
            }
            put(work.x, self.first + i, x);
            put(work.k, self.first + i, k);
        }
    }
}

/// A number of a column after the measurement, and the gain of its row.
#[inline(always)]
fn measured<T: Real, A: StreamVector<T>>(before: A, (w, v, inverse): (A, A, A), k: &mut A) -> A {
    let after = (-(w * *k)).mul_add(inverse, before);
    *k = v.mul_add(before, *k);
    after
}

/// A number of a column after P ← P + c·fᵀf, and the x of its row.
#[inline(always)]
fn widened<T: Real, A: StreamVector<T>>(before: A, (slope, z): (A, A), x: &mut A) -> A {
    let after = slope.mul_add(*x, before);
    *x = z.mul_add(before, *x);
    after
}
