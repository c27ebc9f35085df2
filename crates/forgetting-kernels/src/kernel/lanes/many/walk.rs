//! The same samples for several estimators of more than ten parameters that walk: P̄ = shrink·P + noise·I.
//!
//! As of a single one, P = U D Uᵀ + A: what is added goes to A, and before a sample is measured what of A
//! it can tell apart moves to U D Uᵀ with one dyad. See `covariance::deferred` of the core.

use super::deferred::Deferred;
use super::group::in_groups_from_the_last;
use super::work::{get, put, Work};
use super::{accepts, read, write, Columns, Line, Real, StreamVector};
use crate::kernel::form::{shrink, Form};
use crate::kernel::lanes::members::{lanes, Together};
use crate::kernel::lanes::storage::Layout;

/// An element of A's diagonal this many times n what a sample adds is moved to U D Uᵀ.
const LARGE: f64 = 4.0;
/// From this many times n on more would have to move than one a sample.
const TOO_LARGE: f64 = 8.0;

/// Lets all of them take samples, until one cannot; returns how many samples they took.
#[inline(always)]
pub fn advance<T: Real, A: StreamVector<T>>(task: &mut Together<'_, T>) -> usize {
    let Form::Walk { per_bound, .. } = task.form else { return 0 };
    let (n, blocks) = (task.parameters, task.strengths.len());
    let length = Layout::with_deferred(n).length();
    let samples = task.y.len().min(task.phi.len() / n);
    let mut work = Work::of(task.scratch, n);
    for k in 0..samples {
        let y = A::splat(task.y[k]);
        let phi = &task.phi[k * n..][..n];
        for i in 0..n {
            put(work.f, i, A::splat(phi[i]));
        }
        let mut fit = true;
        for block in 0..blocks {
            let lines = &mut task.lines[block * length..(block + 1) * length];
            for lane in lanes::<T, A>(task.count, block) {
                let noise = A::read(&task.strengths[block].0.as_ref()[lane..]);
                let mut walker = Walker::of(&mut *lines, lane, n);
                fit &= walker.fits(&work, (shrink(noise, A::splat(per_bound)), noise), y);
            }
        }
        if !fit {
            return k;
        }
        for block in 0..blocks {
            let lines = &mut task.lines[block * length..(block + 1) * length];
            for lane in lanes::<T, A>(task.count, block) {
                let noise = A::read(&task.strengths[block].0.as_ref()[lane..]);
                let mut walker = Walker::of(&mut *lines, lane, n);
                let form = (shrink(noise, A::splat(per_bound)), noise);
                let at = (k * blocks + block) * Line::<T>::LANES + lane;
                let (error, leverage) = walker.take(&mut work, form, y);
                error.write(&mut task.errors[at..]);
                leverage.write(&mut task.leverages[at..]);
                walker.largest().write(&mut task.largest[at..]);
            }
            if !task.thetas.is_empty() {
                let own = &lines[Layout::with_deferred(n).theta()..][..n];
                let kept = &mut task.thetas[(k * blocks + block) * n..][..n];
                for i in 0..n {
                    kept[i] = own[i];
                }
            }
        }
    }
    samples
}

/// A few estimators.
struct Walker<'a, T: Real, A> {
    columns: Columns<'a, T, A>,
    deferred: Deferred<'a, T, A>,
}

impl<'a, T: Real, A: StreamVector<T>> Walker<'a, T, A> {
    /// Those of a block from `lane` on.
    #[inline(always)]
    fn of(lines: &'a mut [Line<T>], lane: usize, n: usize) -> Self {
        let layout = Layout::with_deferred(n);
        let (u, lines) = lines.split_at_mut(layout.diagonal());
        let (d, lines) = lines.split_at_mut(n);
        let (deferred, lines) = lines.split_at_mut(layout.deferred());
        let ([bound], theta) = lines.split_at_mut(1) else { unreachable!() };
        let theta = &mut theta[..n];
        Self {
            columns: Columns { u, d, bound, theta, lane, n, lanes: core::marker::PhantomData },
            deferred: Deferred::of(deferred, lane, n),
        }
    }

    /// At least the trace of P̄.
    #[inline(always)]
    fn grown(&self, (shrink, noise): (A, A)) -> A {
        let bound: A = read(self.columns.bound, self.columns.lane);
        bound * shrink + noise * A::splat(T::from_f64(self.columns.n as f64))
    }

    /// Whether each of them can take the sample.
    #[inline(always)]
    fn fits(&mut self, work: &Work<'_, T>, form: (A, A), y: A) -> bool {
        let (product, squares) = self.columns.products(work);
        let room = self.grown(form).less_than(A::splat(T::CEILING));
        let mut fits = A::all(A::both(accepts(y - product, squares), room));
        let most = form.1 * A::splat(T::from_f64(TOO_LARGE * self.columns.n as f64));
        for i in 0..self.columns.n {
            fits &= A::all((self.deferred.variance(i) * form.0 + form.1).at_most(most));
        }
        fits
    }

