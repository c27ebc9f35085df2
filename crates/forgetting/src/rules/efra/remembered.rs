//! What the rule remembers from sample to sample.

use super::pending::Pending;
use crate::memory::state::{State, Visitor};
use crate::memory::Memory;
use crate::rules::cycle::Cycle;

/// Which of the two, the schedule says.
#[derive(Clone, Debug)]
pub enum Remembered<M: Memory> {
    /// what the last sample adds to P
    EverySample(Pending<M>),
    /// whose turn it is
    Cyclic(Cycle),
}

impl<M: Memory> State<M::Real> for Remembered<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        match self {
            Self::EverySample(pending) => pending.visit(visitor),
            Self::Cyclic(cycle) => State::<M::Real>::visit(cycle, visitor),
        }
    }

    fn is_sound(&self) -> bool {
        match self {
            Self::EverySample(pending) => pending.is_sound(),
            Self::Cyclic(cycle) => State::<M::Real>::is_sound(cycle),
        }
    }
}
