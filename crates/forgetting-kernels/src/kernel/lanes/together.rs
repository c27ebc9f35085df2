//! The same samples for several estimators, one in each lane of the vectors.

use super::few::{correct, State};
use super::members::{lanes, Together};
use super::{accepts, many, LaneOutcome};
use crate::kernel::dispatch::{Dispatch, Kernel};
use crate::kernel::form::{shrink, Form, SCALE, WALK};
use crate::kernel::lanes::storage::{Layout, Line};
use crate::kernel::layout::{COMPACT, FEW};
use crate::kernel::registers::Small;
use crate::kernel::vectors::few_products;
use crate::number::vector::{StreamVector, Vector};
use crate::number::Real;

/// Lets all of them take the samples: a kernel for each form, and for each number of few parameters.
#[inline(always)]
pub fn advance<T: Real, D: Dispatch<T>>(task: Together<'_, T>) -> usize {
    match task.parameters {
        _ if COMPACT => 0,
        1..=FEW => with_few!(task.parameters, few::<T, D>(task)),
        _ => D::run(Walks(task)),
    }
}

#[inline(always)]
fn few<T: Real, D: Dispatch<T>, const N: usize>(task: Together<'_, T>) -> usize {
    match task.form {
        Form::Walk { .. } => D::run(Few::<T, N, WALK>(task)),
        _ => D::run(Few::<T, N, SCALE>(task)),
    }
}

/// Estimators of `N` parameters that forget in one form.
struct Few<'a, T: Real, const N: usize, const FORM: u8>(Together<'a, T>);

impl<T: Real, const N: usize, const FORM: u8> Kernel<T> for Few<'_, T, N, FORM> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.0.size()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> usize {
        take_all::<T, V::StreamVector, N, FORM>(&mut self.0)
    }
}

/// Estimators of more than ten parameters that walk.
struct Walks<'a, T: Real>(Together<'a, T>);

impl<T: Real> Kernel<T> for Walks<'_, T> {
    type Output = usize;

    #[inline(always)]
    fn size(&self) -> usize {
        self.0.size()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> usize {
        many::walk::advance::<T, V::StreamVector>(&mut self.0)
    }
}

impl<T: Real> Together<'_, T> {
    /// Side by side, they are one large problem.
    #[inline(always)]
    fn size(&self) -> usize {
        Line::<T>::LANES * self.parameters * self.count
    }
}

#[inline(always)]
fn take_all<T: Real, A: StreamVector<T>, const N: usize, const FORM: u8>(
    task: &mut Together<'_, T>,
) -> usize {
    let (layout, phi) = (const { Layout::new(N) }, task.phi.as_chunks::<N>().0);
    let blocks = task.strengths.len();
    let samples = phi.len().min(task.y.len());
    for k in 0..samples {
        let sample = (A::splat_each(&phi[k]), A::splat(task.y[k]));
        if !all_fit::<T, A, N, FORM>(task, &sample) {
            return k;
        }
        for block in 0..blocks {
            let lines = &mut task.lines[block * layout.length()..(block + 1) * layout.length()];
            let outputs = k * blocks + block;
            for lane in lanes::<T, A>(task.count, block) {
                let strength = A::read(&task.strengths[block].0.as_ref()[lane..]);
                let form = growth::<T, A, FORM>(task.form, strength);
                let state = State::<T, A, N>::of(&mut *lines, lane);
                let (outcome, largest) = take::<T, A, N, FORM>(state, form, &sample);
                let at = outputs * Line::<T>::LANES + lane;
                largest.write(&mut task.largest[at..]);
                outcome.error.write(&mut task.errors[at..]);
                outcome.leverage.write(&mut task.leverages[at..]);
            }
            if !task.thetas.is_empty() {
                for i in 0..N {
                    task.thetas[outputs * N + i] = lines[layout.theta() + i];
                }
            }
        }
    }
    samples
}

/// What P is multiplied with, and the variance that is added.
#[inline(always)]
fn growth<T: Real, A: StreamVector<T>, const FORM: u8>(form: Form<T>, strength: A) -> (A, A) {
    match form {
        Form::Walk { per_bound, .. } if FORM == WALK => {
            (shrink(strength, A::splat(per_bound)), strength)
        }
        _ => (strength, A::splat(T::ZERO)),
    }
}