    /// Takes a sample for which there is room; returns its error and its leverage.
    #[inline(always)]
    fn take(&mut self, work: &mut Work<'_, T>, (shrink, noise): (A, A), y: A) -> (A, A) {
        let error = y - self.columns.products(work).0;
        let bound = self.grown((shrink, noise));
        write(self.columns.bound, self.columns.lane, bound);
        for c in 0..self.columns.n {
            self.columns.set_d(c, self.columns.d(c) * shrink);
        }
        self.deferred.grow(shrink, noise);
        self.settle_one(work, noise);
        self.expose(work);
        let measured = self.columns.scale(work, A::splat(T::ONE));
        self.columns.correct(work, error * measured.inverse_a);
        (error, measured.s)
    }

    /// Moves the part of A along one parameter, the first of which the element of its diagonal is large.
    #[inline(always)]
    fn settle_one(&mut self, work: &mut Work<'_, T>, noise: A) {
        let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
        let large = noise * A::splat(T::from_f64(LARGE * self.columns.n as f64));
        let mut open = one;
        for i in 0..self.columns.n {
            let variance = self.deferred.variance(i);
            let due = A::both(large.less_than(variance), zero.less_than(open));
            if any::<T, A>(due) {
                open = A::select(due, zero, open);
                self.deferred.row(i, work.x);
                self.move_dyad(work, variance, due);
                self.deferred.clear(i, due);
            }
        }
    }

    /// Moves the part of A along f.
    #[inline(always)]
    fn expose(&mut self, work: &mut Work<'_, T>) {
        let n = self.columns.n;
        self.deferred.multiply(work.f, work.x);
        let (mut sum, mut spread) = (A::splat(T::ZERO), A::splat(T::ZERO));
        for i in 0..n {
            let f: A = get(work.f, i);
            sum = f.mul_add(get(work.x, i), sum);
            spread = (f * f).mul_add(self.deferred.variance(i), spread);
        }
        // no more than rounding is nothing
        let rounding = A::splat(T::EPSILON * T::from_f64(n as f64)) * spread;
        let some = rounding.less_than(sum);
        if any::<T, A>(some) {
            self.move_dyad(work, sum, some);
        }
    }

    /// U D Uᵀ ← U D Uᵀ + a aᵀ/`along`, A ← A − a aᵀ/`along` with a in [`Work::x`], where `some` says so.
    ///
    /// A is positive semidefinite, so that a_j² ≤ `along` A_jj: what is far more than that is rounding, and so is
    /// what is left of an element of the diagonal that becomes as small as its rounding was.
    #[inline(always)]
    fn move_dyad(&mut self, work: &mut Work<'_, T>, along: A, some: A::Mask) {
        let (n, zero) = (self.columns.n, A::splat(T::ZERO));
        let along = A::select(some, along, A::splat(T::ONE));
        let (inverse, twice) = (A::splat(T::ONE) / along.sqrt(), along + along);
        for j in 0..n {
            let a: A = get(work.x, j);
            let fits = (a * a).at_most(twice * self.deferred.variance(j));
            put(work.z, j, A::select(A::both(some, fits), a * inverse, zero));
        }
        self.deferred.subtract(work.z);
        let rounding = A::splat(T::EPSILON * T::from_f64(n as f64));
        for j in 0..n {
            let a: A = get(work.z, j);
            let nothing = self.deferred.variance(j).less_than(rounding * a * a);
            if any::<T, A>(nothing) {
                self.deferred.clear(j, nothing);
            }
        }
        self.columns.add(work);
    }

    /// The largest element of D, and of the diagonal of A.
    #[inline(always)]
    fn largest(&self) -> A {
        let mut largest = A::splat(T::ZERO);
        for i in 0..self.columns.n {
            largest = largest.max(self.columns.d(i)).max(self.deferred.variance(i));
        }
        largest
    }
}

impl<T: Real, A: StreamVector<T>> Columns<'_, T, A> {
    /// U D Uᵀ ← U D Uᵀ + z·zᵀ with z in [`Work::z`], which is used up: the update of Agee and Turner, see
    /// [`agee_turner`](crate::kernel::agee_turner).
    #[inline(always)]
    fn add(&mut self, work: &mut Work<'_, T>) {
        for c in 0..self.n {
            put(work.d, c, self.d(c));
        }
        put(work.q, 0, A::splat(T::ONE));
        in_groups_from_the_last!(self.add(work));
        for c in 0..self.n {
            self.set_d(c, get(work.d, c));
        }
    }
}

/// Whether it is so in any lane.
#[inline(always)]
fn any<T: Real, A: StreamVector<T>>(mask: A::Mask) -> bool {
    let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
    !A::all(A::select(mask, one, zero).at_most(zero))
}
