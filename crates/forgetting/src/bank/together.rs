//! Members that forget in the same way: a member in each lane of the vectors.

use crate::estimator::{AnyEstimator, Numbers};
use crate::memory::state::Visitor;
use crate::memory::Memory;
use alloc::vec::Vec;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::lanes::members::Together;
use forgetting_kernels::kernel::lanes::storage::{Layout, Line};
use forgetting_kernels::kernel::lanes::together::MixThetas;
use forgetting_kernels::kernel::lanes::SCRATCH;
use forgetting_kernels::kernel::layout::{COMPACT, FEW};
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::Kernels;

/// The most samples that are taken together.
const BATCH: usize = 32;
/// Bytes that members of more than ten parameters may take: larger ones leave the caches, where they are
/// better taken one by one.
const LARGE: usize = 1 << 24;

/// θ and P of all members, as a fleet keeps its streams.
#[derive(Clone, Debug)]
pub(super) struct Lanes<T: Kernels> {
    parameters: usize,
    form: Form<T>,
    /// what distinguishes the forms of the members
    strengths: Vec<Line<T>>,
    lines: Vec<Line<T>>,
    /// samples that each member has used
    samples: Vec<u64>,
    /// the largest element of D that is no windup, of each member
    limits: Vec<T>,
    /// λ as each member reports it
    factors: Vec<T>,
    buffers: Buffers<T>,
}

/// What the members brought: a number for each lane, sample after sample.
#[derive(Clone, Debug)]
struct Buffers<T: Kernels> {
    errors: Vec<T>,
    leverages: Vec<T>,
    largest: Vec<T>,
    /// θ of each member, n lines a block and sample
    thetas: Vec<Line<T>>,
    /// what members of many parameters need meanwhile
    scratch: Vec<Line<T>>,
}

impl<T: Kernels> Lanes<T> {
    /// Room for these members, unless they must be updated one by one.
    pub fn of(members: &[AnyEstimator<T>]) -> Option<Self> {
        if COMPACT {
            return None;
        }
        let parameters = members[0].prior().memory().parameters();
        let form = members[0].form_beside_others()?;
        let alike = |member: &AnyEstimator<T>| {
            member.health().is_none()
                && member.form_beside_others().is_some_and(|own| is_alike(form, own))
        };
        let (blocks, length) =
            (members.len().div_ceil(Line::<T>::LANES), layout(parameters).length());
        let is_large = parameters > FEW && blocks * length * size_of::<Line<T>>() > LARGE;
        // one member alone has no use for lanes
        if members.len() < 2 || is_large || !members.iter().all(alike) {
            return None;
        }
        // P and θ alone, in the order of a stream
        let own = Numbers::of(&mut members[0].clone());
        if own.numbers.len() != length || own.counts.len() != 1 {
            return None;
        }
        let mut strengths = alloc::vec![Line::splat(T::ZERO); blocks];
        for (i, member) in members.iter().enumerate() {
            strengths[i / Line::<T>::LANES]
                .set(i % Line::<T>::LANES, strength(member.form_beside_others()?));
        }
        let usual = Outcome { forgot: true, used: true, ..Outcome::default() };
        let most = batch(blocks, parameters);
        let width = most * blocks * Line::<T>::LANES;
        let zeros = |length| alloc::vec![T::ZERO; length];
        let lines = |length| alloc::vec![Line::splat(T::ZERO); length];
        Some(Self {
            parameters,
            form,
            strengths,
            lines: lines(blocks * length),
            samples: alloc::vec![0; members.len()],
            limits: members.iter().map(AnyEstimator::windup_limit).collect(),
            factors: members.iter().map(|one| one.report(&usual).forgetting_factor).collect(),
            buffers: Buffers {
                errors: zeros(width),
                leverages: zeros(width),
                largest: zeros(width),
                thetas: lines(most * blocks * parameters),
                scratch: lines(if parameters > FEW { SCRATCH * parameters } else { 0 }),
            },
        })
    }

    /// The most samples that [`Lanes::advance`] takes.
    pub fn most(&self) -> usize {
        batch(self.strengths.len(), self.parameters)
    }

    /// Takes the state of each member.
    pub fn load(&mut self, members: &mut [AnyEstimator<T>]) {
        let length = layout(self.parameters).length();
        for (i, member) in members.iter_mut().enumerate() {
            let (block, lane) = (i / Line::<T>::LANES, i % Line::<T>::LANES);
            let own = Numbers::of(member);
            for (line, x) in self.lines[block * length..].iter_mut().zip(own.numbers) {
                line.set(lane, x);
            }
            self.samples[i] = own.counts[0];
        }
        self.fill(members.len(), length);
    }

    /// The lanes that are over do what the first of their block does, so that nothing stops them.
    fn fill(&mut self, count: usize, length: usize) {
        for i in count..self.strengths.len() * Line::<T>::LANES {
            let (block, lane) = (i / Line::<T>::LANES, i % Line::<T>::LANES);
            let lines = self.lines[block * length..(block + 1) * length].iter_mut();
            for line in lines.chain([&mut self.strengths[block]]) {
                line.set(lane, line.get(0));
            }
        }
    }

