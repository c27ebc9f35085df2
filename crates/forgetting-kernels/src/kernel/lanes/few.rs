//! A few streams of at most ten parameters.

use super::{
    accepts, adds, make_room, report, Fate, Form, LaneOutcome, Line, Real, StreamVector, Trace,
};
use crate::kernel::form::{shrink, ALONG, SCALE, WALK};
use crate::kernel::lanes::storage::Layout;
use crate::kernel::layout::FEW;
use crate::kernel::registers::{Gain, Small, Unit};
use crate::kernel::vectors::few_products;
use core::hint::black_box;
use core::marker::PhantomData;

/// The numbers of a few streams of a block, where they are kept.
pub struct State<'a, T: Real, A, const N: usize> {
    lines: &'a mut [Line<T>],
    /// the first stream
    lane: usize,
    lanes: PhantomData<A>,
}

/// The most numbers of a stream.
const MOST: usize = Layout::new(FEW).length();

impl<'a, T: Real, A: StreamVector<T>, const N: usize> State<'a, T, A, N> {
    const LAYOUT: Layout = Layout::new(N);

    /// The streams of a block from `lane` on.
    #[inline(always)]
    pub fn of(lines: &'a mut [Line<T>], lane: usize) -> Self {
        Self { lines: &mut lines[..Self::LAYOUT.length()], lane, lanes: PhantomData }
    }

    #[inline(always)]
    pub fn read(&self, at: usize) -> A {
        A::read(&self.lines[at].0.as_ref()[self.lane..])
    }

    #[inline(always)]
    fn write(&mut self, at: usize, numbers: A) {
        numbers.write(&mut self.lines[at].0.as_mut()[self.lane..]);
    }

    /// N numbers from `at` on.
    #[inline(always)]
    pub fn several(&self, at: usize) -> [A; N] {
        let mut numbers = [A::splat(T::ZERO); N];
        for i in 0..N {
            numbers[i] = self.read(at + i);
        }
        numbers
    }

    /// What is read from now on comes from memory: there are not enough registers to keep it, and
    /// a copy elsewhere in memory gains nothing.
    #[inline(always)]
    fn read_again(&mut self) {
        let lines = black_box(core::mem::take(&mut self.lines));
        self.lines = &mut lines[..Self::LAYOUT.length()];
    }

    /// Copies all numbers, for the streams that are to get them back.
    #[inline(always)]
    fn copy_to(&self, copy: &mut [A; MOST]) {
        for at in 0..Self::LAYOUT.length() {
            copy[at] = self.read(at);
        }
    }
}

impl<T: Real, A: StreamVector<T>, const N: usize> Trace<A> for Small<A, N, State<'_, T, A, N>> {
    #[inline(always)]
    fn trace(&self) -> A {
        Small::trace::<T>(self)
    }
}

impl<T: Real, A: StreamVector<T>, const N: usize> Unit<A, N> for State<'_, T, A, N> {
    #[inline(always)]
    fn get(&self, c: usize, i: usize) -> A {
        self.read(Self::LAYOUT.column(c) + i)
    }

    #[inline(always)]
    fn set(&mut self, c: usize, i: usize, u: A) {
        self.write(Self::LAYOUT.column(c) + i, u);
    }

    #[inline(always)]
    fn last_pass(&mut self, d: &[A; N]) {
        for c in 0..N {
            self.write(Self::LAYOUT.diagonal() + c, d[c]);
        }
        self.read_again();
    }
}

/// Takes a sample of each stream.
#[inline(always)]
pub fn advance<T: Real, A: StreamVector<T>, const N: usize, const FORM: u8>(
    state: State<'_, T, A, N>,
    (form, strength): (Form<T>, A),
    (f, y): (&[A; N], A),
    with_leverage: bool,
) -> LaneOutcome<A> {
    let layout = const { Layout::new(N) };
    let theta = state.several(layout.theta());
    let (product, squares) = few_products(f, &theta);
    let error = y - product;
    let (accepted, zero) = (accepts(error, squares), A::splat(T::ZERO));
    let d = state.several(layout.diagonal());
    let small = Small { u: state, d };
    match form {
        Form::Scale { .. } if FORM == SCALE => {
            scale::<T, A, N, false>(small, (strength, zero), f, (y, error, squares), accepted)
        }
        Form::Walk { per_bound, .. } if FORM == WALK => {
            let walk = (shrink(strength, A::splat(per_bound)), strength);
            scale::<T, A, N, true>(small, walk, f, (y, error, squares), accepted)
        }
        Form::Along { dead_zone, .. } if FORM == ALONG => {
            let informed = A::both(accepted, dead_zone.leaves(squares));
            let arrived = (y, error, squares);
            along(small, strength, f, arrived, (accepted, informed), with_leverage)
        }
        _ => unreachable!("there is a kernel for each form"),
    }
}

