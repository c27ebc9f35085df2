//! Blocks of streams of more than eight parameters: the equations of [`super::super::small`],
//! column by column.

use super::{accepts, adds, make_room, report, rows, Abreast, Advance, Fate, Form, Line};
use super::{Outcome, Real};
use crate::factor::kernel::small::floor;
use crate::fleet::Layout;

/// How many lines for each parameter a block needs to work with.
pub const SCRATCH: usize = 10;

/// Goes through the blocks.
#[inline(always)]
pub fn advance<T: Real, A: Abreast<T>>(task: &mut Advance<'_, '_, '_, T>) -> usize {
    let Advance { part, samples, told } = task;
    let (n, lanes, last) = (part.n, Line::<T>::LANES, part.strengths.len() - 1);
    let (layout, with_leverage) = (Layout::new(n), told.leverage.is_some());
    let mut work = Work::of(part.scratch, n);
    let blocks = part.lines.chunks_exact_mut(layout.length());
    let mut used = 0;
    for (block, (lines, phi)) in blocks.zip(samples.phi.chunks(n * lanes)).enumerate() {
        let streams = block * lanes..block * lanes + phi.len() / n;
        let strength = part.strengths[block.min(last)].0.as_ref();
        let y = rows::outputs(samples, streams.clone());
        let mut report = report::Report::new();
        for lane in (0..lanes).step_by(A::COUNT) {
            work.regressors::<A>(phi, lane);
            let mut columns = Columns { lines: &mut *lines, lane, layout, n };
            let how = (part.form, A::read(&strength[lane..]));
            let y = A::read(&y.0.as_ref()[lane..]);
            report.note(lane, &columns.take(&mut work, how, y, with_leverage));
        }
        part.offered[block] += 1;
        used += report.write(part.unused, told, streams);
    }
    used
}

/// Buffers of n lines each.
struct Work<'a, T: Real> {
    f: &'a mut [Line<T>],
    d: &'a mut [Line<T>],
    w: &'a mut [Line<T>],
    v: &'a mut [Line<T>],
    /// 1/a before each column
    inverse: &'a mut [Line<T>],
    k: &'a mut [Line<T>],
    z: &'a mut [Line<T>],
    /// z / D, then the shares of [`floor`]
    q: &'a mut [Line<T>],
    slope: &'a mut [Line<T>],
    x: &'a mut [Line<T>],
}

/// The numbers of a few streams of a block.
struct Columns<'a, T: Real> {
    lines: &'a mut [Line<T>],
    /// the first stream
    lane: usize,
    layout: Layout,
    n: usize,
}

/// What measuring brought.
struct Measured<A> {
    s: A,
    inverse_a: A,
    /// whether columns of U are yet to become as short as [`Work::q`] says
    lifted: bool,
}

#[inline(always)]
fn get<T: Real, A: Abreast<T>>(lines: &[Line<T>], at: usize) -> A {
    A::read(lines[at].0.as_ref())
}

#[inline(always)]
fn put<T: Real, A: Abreast<T>>(lines: &mut [Line<T>], at: usize, numbers: A) {
    numbers.write(lines[at].0.as_mut());
}

impl<'a, T: Real> Work<'a, T> {
    #[inline(always)]
    fn of(lines: &'a mut [Line<T>], n: usize) -> Self {
        let mut parts = lines.chunks_exact_mut(n);
        let mut next = || parts.next().unwrap_or_default();
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
    fn leave_out<A: Abreast<T>>(&mut self, used: A::Mask) {
        let zero = A::splat(T::ZERO);
        for i in 0..self.f.len() {
            put(self.f, i, A::select(used, get(self.f, i), zero));
            put(self.z, i, A::select(used, get(self.z, i), zero));
            put(self.q, i, A::select(used, get(self.q, i), -zero));
        }
    }

    /// n numbers for each stream from `lane` on; zeros where there is none.
    #[inline(always)]
    fn regressors<A: Abreast<T>>(&mut self, phi: &[T], lane: usize) {
        let n = self.f.len();
        for i in 0..n {
            let number = |k| match phi.get((lane + k) * n + i) {
                Some(&phi) => phi,
                None => T::ZERO,
            };
            put(self.f, i, A::at(number));
        }
    }
}

impl<T: Real> Columns<'_, T> {
    #[inline(always)]
    fn get<A: Abreast<T>>(&self, at: usize) -> A {
        A::read(&self.lines[at].0.as_ref()[self.lane..])
    }

    #[inline(always)]
    fn u<A: Abreast<T>>(&self, column: usize, row: usize) -> A {
        self.get(self.layout.column(column) + row)
    }

    #[inline(always)]
    fn d<A: Abreast<T>>(&self, column: usize) -> A {
        self.get(self.layout.diagonal() + column)
    }

