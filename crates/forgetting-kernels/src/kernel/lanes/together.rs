//! The same samples for several estimators, one in each lane of the vectors.

use super::few::{correct, State};
use super::members::{lanes, Together};
use super::{accepts, many, LaneOutcome};
use crate::kernel::dispatch::Kernel;
use crate::kernel::form::{shrink, Form};
use crate::kernel::lanes::storage::{Layout, Line};
use crate::kernel::layout::{COMPACT, FEW};
use crate::kernel::registers::Small;
use crate::kernel::vectors::few_products;
use crate::number::vector::{StreamVector, Vector};
use crate::number::Real;

impl<T: Real> Kernel<T> for Together<'_, T> {
    type Output = usize;

    /// Side by side, they are one large problem.
    #[inline(always)]
    fn size(&self) -> usize {
        Line::<T>::LANES * self.parameters * self.count
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(mut self) -> usize {
        match self.form {
            _ if COMPACT => 0,
            Form::Walk { .. } if self.parameters > FEW => {
                many::walk::advance::<T, V::StreamVector>(&mut self)
            }
            Form::Walk { .. } => {
                with_few!(self.parameters, walks::<T, V>(&mut self))
            }
            _ => with_few!(self.parameters, scales::<T, V>(&mut self)),
        }
    }
}

#[inline(always)]
fn walks<T: Real, V: Vector<T>, const N: usize>(task: &mut Together<'_, T>) -> usize {
    advance::<T, V::StreamVector, N, true>(task)
}

#[inline(always)]
fn scales<T: Real, V: Vector<T>, const N: usize>(task: &mut Together<'_, T>) -> usize {
    advance::<T, V::StreamVector, N, false>(task)
}

#[inline(always)]
fn advance<T: Real, A: StreamVector<T>, const N: usize, const WALK: bool>(
    task: &mut Together<'_, T>,
) -> usize {
    let (layout, phi) = (const { Layout::new(N) }, task.phi.as_chunks::<N>().0);
    let blocks = task.strengths.len();
    let samples = phi.len().min(task.y.len());
    for k in 0..samples {
        let sample = (A::splat_each(&phi[k]), A::splat(task.y[k]));
        if !all_fit::<T, A, N, WALK>(task, &sample) {
            return k;
        }
        for block in 0..blocks {
            let lines = &mut task.lines[block * layout.length()..(block + 1) * layout.length()];
            let outputs = k * blocks + block;
            for lane in lanes::<T, A>(task.count, block) {
                let strength = A::read(&task.strengths[block].0.as_ref()[lane..]);
                let form = growth::<T, A, WALK>(task.form, strength);
                let state = State::<T, A, N>::of(&mut *lines, lane);
                let (outcome, largest) = take::<T, A, N, WALK>(state, form, &sample);
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
fn growth<T: Real, A: StreamVector<T>, const WALK: bool>(form: Form<T>, strength: A) -> (A, A) {
    match form {
        Form::Walk { per_bound, .. } if WALK => (shrink(strength, A::splat(per_bound)), strength),
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
fn all_fit<T: Real, A: StreamVector<T>, const N: usize, const WALK: bool>(
    task: &mut Together<'_, T>,
    (f, y): &([A; N], A),
) -> bool {
    let layout = const { Layout::new(N) };
    let mut fit = true;
    for block in 0..task.strengths.len() {
        let lines = &mut task.lines[block * layout.length()..(block + 1) * layout.length()];
        for lane in lanes::<T, A>(task.count, block) {
            let strength = A::read(&task.strengths[block].0.as_ref()[lane..]);
            let form = growth::<T, A, WALK>(task.form, strength);
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
fn take<T: Real, A: StreamVector<T>, const N: usize, const WALK: bool>(
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
    let gain = if WALK {
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
