//! Buffers that an update uses and forgets, made once so that no update allocates.

use crate::Memory;

/// Buffers for rules to use freely.
#[derive(Clone, Debug)]
pub struct Work<M: Memory> {
    /// n: for the gain
    pub gain: M::Vector,
    /// for the kernels
    pub(crate) scratch: M::Scratch,
    /// p x n: for directions
    pub first: M::Rows,
    /// p x n: for more directions
    pub second: M::Rows,
}

impl<M: Memory> Work<M> {
    /// Buffers of these sizes.
    pub fn new(memory: M) -> Self {
        Self {
            gain: memory.vector(),
            scratch: memory.scratch(),
            first: memory.regressors(),
            second: memory.regressors(),
        }
    }
}
