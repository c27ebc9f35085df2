//! The members of a bank, and where their states are: with each, or in lanes.

use super::members::{mix, Members};
use super::together::Lanes;
use crate::error::Error;
use crate::estimator::AnyEstimator;
use crate::memory::state::Visitor;
use crate::memory::Dynamic;
use crate::sample::NoiseVariance;
use crate::weightings::Weighting;
use alloc::borrow::Cow;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// Members of any kind, on the heap. Only one of the two places of their states is up to date.
#[derive(Clone, Debug)]
pub struct Group<T: Kernels> {
    members: Vec<AnyEstimator<T>>,
    /// the sizes of a sample
    memory: Dynamic<T>,
    /// K in the place of n
    weighed: Dynamic<T>,
    /// where the members can run side by side
    lanes: Option<Lanes<T>>,
    in_lanes: bool,
}

impl<T: Kernels> Group<T> {
    /// Of these members.
    ///
    /// # Errors
    /// [`Error::Unsupported`] unless they can be one bank.
    pub(super) fn new(members: Vec<AnyEstimator<T>>) -> Result<Self, Error> {
        let memory = common_memory(&members)?;
        let weighed = Dynamic::new(members.len(), 1, 1)?;
        Ok(Self { lanes: Lanes::of(&members), members, memory, weighed, in_lanes: false })
    }

    /// The members as they are.
    pub(super) fn read(&self) -> Cow<'_, [AnyEstimator<T>]> {
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
    pub(super) fn made(&self) -> &[AnyEstimator<T>] {
        &self.members
    }

    /// The members in lanes, if they can run so.
    #[inline]
    pub(super) fn lanes(&mut self) -> Option<&mut Lanes<T>> {
        let Self { members, lanes, in_lanes, .. } = self;
        let lanes = lanes.as_mut()?;
        if !*in_lanes {
            lanes.load(members);
            *in_lanes = true;
        }
        Some(lanes)
    }

    /// The lanes, where they hold the states.
    #[inline]
    pub(super) fn in_lanes(&self) -> Option<&Lanes<T>> {
        self.lanes.as_ref().filter(|_| self.in_lanes)
    }

    /// Whether P of each member that is believed has wound up.
    pub(super) fn windup(&self, weights: &[T]) -> bool {
        match self.in_lanes() {
            Some(lanes) => lanes.windup_now(weights),
            None => self.members.iter().zip(weights).all(|(member, &weight)| {
                weight == T::ZERO || member.factor().largest() > member.windup_limit()
            }),
        }
    }
}

impl<T: Kernels> Members for Group<T> {
    type Real = T;
    type Memory = Dynamic<T>;
    type Weighed = Dynamic<T>;
    type Member = AnyEstimator<T>;
    type Numbers = Vec<T>;
    type Flags = Vec<bool>;
    type NoiseVariances = Vec<NoiseVariance<T>>;

    const SEVERAL_ROWS: bool = true;

    fn gather(
        count: usize,
        mut next: impl FnMut() -> Result<AnyEstimator<T>, Error>,
    ) -> Result<Self, Error> {
        let mut members = Vec::new();
        for _ in 0..count {
            members.push(next()?);
        }
        Self::new(members)
    }

    fn count(&self) -> usize {
        self.members.len()
    }

    fn memory(&self) -> Dynamic<T> {
        self.memory
    }

    fn weighed(&self) -> Dynamic<T> {
        self.weighed
    }

    fn is_weighted(&self) -> bool {
        self.members.iter().any(|member| !member.weighting().is_equal())
    }

    fn numbers(&self, each: usize) -> Vec<T> {
        alloc::vec![T::ZERO; self.members.len() * each]
    }

    fn flags(&self) -> Vec<bool> {
        alloc::vec![true; self.members.len()]
    }

    fn noise_variances(&self, count: usize) -> Vec<NoiseVariance<T>> {
        alloc::vec![NoiseVariance::UNKNOWN; count]
    }

    fn each(&mut self) -> &mut [AnyEstimator<T>] {
        let Self { members, lanes, in_lanes, .. } = self;
        if let (Some(lanes), true) = (lanes, *in_lanes) {
            lanes.store(members);
        }
        *in_lanes = false;
        members
    }

    fn visit_each(&self, mut visit: impl FnMut(usize, &AnyEstimator<T>)) {
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

    /// As they lie in lanes, if the members can run so, else member after member.
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        match self.lanes() {
            Some(lanes) => lanes.visit(visitor),
            None => self.members.iter_mut().for_each(|member| member.visit(visitor)),
        }
    }

    fn theta(&self, weights: &[T], theta: &mut [T]) {
        match self.in_lanes() {
            Some(lanes) => lanes.theta(weights, theta),
            None => mix(&self.members, weights, theta),
        }
    }
}

/// The sizes of members that can be one bank.
fn common_memory<T: Kernels>(members: &[AnyEstimator<T>]) -> Result<Dynamic<T>, Error> {
    let Some(first) = members.first() else {
        return Err(Error::Unsupported { reason: "a bank has at least one member" });
    };
    let memory = first.prior().memory();
    let reason = if members.iter().any(|member| member.prior().memory() != memory) {
        "all members of a bank have the same parameters, rows and targets"
    } else if members.iter().any(|member| member.prior().is_of_data()) {
        "the prior of a member is given: it is the bank that follows the data"
    } else {
        return Ok(memory);
    };
    Err(Error::Unsupported { reason })
}
