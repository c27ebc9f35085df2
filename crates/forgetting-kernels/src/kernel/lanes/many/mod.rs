//! Blocks of streams of more than ten parameters: the equations of [`super::super::registers`],
//! a few columns at a time.

use super::{accepts, adds, make_room, report, rows, Advance, Fate, Form, Line, StreamVector};
use super::{LaneOutcome, Real, Trace};
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::ALONG;
use crate::kernel::lanes::storage::Layout;
use crate::number::vector::Vector;
use chain::Measured;
use core::marker::PhantomData;
use group::{in_groups, in_groups_from_the_last, Group};
use work::{get, put, Work};

mod chain;
mod deferred;
mod group;
pub mod walk;
mod work;

pub use work::SCRATCH;

/// Takes samples that forget in one form.
pub struct Many<'a, 's, 'o, T: Real, const FORM: u8>(pub Advance<'a, 's, 'o, T>);

impl<T: Real, const FORM: u8> Kernel<T> for Many<'_, '_, '_, T, FORM> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.0.size()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> usize {
        advance::<T, V::StreamVector, FORM>(self.0)
    }
}

/// Goes through the blocks.
#[inline(always)]
fn advance<T: Real, A: StreamVector<T>, const FORM: u8>(task: Advance<'_, '_, '_, T>) -> usize {
    let Advance { streams: part, samples, outputs } = task;
    let (n, lanes, last) = (part.n, Line::<T>::LANES, part.strengths.len() - 1);
    let with_leverage = outputs.leverage.is_some();
    let mut work = Work::of(part.scratch, n);
    let length = Layout::new(n).length();
    let mut used = 0;
    for (block, phi) in samples.phi.chunks(n * lanes).enumerate() {
        let lines = &mut part.lines[block * length..(block + 1) * length];
        let streams = block * lanes..block * lanes + phi.len() / n;
        let strength = part.strengths[block.min(last)].0.as_ref();
        let y = rows::outputs(&samples, streams.clone());
        let mut report = report::Report::new();
        for lane in (0..lanes).step_by(A::COUNT) {
            work.regressors::<A>(phi, lane);
            let mut columns = Columns::of(lines, lane, n);
            let how = (part.form, A::read(&strength[lane..]));
            let y = A::read(&y.0.as_ref()[lane..]);
            report.note(lane, &columns.take::<FORM>(&mut work, how, y, with_leverage));
        }
        part.offered[block] += 1;
        used += report.write(part.unused, outputs, streams);
    }
    used
}

/// The numbers of a few streams of a block.
struct Columns<'a, T: Real, A> {
    /// U above its diagonal
    u: &'a mut [Line<T>],
    d: &'a mut [Line<T>],
    /// of P's trace
    bound: &'a mut Line<T>,
    theta: &'a mut [Line<T>],
    /// the first stream
    lane: usize,
    n: usize,
    lanes: PhantomData<A>,
}

#[inline(always)]
fn read<T: Real, A: StreamVector<T>>(line: &Line<T>, lane: usize) -> A {
    A::read(&line.0.as_ref()[lane..])
}

#[inline(always)]
fn write<T: Real, A: StreamVector<T>>(line: &mut Line<T>, lane: usize, numbers: A) {
    numbers.write(&mut line.0.as_mut()[lane..]);
}

impl<T: Real, A: StreamVector<T>> Trace<A> for Columns<'_, T, A> {
    #[inline(always)]
    fn trace(&self) -> A {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        let mut trace = zero;
        for c in 0..self.n {
            let mut squares = zero;
            for i in 0..c {
                let u: A = read(&self.u[Layout::new(self.n).column(c) + i], self.lane);
                squares = u.mul_add(u, squares);
            }
            trace = trace + self.d(c) * (one + squares);
        }
        trace
    }
}

impl<'a, T: Real, A: StreamVector<T>> Columns<'a, T, A> {
    /// The streams of a block from `lane` on.
    #[inline(always)]
    fn of(lines: &'a mut [Line<T>], lane: usize, n: usize) -> Self {
        let layout = Layout::new(n);
        let (u, lines) = lines.split_at_mut(layout.diagonal());
        let (d, lines) = lines.split_at_mut(n);
        let ([bound], theta) = lines.split_at_mut(1) else { unreachable!() };
        Self { u, d, bound, theta: &mut theta[..n], lane, n, lanes: PhantomData }
    }

    #[inline(always)]
    fn d(&self, column: usize) -> A {
        read(&self.d[column], self.lane)
    }

    #[inline(always)]
    fn set_d(&mut self, column: usize, d: A) {
        write(&mut self.d[column], self.lane, d);
    }