    #[inline(always)]
    fn put<A: Abreast<T>>(&mut self, at: usize, new: A) {
        new.write(&mut self.lines[at].0.as_mut()[self.lane..]);
    }

    /// Takes a sample of each stream.
    #[inline(always)]
    fn take<A: Abreast<T>>(
        &mut self,
        work: &mut Work<'_, T>,
        (form, strength): (Form<T>, A),
        y: A,
        with_leverage: bool,
    ) -> Outcome<A> {
        let (one, zero) = (A::splat(T::ONE), A::splat(T::ZERO));
        let (product, squares) = self.products(work);
        let error = y - product;
        let accepted = accepts(error, squares);
        let (informed, mut growth, (mut c, mut t), grown) = match form {
            Form::Scale { .. } => (accepted, strength, (zero, one), (strength, zero)),
            Form::Along { dead_zone, .. } => {
                let added @ (c, _) = self.look(work, strength);
                let informed = A::both(accepted, dead_zone.leaves(squares));
                (informed, one, added, (one, c * squares))
            }
        };
        let bound = self.get(self.layout.bound());
        let (next, used) = make_room(bound, grown, informed, || self.trace());
        self.put(self.layout.bound(), A::select(used, next, bound));
        let (all, mut silent) = (A::all(used), error);
        if !all {
            if with_leverage {
                silent = self.leverage(work);
            }
            growth = A::select(used, growth, one);
            (c, t) = (A::select(used, c, zero), A::select(used, t, one));
            work.leave_out::<A>(used);
        }
        let measured = match form {
            Form::Scale { .. } => self.scale(work, growth),
            Form::Along { .. } => self.widen(work, (c, t)),
        };
        let step = A::select(used, error * measured.inverse_a, -zero);
        self.correct(work, step);
        let outcome = Outcome { error, leverage: measured.s, codes: None };
        if all {
            return outcome;
        }
        report::mixed(&Fate { accepted, informed, used }, (y, squares), outcome, silent)
    }

    // plain loops: what an iterator calls may not be compiled for the vectors

    /// φ·θ and φ·φ.
    #[inline(always)]
    fn products<A: Abreast<T>>(&self, work: &Work<'_, T>) -> (A, A) {
        let (mut product, mut squares) = (A::splat(T::ZERO), A::splat(T::ZERO));
        for i in 0..self.n {
            let f: A = get(work.f, i);
            product = f.mul_add(self.get(self.layout.theta() + i), product);
            squares = f.mul_add(f, squares);
        }
        (product, squares)
    }

    /// The trace of P.
    #[inline(always)]
    fn trace<A: Abreast<T>>(&self) -> A {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        let mut trace = zero;
        for c in 0..self.n {
            let mut squares = zero;
            for i in 0..c {
                let u: A = self.u(c, i);
                squares = u.mul_add(u, squares);
            }
            trace = trace + self.d::<A>(c) * (one + squares);
        }
        trace
    }

    /// f·P·fᵀ
    #[inline(always)]
    fn leverage<A: Abreast<T>>(&self, work: &Work<'_, T>) -> A {
        let mut leverage = A::splat(T::ZERO);
        for c in 0..self.n {
            let w = self.transposed(work, c);
            leverage = (self.d::<A>(c) * w).mul_add(w, leverage);
        }
        leverage
    }

    /// An element of Uᵀf.
    #[inline(always)]
    fn transposed<A: Abreast<T>>(&self, work: &Work<'_, T>, c: usize) -> A {
        let mut w = get(work.f, c);
        for i in 0..c {
            w = self.u::<A>(c, i).mul_add(get(work.f, i), w);
        }
        w
    }

    /// P̄ = growth·P, then the measurement.
    #[inline(always)]
    fn scale<A: Abreast<T>>(&mut self, work: &mut Work<'_, T>, growth: A) -> Measured<A> {
        for c in 0..self.n {
            put(work.d, c, self.d::<A>(c) * growth);
            put(work.w, c, self.transposed::<A>(work, c));
        }
        let measured = self.chain(work);
        for c in 0..self.n {
            let (w, v): (A, A) = (get(work.w, c), get(work.v, c));
            let inverse = get(work.inverse, c);
            for i in 0..c {
                let (at, k): (usize, A) = (self.layout.column(c) + i, get(work.k, i));
                let before: A = self.get(at);
                self.put(at, (-(w * k)).mul_add(inverse, before));
                put(work.k, i, v.mul_add(before, k));
            }
            put(work.k, c, v);
        }
        self.narrow(work, &measured);
        measured
    }

