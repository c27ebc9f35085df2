//! The members of a bank, and where their states are: with each, or in lanes.

use super::together::Lanes;
use crate::estimator::AnyEstimator;
use crate::memory::state::Visitor;
use alloc::borrow::Cow;
use alloc::vec::Vec;
use forgetting_kernels::kernel::functions::add_scaled;
use forgetting_kernels::Kernels;

/// The members. Only one of the two places of their states is up to date.
#[derive(Clone, Debug)]
pub(super) struct Group<T: Kernels> {
    members: Vec<AnyEstimator<T>>,
    /// where the members can run side by side
    lanes: Option<Lanes<T>>,
    in_lanes: bool,
}

impl<T: Kernels> Group<T> {
    pub fn new(members: Vec<AnyEstimator<T>>) -> Self {
        Self { lanes: Lanes::of(&members), members, in_lanes: false }
    }

    pub fn count(&self) -> usize {
        self.members.len()
    }

    /// The members as they are.
    pub fn read(&self) -> Cow<'_, [AnyEstimator<T>]> {
        match self.in_lanes() {
            Some(lanes) => {
                let mut members = self.members.clone();
                lanes.store(&mut members);
                Cow::Owned(members)
            }
            None => Cow::Borrowed(&self.members),
        }
    }

    /// The members, of which what they are made of is up to date, but the state may be elsewhere.
    pub fn made(&self) -> &[AnyEstimator<T>] {
        &self.members
    }

    /// Shows every member as it is, with its number.
    pub fn visit_each(&self, mut visit: impl FnMut(usize, &AnyEstimator<T>)) {
        match self.in_lanes() {
            None => self.members.iter().enumerate().for_each(|(i, member)| visit(i, member)),
            Some(lanes) => {
                // one for all: they differ in their states alone, as far as is read here
                let mut member = self.members[0].clone();
                for i in 0..self.members.len() {
                    lanes.store_one(i, &mut member);
                    visit(i, &member);
                }
            }
        }
    }

    /// The members, to be updated one by one.
    pub fn each(&mut self) -> &mut [AnyEstimator<T>] {
        let Self { members, lanes, in_lanes } = self;
        if let (Some(lanes), true) = (lanes, *in_lanes) {
            lanes.store(members);
        }
        *in_lanes = false;
        members
    }

    /// The members in lanes, if they can run so.
    #[inline]
    pub fn lanes(&mut self) -> Option<&mut Lanes<T>> {
        let Self { members, lanes, in_lanes } = self;
        let lanes = lanes.as_mut()?;
        if !*in_lanes {
            lanes.load(members);
            *in_lanes = true;
        }
        Some(lanes)
    }

    /// The lanes, where they hold the states.
    #[inline]
    pub fn in_lanes(&self) -> Option<&Lanes<T>> {
        self.lanes.as_ref().filter(|_| self.in_lanes)
    }

    /// Shows every number of all states to `visitor`: as they lie in lanes, if the members can run so,
    /// else member after member.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        match self.lanes() {
            Some(lanes) => lanes.visit(visitor),
            None => self.members.iter_mut().for_each(|member| member.visit(visitor)),
        }
    }

    /// Whether P of each member that is believed has wound up.
    pub fn windup(&self, weights: &[T]) -> bool {
        match self.in_lanes() {
            Some(lanes) => lanes.windup_now(weights),
            None => self.members.iter().zip(weights).all(|(member, &weight)| {
                weight == T::ZERO || member.factor().largest() > member.windup_limit()
            }),
        }
    }

    /// θ of the mixture of n parameters and one or more targets, in the units of the members.
    pub fn theta(&self, weights: &[T], theta: &mut [T]) {
        match self.in_lanes() {
            Some(lanes) => lanes.theta(weights, theta),
            None => mix(&self.members, weights, theta),
        }
    }
}

/// Σ w_i θ_i, one member after the other.
fn mix<T: Kernels>(members: &[AnyEstimator<T>], weights: &[T], theta: &mut [T]) {
    if let [only] = members {
        return theta.copy_from_slice(only.theta());
    }
    theta.fill(T::ZERO);
    for (member, &weight) in members.iter().zip(weights) {
        if weight > T::ZERO {
            add_scaled(theta, weight, member.theta());
        }
    }
}
