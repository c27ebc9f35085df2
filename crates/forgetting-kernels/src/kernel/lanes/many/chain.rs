//! D after a measurement, column by column.

use super::work::{get, put, Work};
use super::{read, write, Columns, Layout, Real, StreamVector};
use crate::kernel::registers::floor;

/// What measuring brought.
pub struct Measured<A> {
    pub s: A,
    pub inverse_a: A,
    /// whether columns of U are yet to become as short as [`Work::q`] says
    lifted: bool,
}

impl<T: Real, A: StreamVector<T>> Columns<'_, T, A> {
    /// D after the measurement of a regressor with w = Uᵀf.
    #[inline(always)]
    pub fn chain(&mut self, work: &mut Work<'_, T>) -> Measured<A> {
        let (one, mut s) = (A::splat(T::ONE), A::splat(T::ZERO));
        let (mut a, mut inverse_a, mut least) = (one, one, A::splat(T::CEILING));
        for c in 0..self.n {
            let (d, w): (A, A) = (get(work.d, c), get(work.w, c));
            let v = d * w;
            let next = w.mul_add(v, a);
            put(work.v, c, v);
            put(work.inverse, c, inverse_a);
            inverse_a = one / next;
            let after = d * (a * inverse_a);
            least = least.min(after);
            self.set_d(c, after);
            a = next;
        }
        for c in (0..self.n).rev() {
            s = get::<T, A>(work.w, c).mul_add(get(work.v, c), s);
        }
        let lifted = !A::all(floor::far_after(least, a));
        if lifted {
            self.lift(work, (a, inverse_a));
        }
        Measured { s, inverse_a, lifted }
    }

    /// D, just measured, at the floor where it is below.
    #[inline(always)]
    fn lift(&mut self, work: &mut Work<'_, T>, (a, mut inverse_after): (A, A)) {
        for c in (0..self.n).rev() {
            let inverse: A = get(work.inverse, c);
            let (d, w) = (self.d(c), get(work.w, c));
            let column = floor::Column { d, w, v: get(work.v, c), inverse };
            let (column, share) = column.lift(inverse_after, a);
            self.set_d(c, column.d);
            put(work.w, c, column.w);
            put(work.inverse, c, column.inverse);
            put(work.q, c, share);
            inverse_after = inverse;
        }
    }

    /// The columns of which D was lifted add to P what they added before.
    #[inline(always)]
    pub fn narrow(&mut self, work: &Work<'_, T>, measured: &Measured<A>) {
        if !measured.lifted {
            return;
        }
        for c in 0..self.n {
            let share: A = get(work.q, c);
            for i in 0..c {
                let u = &mut self.u[Layout::new(self.n).column(c) + i];
                write(u, self.lane, read::<T, A>(u, self.lane) * share);
            }
        }
    }
}