    #[inline(always)]
    fn group<const C: usize>(&mut self, first: usize) -> Group<'_, T, A, C> {
        Group::of(&mut self.u[Layout::new(self.n).column(first)..], first, self.lane)
    }

    /// Takes a sample of each stream.
    #[inline(always)]
    fn take<const FORM: u8>(
        &mut self,
        work: &mut Work<'_, T>,
        (form, strength): (Form<T>, A),
        y: A,
        with_leverage: bool,
    ) -> LaneOutcome<A> {
        let (one, zero) = (A::splat(T::ONE), A::splat(T::ZERO));
        let (product, squares) = self.products(work);
        let error = y - product;
        let accepted = accepts(error, squares);
        let (used, mut growth, (mut c, mut t), grown) = match form {
            Form::Along { dead_zone, .. } if FORM == ALONG => {
                let added @ (c, _) = self.look(work, strength);
                let used = A::both(accepted, dead_zone.leaves(squares));
                (used, one, added, (one, c * squares))
            }
            _ => (accepted, strength, (zero, one), (strength, zero)),
        };
        let bound = read(self.bound, self.lane);
        let (next, room) = make_room(bound, grown, self);
        if let Some(room) = room {
            growth = A::select(room, growth, one);
            (c, t) = (A::select(room, c, zero), A::select(room, t, one));
            work.forget_nothing::<A>(room);
        }
        write(self.bound, self.lane, A::select(used, next, bound));
        let (all, mut silent) = (A::all(used), error);
        if !all {
            if with_leverage {
                silent = self.leverage(work);
            }
            growth = A::select(used, growth, one);
            (c, t) = (A::select(used, c, zero), A::select(used, t, one));
            work.leave_out::<A>(used);
        }
        let measured = match FORM {
            ALONG => self.widen(work, (c, t)),
            _ => self.scale(work, growth),
        };
        let step = A::select(used, error * measured.inverse_a, -zero);
        self.correct(work, step);
        let outcome = LaneOutcome { error, leverage: measured.s, codes: None };
        if all {
            return outcome;
        }
        report::mixed(&Fate { accepted, used }, (y, squares), outcome, silent)
    }

    // plain loops: what an iterator calls may not be compiled for the vectors

    /// φ·θ and φ·φ.
    #[inline(always)]
    fn products(&self, work: &Work<'_, T>) -> (A, A) {
        let (mut product, mut squares) = (A::splat(T::ZERO), A::splat(T::ZERO));
        for i in 0..self.n {
            let f: A = get(work.f, i);
            product = f.mul_add(read(&self.theta[i], self.lane), product);
            squares = f.mul_add(f, squares);
        }
        (product, squares)
    }

    /// f·P·fᵀ, by way of [`Work::w`]
    #[inline(always)]
    fn leverage(&mut self, work: &mut Work<'_, T>) -> A {
        in_groups!(self.transpose(work));
        let mut leverage = A::splat(T::ZERO);
        for c in 0..self.n {
            let w = get(work.w, c);
            leverage = (self.d(c) * w).mul_add(w, leverage);
        }
        leverage
    }

    /// P̄ = growth·P, then the measurement.
    #[inline(always)]
    fn scale(&mut self, work: &mut Work<'_, T>, growth: A) -> Measured<A> {
        for c in 0..self.n {
            put(work.d, c, self.d(c) * growth);
        }
        in_groups!(self.transpose(work));
        let measured = self.chain(work);
        in_groups!(self.measure(work));
        self.narrow(work, &measured);
        measured
    }

    /// Finds z and q, and c = weight/(fᵀP⁻¹f) with t = 1/c.
    #[inline(always)]
    fn look(&mut self, work: &mut Work<'_, T>, weight: A) -> (A, A) {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        for i in 0..self.n {
            put(work.z, i, get::<T, A>(work.f, i));
        }
        let mut information = zero;
        in_groups_from_the_last!(self.eliminate(work));
        for c in (0..self.n).rev() {
            let z: A = get(work.z, c);
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
    fn widen(&mut self, work: &mut Work<'_, T>, (c, mut t): (A, A)) -> Measured<A> {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        let mut inverse_t = c;
        for c in (0..self.n).rev() {
            let (z, q): (A, A) = (get(work.z, c), get(work.q, c));
            put(work.d, c, (z * inverse_t).mul_add(z, self.d(c)));
            t = z.mul_add(q, t);
            inverse_t = one / t;
            put(work.slope, c, q * inverse_t);
        }
        in_groups!(self.transpose(work));
        let mut p = zero;
        for c in 0..self.n {
            let before = get(work.w, c);
            put(work.w, c, get::<T, A>(work.slope, c).mul_add(p, before));
            p = get::<T, A>(work.z, c).mul_add(before, p);
        }
        let measured = self.chain(work);
        in_groups!(self.widen_and_measure(work));
        self.narrow(work, &measured);
        measured
    }

    /// θ ← θ + step·k.
    #[inline(always)]
    fn correct(&mut self, work: &Work<'_, T>, step: A) {
        for i in 0..self.n {
            let after = step.mul_add(get(work.k, i), read(&self.theta[i], self.lane));
            write(&mut self.theta[i], self.lane, after);
        }
    }
}
