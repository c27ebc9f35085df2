//! What a few streams of many parameters need while they take a sample.

use super::{Line, Real, StreamVector};

/// The most streams at a time.
const MOST: usize = 16;

/// How many lines for each parameter that is.
pub const SCRATCH: usize = 10;

/// Buffers of n lines each, of which the first lanes are used.
pub struct Work<'a, T: Real> {
    pub f: &'a mut [Line<T>],
    pub d: &'a mut [Line<T>],
    pub w: &'a mut [Line<T>],
    pub v: &'a mut [Line<T>],
    /// 1/a before each column
    pub inverse: &'a mut [Line<T>],
    pub k: &'a mut [Line<T>],
    pub z: &'a mut [Line<T>],
    /// z / D, then the shares of [`floor`](crate::kernel::registers::floor)
    pub q: &'a mut [Line<T>],
    pub slope: &'a mut [Line<T>],
    pub x: &'a mut [Line<T>],
}

#[inline(always)]
pub fn get<T: Real, A: StreamVector<T>>(lines: &[Line<T>], at: usize) -> A {
    A::read(lines[at].0.as_ref())
}

#[inline(always)]
pub fn put<T: Real, A: StreamVector<T>>(lines: &mut [Line<T>], at: usize, numbers: A) {
    numbers.write(lines[at].0.as_mut());
}

impl<'a, T: Real> Work<'a, T> {
    /// From [`SCRATCH`]·n lines.
    #[inline(always)]
    pub fn of(lines: &'a mut [Line<T>], n: usize) -> Self {
        let mut rest = lines;
        // that all have n lines is to be seen by the compiler
        let mut next = || {
            let (buffer, others) = core::mem::take(&mut rest).split_at_mut(n);
            rest = others;
            buffer
        };
        Self {
            f: next(),
            d: next(),
            w: next(),
            v: next(),
            inverse: next(),
            k: next(),
            z: next(),
            q: next(),
            slope: next(),
            x: next(),
        }
    }

    /// What is not `used` is to change no number, nor the sign of a zero: products of these zeros, and
    /// sums with them, leave everything as it is.
    #[inline(always)]
    pub fn leave_out<A: StreamVector<T>>(&mut self, used: A::Mask) {
        let zero = A::splat(T::ZERO);
        for i in 0..self.f.len() {
            put(self.f, i, A::select(used, get(self.f, i), zero));
            put(self.z, i, A::select(used, get(self.z, i), zero));
            put(self.q, i, A::select(used, get(self.q, i), -zero));
        }
    }

    /// Nothing is added to P but where there is `room` for it.
    #[inline(always)]
    pub fn forget_nothing<A: StreamVector<T>>(&mut self, room: A::Mask) {
        let zero = A::splat(T::ZERO);
        for i in 0..self.f.len() {
            put(self.z, i, A::select(room, get(self.z, i), zero));
            put(self.q, i, A::select(room, get(self.q, i), zero));
        }
    }

    /// n numbers for each stream from `lane` on; zeros where there is none.
    #[inline(always)]
    pub fn regressors<A: StreamVector<T>>(&mut self, phi: &[T], lane: usize) {
        let n = self.f.len();
        let mut rows = [&[][..]; MOST];
        for k in 0..A::COUNT {
            rows[k] = phi.get((lane + k) * n..(lane + k + 1) * n).unwrap_or_default();
        }
        if rows[A::COUNT - 1].len() == n {
            for k in 0..A::COUNT {
                rows[k] = &rows[k][..n];
            }
            for i in 0..n {
                put(self.f, i, A::at(|k| rows[k][i]));
            }
            return;
        }
        for i in 0..n {
            put(self.f, i, A::at(|k| rows[k].get(i).copied().unwrap_or(T::ZERO)));
        }
    }
}