    /// Finds z and q, and c = weight/(fᵀP⁻¹f) with t = 1/c.
    #[inline(always)]
    fn look<A: Abreast<T>>(&self, work: &mut Work<'_, T>, weight: A) -> (A, A) {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        work.z.copy_from_slice(work.f);
        let mut information = zero;
        for c in (0..self.n).rev() {
            let z: A = get(work.z, c);
            for i in 0..c {
                put(work.z, i, (-z).mul_add(self.u(c, i), get(work.z, i)));
            }
            let q = z / self.d(c);
            put(work.q, c, q);
            information = z.mul_add(q, information);
        }
        let (c, t) = (weight / information, information / weight);
        let adds = adds(c);
        if A::all(adds) {
            return (c, t);
        }
        for i in 0..self.n {
            put(work.z, i, A::select(adds, get(work.z, i), zero));
            put(work.q, i, A::select(adds, get(work.q, i), zero));
        }
        (A::select(adds, c, zero), A::select(adds, t, one))
    }

    /// P̄ = P + c·fᵀf, then the measurement.
    #[inline(always)]
    fn widen<A: Abreast<T>>(&mut self, work: &mut Work<'_, T>, (c, mut t): (A, A)) -> Measured<A> {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        let mut inverse_t = c;
        for c in (0..self.n).rev() {
            let (z, q): (A, A) = (get(work.z, c), get(work.q, c));
            put(work.d, c, (z * inverse_t).mul_add(z, self.d(c)));
            t = z.mul_add(q, t);
            inverse_t = one / t;
            put(work.slope, c, q * inverse_t);
        }
        let mut p = zero;
        for c in 0..self.n {
            let before: A = self.transposed(work, c);
            put(work.w, c, get::<T, A>(work.slope, c).mul_add(p, before));
            p = get::<T, A>(work.z, c).mul_add(before, p);
        }
        let measured = self.chain(work);
        for c in 0..self.n {
            let (z, slope): (A, A) = (get(work.z, c), get(work.slope, c));
            let (w, v, inverse): (A, A, A) = (get(work.w, c), get(work.v, c), get(work.inverse, c));
            for i in 0..c {
                let (k, x): (A, A) = (get(work.k, i), get(work.x, i));
                let at = self.layout.column(c) + i;
                let before: A = self.get(at);
                let widened = slope.mul_add(x, before);
                put(work.x, i, z.mul_add(before, x));
                self.put(at, (-(w * k)).mul_add(inverse, widened));
                put(work.k, i, v.mul_add(widened, k));
            }
            put(work.x, c, z);
            put(work.k, c, v);
        }
        self.narrow(work, &measured);
        measured
    }

    /// D after the measurement of a regressor with w = Uᵀf.
    #[inline(always)]
    fn chain<A: Abreast<T>>(&mut self, work: &mut Work<'_, T>) -> Measured<A> {
        let (one, mut s) = (A::splat(T::ONE), A::splat(T::ZERO));
        let (mut a, mut inverse_a, mut least) = (one, one, A::splat(T::CEILING));
        for c in 0..self.n {
            let (d, w): (A, A) = (get(work.d, c), get(work.w, c));
            let v = d * w;
            s = w.mul_add(v, s);
            let next = one + s;
            put(work.v, c, v);
            put(work.inverse, c, inverse_a);
            inverse_a = one / next;
            let after = d * (a * inverse_a);
            least = least.min(after);
            self.put(self.layout.diagonal() + c, after);
            a = next;
        }
        let lifted = !A::all(floor::far_after(least, a));
        if lifted {
            self.lift(work, (a, inverse_a));
        }
        Measured { s, inverse_a, lifted }
    }

    /// D, just measured, at the floor where it is below.
    #[inline(always)]
    fn lift<A: Abreast<T>>(&mut self, work: &mut Work<'_, T>, (a, mut inverse_after): (A, A)) {
        for c in (0..self.n).rev() {
            let inverse: A = get(work.inverse, c);
            let (at, w) = (self.layout.diagonal() + c, get(work.w, c));
            let column = floor::Column { d: self.get(at), w, v: get(work.v, c), inverse };
            let (column, share) = column.lift(inverse_after, a);
            self.put(at, column.d);
            put(work.w, c, column.w);
            put(work.inverse, c, column.inverse);
            put(work.q, c, share);
            inverse_after = inverse;
        }
    }

    /// The columns of which D was lifted add to P what they added before.
    #[inline(always)]
    fn narrow<A: Abreast<T>>(&mut self, work: &Work<'_, T>, measured: &Measured<A>) {
        if !measured.lifted {
            return;
        }
        for c in 0..self.n {
            let share: A = get(work.q, c);
            for i in 0..c {
                let at = self.layout.column(c) + i;
                self.put(at, self.get::<A>(at) * share);
            }
        }
    }

    /// θ ← θ + step·k.
    #[inline(always)]
    fn correct<A: Abreast<T>>(&mut self, work: &Work<'_, T>, step: A) {
        for i in 0..self.n {
            let at = self.layout.theta() + i;
            let after = step.mul_add(get(work.k, i), self.get(at));
            self.put(at, after);
        }
    }
}