/// P̄ = growth·P + noise·I, without the noise unless `WALK`.
#[inline(always)]
fn scale<T: Real, A: StreamVector<T>, const N: usize, const WALK: bool>(
    mut small: Small<A, N, State<'_, T, A, N>>,
    (mut growth, mut noise): (A, A),
    f: &[A; N],
    (y, error, squares): (A, A, A),
    accepted: A::Mask,
) -> LaneOutcome<A> {
    let layout = const { Layout::new(N) };
    let bound = small.u.read(layout.bound());
    let room = (growth, noise * A::splat(T::from_f64(N as f64)));
    let (bound, room) = make_room(bound, room, &small);
    if let Some(room) = room {
        growth = A::select(room, growth, A::splat(T::ONE));
        noise = A::select(room, noise, A::splat(T::ZERO));
    }
    let mut copy;
    let mut before = None;
    if !A::all(accepted) {
        // not zeros: to clear so many is a call, for which all registers are put away
        copy = [bound; MOST];
        small.u.copy_to(&mut copy);
        before = Some(&copy);
    }
    let gain = if WALK {
        small.walk(growth, noise);
        small.scale_and_measure::<T, true>(A::splat(T::ONE), f)
    } else {
        small.scale_and_measure::<T, true>(growth, f)
    };
    let outcome = correct(small, &gain, (bound, error), (before, accepted));
    match before {
        None => outcome,
        Some(_) => {
            let fate = Fate { accepted, used: accepted };
            report::mixed(&fate, (y, squares), outcome, error)
        }
    }
}

/// P̄ = P + weight·fᵀ(fRfᵀ)⁻¹f.
#[inline(always)]
fn along<T: Real, A: StreamVector<T>, const N: usize>(
    mut small: Small<A, N, State<'_, T, A, N>>,
    weight: A,
    f: &[A; N],
    (y, error, squares): (A, A, A),
    (accepted, used): (A::Mask, A::Mask),
    with_leverage: bool,
) -> LaneOutcome<A> {
    let layout = const { Layout::new(N) };
    let (zero, one) = (A::splat(T::ZERO), A::splat(T::ONE));
    let mut along = small.along(f);
    let (mut c, mut t) = (weight / along.information, along.information / weight);
    let bound = small.u.read(layout.bound());
    let mut adds = adds(c);
    let added = A::select(adds, c * squares, zero);
    let (bound, room) = make_room(bound, (one, added), &small);
    if let Some(room) = room {
        adds = A::both(adds, room);
    }
    if !A::all(adds) {
        (c, t) = (A::select(adds, c, zero), A::select(adds, t, one));
        for i in 0..N {
            along.z[i] = A::select(adds, along.z[i], zero);
            along.q[i] = A::select(adds, along.q[i], zero);
        }
    }
    small.u.read_again();
    let mut copy;
    let mut before = None;
    if !A::all(used) {
        // not zeros: to clear so many is a call, for which all registers are put away
        copy = [bound; MOST];
        small.u.copy_to(&mut copy);
        before = Some(&copy);
    }
    let silent = match before {
        Some(_) if with_leverage => small.leverage(f),
        _ => error,
    };
    let gain = small.add_and_measure::<T, true>((c, t), &along, f);
    let outcome = correct(small, &gain, (bound, error), (before, used));
    match before {
        None => outcome,
        Some(_) => report::mixed(&Fate { accepted, used }, (y, squares), outcome, silent),
    }
}

/// θ ← θ + P·fᵀe. The streams that did not use their samples become again what they were `before`.
#[inline(always)]
pub fn correct<T: Real, A: StreamVector<T>, const N: usize>(
    small: Small<A, N, State<'_, T, A, N>>,
    gain: &Gain<A, N>,
    (bound, error): (A, A),
    (before, used): (Option<&[A; MOST]>, A::Mask),
) -> LaneOutcome<A> {
    let (layout, mut state) = (const { Layout::new(N) }, small.u);
    let step = error * gain.inverse_a;
    for i in 0..N {
        let at = layout.theta() + i;
        state.write(at, step.mul_add(gain.k[i], state.read(at)));
    }
    state.write(layout.bound(), bound);
    if let Some(before) = before {
        for at in 0..layout.length() {
            state.write(at, A::select(used, state.read(at), before[at]));
        }
    }
    LaneOutcome { error, leverage: gain.s, codes: None }
}
