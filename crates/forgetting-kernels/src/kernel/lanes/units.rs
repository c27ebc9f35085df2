//! Regressors in the units of each stream.

use super::{Line, Real, StreamVector};
use crate::kernel::units::one_unless_zero;

/// The units of the streams of a block from `lane` on.
pub struct Block<'a, T: Real> {
    /// 1/s, Σ √|x| and how many x there were other than 0: n lines each
    pub lines: &'a mut [Line<T>],
    pub lane: usize,
}

impl<T: Real> Block<'_, T> {
    #[inline(always)]
    fn read<A: StreamVector<T>>(&self, at: usize) -> A {
        A::read(&self.lines[at].0.as_ref()[self.lane..])
    }

    #[inline(always)]
    fn write<A: StreamVector<T>>(&mut self, at: usize, numbers: A) {
        numbers.write(&mut self.lines[at].0.as_mut()[self.lane..]);
    }

    /// φ to x.
    #[inline(always)]
    pub fn measure<A: StreamVector<T>, const N: usize>(&self, phi: &mut [A; N]) {
        for i in 0..N {
            phi[i] = phi[i] * self.read(i);
        }
    }

    /// The streams that used their samples, and so have the code 0, learn from x.
    #[inline(always)]
    pub fn learn<A: StreamVector<T>, const N: usize>(&mut self, x: &[A; N], codes: Option<A>) {
        let codes = match codes {
            Some(codes) => codes,
            None => A::splat(T::ZERO),
        };
        let measured = codes.at_most(A::splat(T::ZERO));
        for i in 0..N {
            let (root, count): (A, A) = (self.read(N + i), self.read(2 * N + i));
            self.write(N + i, A::select(measured, root + x[i].abs().sqrt(), root));
            let more = count + one_unless_zero(x[i]);
            self.write(2 * N + i, A::select(measured, more, count));
        }
    }
}