/// At least the trace of P̄.
#[inline(always)]
fn grown<T: Real, A: StreamVector<T>, const N: usize>(bound: A, (growth, noise): (A, A)) -> A {
    bound * growth + noise * A::splat(T::from_f64(N as f64))
}

/// Whether each of them can take the sample.
#[inline(always)]
fn all_fit<T: Real, A: StreamVector<T>, const N: usize, const FORM: u8>(
    task: &mut Together<'_, T>,
    (f, y): &([A; N], A),
) -> bool {
    let layout = const { Layout::new(N) };
    let mut fit = true;
    for block in 0..task.strengths.len() {
        let lines = &mut task.lines[block * layout.length()..(block + 1) * layout.length()];
        for lane in lanes::<T, A>(task.count, block) {
            let strength = A::read(&task.strengths[block].0.as_ref()[lane..]);
            let form = growth::<T, A, FORM>(task.form, strength);
            let state = State::<T, A, N>::of(&mut *lines, lane);
            let (product, squares) = few_products(f, &state.several(layout.theta()));
            let room = grown::<T, A, N>(state.read(layout.bound()), form);
            let accepted = accepts(*y - product, squares);
            fit &= A::all(A::both(accepted, room.less_than(A::splat(T::CEILING))));
        }
    }
    fit
}

/// A sample for which there is room in all lanes; also the largest element of D after it.
#[inline(always)]
fn take<T: Real, A: StreamVector<T>, const N: usize, const FORM: u8>(
    state: State<'_, T, A, N>,
    form: (A, A),
    (f, y): &([A; N], A),
) -> (LaneOutcome<A>, A) {
    let layout = const { Layout::new(N) };
    let (product, squares) = few_products(f, &state.several(layout.theta()));
    let error = *y - product;
    let bound = grown::<T, A, N>(state.read(layout.bound()), form);
    let d = state.several(layout.diagonal());
    let mut small = Small { u: state, d };
    let gain = if FORM == WALK {
        small.walk(form.0, form.1);
        small.scale_and_measure::<T, true>(A::splat(T::ONE), f)
    } else {
        small.scale_and_measure::<T, true>(form.0, f)
    };
    let outcome = correct(small, &gain, (bound, error), (None, accepts(error, squares)));
    (outcome, gain.largest)
}

/// θ of the mixture: Σ w_i θ_i over the estimators, one after the other.
pub struct MixThetas<'a, T: Real> {
    /// θ of each: n lines a block, the first one of block b being `stride`·b
    pub thetas: &'a [Line<T>],
    /// from one block to the next
    pub stride: usize,
    /// one for each estimator
    pub weights: &'a [T],
    /// n numbers
    pub mixed: &'a mut [T],
}

impl<T: Real> Kernel<T> for MixThetas<'_, T> {
    type Output = ();

    /// A number at a time: no vector is wide enough to be worth it.
    #[inline(always)]
    fn size(&self) -> usize {
        1
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        if COMPACT || self.mixed.len() > FEW {
            mix_some(self);
        } else if GROUP < 8 {
            with_few!(self.mixed.len(), mix::<T>(self));
        }
    }
}

/// Any number of parameters.
#[inline(always)]
fn mix_some<T: Real>(task: MixThetas<'_, T>) {
    for j in 0..task.mixed.len() {
        let mut mixed = T::ZERO;
        for i in 0..task.weights.len() {
            let (block, lane) = (i / Line::<T>::LANES, i % Line::<T>::LANES);
            let theta = task.thetas[block * task.stride + j].0.as_ref()[lane];
            mixed = task.weights[i].mul_add(theta, mixed);
        }
        task.mixed[j] = mixed;
    }
}

#[inline(always)]
fn mix<T: Real, const N: usize>(task: MixThetas<'_, T>) {
    let mut mixed = [T::ZERO; N];
    for (i, &weight) in task.weights.iter().enumerate() {
        let (block, lane) = (i / Line::<T>::LANES, i % Line::<T>::LANES);
        let thetas = &task.thetas[block * task.stride..block * task.stride + N];
        for j in 0..N {
            mixed[j] = weight.mul_add(thetas[j].0.as_ref()[lane], mixed[j]);
        }
    }
    for j in 0..N {
        task.mixed[j] = mixed[j];
    }
}