    /// Shows every number of the members' states to `visitor`: each number of all of them, then
    /// the next; then their counts.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        let (count, length) = (self.samples.len(), layout(self.parameters).length());
        for (block, lines) in self.lines.chunks_exact_mut(length).enumerate() {
            let own = (count - block * Line::<T>::LANES).min(Line::<T>::LANES);
            lines.iter_mut().for_each(|line| visitor.reals(&mut line.0.as_mut()[..own]));
        }
        self.samples.iter_mut().for_each(|samples| visitor.whole(samples));
        self.fill(count, length);
    }

    /// Gives each member its state back.
    pub fn store(&self, members: &mut [AnyEstimator<T>]) {
        members.iter_mut().enumerate().for_each(|(i, member)| self.store_one(i, member));
    }

    /// Gives `member` the state of the i-th.
    pub fn store_one(&self, i: usize, member: &mut AnyEstimator<T>) {
        let length = layout(self.parameters).length();
        let (block, lane) = (i / Line::<T>::LANES, i % Line::<T>::LANES);
        let lines = &self.lines[block * length..(block + 1) * length];
        let numbers = lines.iter().map(|line| line.get(lane)).collect();
        Numbers::new(numbers, Vec::from([self.samples[i]])).give(member);
    }

    /// Lets all members take samples of n numbers `phi` and one number `y`, until one of them cannot;
    /// returns how many samples they took.
    pub fn advance(&mut self, phi: &[T], y: &[T]) -> usize {
        let Self { parameters, form, strengths, lines, samples, buffers, .. } = self;
        let taken = T::advance_together(Together {
            count: samples.len(),
            form: *form,
            strengths,
            lines,
            phi,
            y,
            errors: &mut buffers.errors,
            leverages: &mut buffers.leverages,
            largest: &mut buffers.largest,
            thetas: &mut buffers.thetas,
            scratch: &mut buffers.scratch,
            parameters: *parameters,
        });
        samples.iter_mut().for_each(|samples| *samples += taken as u64);
        taken
    }

    /// The errors and leverages of the members at the k-th of the samples just taken.
    #[inline]
    pub fn outcomes(&self, k: usize) -> (&[T], &[T]) {
        let first = k * self.strengths.len() * Line::<T>::LANES;
        let own = first..first + self.samples.len();
        (&self.buffers.errors[own.clone()], &self.buffers.leverages[own])
    }

    /// λ of the members, mixed.
    #[inline]
    pub fn forgetting_factor(&self, weights: &[T]) -> T {
        if self.factors.iter().all(|&lambda| lambda == T::ONE) {
            return T::ONE;
        }
        let parts = self.factors.iter().zip(weights);
        let (mixed, believed) = parts.fold((T::ZERO, T::ZERO), |(mixed, believed), (&own, &w)| {
            (mixed + w * own, believed + w)
        });
        (mixed / believed).min(T::ONE)
    }

    /// Whether each member that is believed has wound up after that sample.
    #[inline]
    pub fn windup(&self, k: usize, weights: &[T]) -> bool {
        let first = k * self.strengths.len() * Line::<T>::LANES;
        let count = weights.len();
        let (largest, limits) =
            (&self.buffers.largest[first..first + count], &self.limits[..count]);
        let mut all = true;
        for i in 0..count {
            all &= (largest[i] > limits[i]) | (weights[i] == T::ZERO);
        }
        all
    }

    /// Whether each member that is believed has wound up.
    pub fn windup_now(&self, weights: &[T]) -> bool {
        let (n, layout) = (self.parameters, layout(self.parameters));
        let wound_up = |i: usize| {
            let (block, lane) = (i / Line::<T>::LANES, i % Line::<T>::LANES);
            let lines = &self.lines[block * layout.length() + layout.diagonal()..];
            let (d, deferred) = lines[..n + layout.deferred()].split_at(n);
            let factor = deferred.last().map_or(T::ONE, |line| line.get(lane));
            let variances =
                (0..n).filter_map(|i| deferred.get(i * n - i * i.saturating_sub(1) / 2));
            let largest = variances.fold(T::ZERO, |most, line| most.max(factor * line.get(lane)));
            d.iter().map(|line| line.get(lane)).any(|d| d > self.limits[i])
                || largest > self.limits[i]
        };
        weights.iter().enumerate().all(|(i, &weight)| weight == T::ZERO || wound_up(i))
    }

    /// θ of the mixture after that sample, n numbers in units of the members.
    #[inline]
    pub fn theta_after(&self, k: usize, weights: &[T], mixed: &mut [T]) {
        let stride = self.parameters;
        let thetas = &self.buffers.thetas[k * self.strengths.len() * stride..];
        T::mix_thetas(MixThetas { thetas, stride, weights, mixed });
    }

    /// θ of the mixture now.
    pub fn theta(&self, weights: &[T], mixed: &mut [T]) {
        let layout = layout(self.parameters);
        let (thetas, stride) = (&self.lines[layout.theta()..], layout.length());
        T::mix_thetas(MixThetas { thetas, stride, weights, mixed });
    }
}

/// How many samples are taken together: fewer of many members, or of many parameters, so that what they
/// bring stays near.
fn batch(blocks: usize, parameters: usize) -> usize {
    (BATCH / blocks / parameters.div_ceil(FEW)).max(1)
}

/// Where the numbers of a member of so many parameters are.
fn layout(parameters: usize) -> Layout {
    if parameters > FEW {
        Layout::with_deferred(parameters)
    } else {
        Layout::new(parameters)
    }
}

/// Whether two forms differ in their strength alone, and can run in lanes.
fn is_alike<T: Kernels>(one: Form<T>, other: Form<T>) -> bool {
    match (one, other) {
        (Form::Scale { .. }, Form::Scale { .. }) => true,
        (Form::Walk { per_bound, .. }, Form::Walk { per_bound: own, .. }) => per_bound == own,
        _ => false,
    }
}

fn strength<T: Kernels>(form: Form<T>) -> T {
    match form {
        Form::Scale { growth } => growth,
        Form::Walk { noise, .. } => noise,
        Form::Along { weight, .. } => weight,
    }
}
