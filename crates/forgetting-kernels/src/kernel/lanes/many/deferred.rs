//! A of P = U D Uᵀ + A, of a few estimators side by side: what has been added to P, and not yet to U D Uᵀ.

use super::work::{get, put};
use super::{read, write, Line, Real, StreamVector};
use core::marker::PhantomData;

/// The common factor of A is multiplied out where it is below this.
const FAR: f64 = 1e-6;

/// A symmetric matrix: its upper triangle row by row, over a common factor.
pub struct Deferred<'a, T: Real, A> {
    rows: &'a mut [Line<T>],
    factor: &'a mut Line<T>,
    n: usize,
    /// the first estimator
    lane: usize,
    lanes: PhantomData<A>,
}

/// Rows that have neighbouring numbers: what goes across them is read and written once for all.
struct Group<'a, T: Real, const C: usize> {
    /// what the row at j has on its diagonal and at the other C − j − 1
    corner: [&'a mut [Line<T>]; C],
    /// what all of them have to the right of these
    rest: [&'a mut [Line<T>]; C],
}

/// Calls the method for one group of rows after the other.
macro_rules! by_groups {
    ($deferred:ident.$method:ident($($argument:expr),*)) => {
        let mut first = 0;
        while first + 4 <= $deferred.n {
            $deferred.$method::<4>(first, $($argument),*);
            first += 4;
        }
        while first < $deferred.n {
            $deferred.$method::<1>(first, $($argument),*);
            first += 1;
        }
    };
}

impl<'a, T: Real, A: StreamVector<T>> Deferred<'a, T, A> {
    /// In these lines, for the estimators from `lane` on.
    #[inline(always)]
    pub fn of(lines: &'a mut [Line<T>], lane: usize, n: usize) -> Self {
        let (rows, rest) = lines.split_at_mut(n * (n + 1) / 2);
        Self { rows, factor: &mut rest[0], n, lane, lanes: PhantomData }
    }

    /// A_ij for j ≥ i, in the list of lines.
    #[inline(always)]
    fn place(&self, i: usize, j: usize) -> usize {
        i * self.n - i * i.saturating_sub(1) / 2 + (j - i)
    }

    #[inline(always)]
    fn factor(&self) -> A {
        read(self.factor, self.lane)
    }

    /// A_ii
    #[inline(always)]
    pub fn variance(&self, i: usize) -> A {
        self.factor() * read(&self.rows[self.place(i, i)], self.lane)
    }

    /// A ← `shrink`·A + `noise`·I
    #[inline(always)]
    pub fn grow(&mut self, shrink: A, noise: A) {
        let (one, mut factor) = (A::splat(T::ONE), self.factor() * shrink);
        if !A::all(A::splat(T::from_f64(FAR)).at_most(factor)) {
            for line in &mut *self.rows {
                write(line, self.lane, read::<T, A>(line, self.lane) * factor);
            }
            factor = one;
        }
        write(self.factor, self.lane, factor);
        let added = noise / factor;
        for i in 0..self.n {
            let place = self.place(i, i);
            let line = &mut self.rows[place];
            write(line, self.lane, read::<T, A>(line, self.lane) + added);
        }
    }

    /// Row i as n numbers.
    #[inline(always)]
    pub fn row(&self, i: usize, row: &mut [Line<T>]) {
        let factor = self.factor();
        for j in 0..self.n {
            let line = &self.rows[self.place(i.min(j), i.max(j))];
            put(row, j, factor * read::<T, A>(line, self.lane));
        }
    }

    /// A_ij ← 0 and A_ji ← 0 for all j where `mask` says so.
    #[inline(always)]
    pub fn clear(&mut self, i: usize, mask: A::Mask) {
        for j in 0..self.n {
            let place = self.place(i.min(j), i.max(j));
            let line = &mut self.rows[place];
            let after = A::select(mask, A::splat(T::ZERO), read(line, self.lane));
            write(line, self.lane, after);
        }
    }

    #[inline(always)]
    fn group<const C: usize>(&mut self, first: usize) -> Group<'_, T, C> {
        let start = self.place(first, first);
        let mut lines = &mut self.rows[start..];
        let (mut corner, mut rest) = ([const { none() }; C], [const { none() }; C]);
        let right = self.n - first - C;
        for j in 0..C {
            let (own, others) = lines.split_at_mut(C - j + right);
            (corner[j], rest[j]) = own.split_at_mut(C - j);
            lines = others;
        }
        Group { corner, rest }
    }

    /// `product` ← A·`f`
    #[inline(always)]
    pub fn multiply(&mut self, f: &[Line<T>], product: &mut [Line<T>]) {
        by_groups!(self.multiply_rows(f, product));
        let factor = self.factor();
        for i in 0..self.n {
            put(product, i, factor * get::<T, A>(product, i));
        }
    }

    #[inline(always)]
    fn multiply_rows<const C: usize>(
        &mut self,
        first: usize,
        f: &[Line<T>],
        product: &mut [Line<T>],
    ) {
        let lane = self.lane;
        let Group { corner, rest } = self.group::<C>(first);
        let zero = A::splat(T::ZERO);
        let (mut own, mut sums) = ([zero; C], [zero; C]);
        for k in 0..C {
            own[k] = get(f, first + k);
            sums[k] = if first == 0 { zero } else { get(product, first + k) };
        }
        for k in 0..C {
            sums[k] = read::<T, A>(&corner[k][0], lane).mul_add(own[k], sums[k]);
            for l in k + 1..C {
                let x: A = read(&corner[k][l - k], lane);
                sums[k] = x.mul_add(own[l], sums[k]);
                sums[l] = x.mul_add(own[k], sums[l]);
            }
        }
        let right = rest[0].len();
        let (f, across) = (&f[first + C..][..right], &mut product[first + C..][..right]);
        for j in 0..right {
            let f: A = get(f, j);
            let mut sum = if first == 0 { zero } else { get(across, j) };
            for k in 0..C {
                let x: A = read(&rest[k][j], lane);
                sums[k] = x.mul_add(f, sums[k]);
                sum = x.mul_add(own[k], sum);
            }
            put(across, j, sum);
        }
        for k in 0..C {
            put(product, first + k, sums[k]);
        }
    }

    /// A ← A − x·xᵀ, with nothing left of the common factor.
    #[inline(always)]
    pub fn subtract(&mut self, x: &[Line<T>]) {
        by_groups!(self.subtract_rows(x));
        write(self.factor, self.lane, A::splat(T::ONE));
    }

    #[inline(always)]
    fn subtract_rows<const C: usize>(&mut self, first: usize, x: &[Line<T>]) {
        let (lane, factor) = (self.lane, self.factor());
        let Group { corner, rest } = self.group::<C>(first);
        let mut less = [A::splat(T::ZERO); C];
        for k in 0..C {
            less[k] = -get::<T, A>(x, first + k);
            for l in k..C {
                let line = &mut corner[k][l - k];
                let kept = factor * read::<T, A>(line, lane);
                write(line, lane, less[k].mul_add(get(x, first + l), kept));
            }
        }
        let right = rest[0].len();
        let x = &x[first + C..][..right];
        for j in 0..right {
            let x: A = get(x, j);
            for k in 0..C {
                let line = &mut rest[k][j];
                let kept = factor * read::<T, A>(line, lane);
                write(line, lane, less[k].mul_add(x, kept));
            }
        }
    }
}

const fn none<'a, T: Real>() -> &'a mut [Line<T>] {
    &mut []
}
