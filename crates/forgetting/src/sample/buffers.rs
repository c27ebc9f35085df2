//! Buffers that every update writes anew, made once so that no update allocates.

use crate::memory::Memory;

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

/// What an update computes of a sample.
#[derive(Clone, Debug)]
pub(crate) struct SampleBuffers<M: Memory> {
    /// p x n: the whitened regressor
    pub regressors: M::Rows,
    /// p x m: the innovation y − φθ, in units of y
    pub innovations: M::Errors,
    /// p x m: the whitened innovation
    pub errors: M::Errors,
    /// p x m: the whitened innovation times the weight, which is what rates see
    pub clipped: M::Errors,
    /// p x m: the whitened innovation, reduced as the rows are measured one after the other
    pub remaining: M::Errors,
    /// p x p: Γ, then its root
    pub noise: M::Noise,
}

impl<M: Memory> SampleBuffers<M> {
    /// Buffers of these sizes.
    pub fn new(memory: M) -> Self {
        Self {
            regressors: memory.regressors(),
            innovations: memory.errors(),
            errors: memory.errors(),
            clipped: memory.errors(),
            remaining: memory.errors(),
            noise: memory.noise(),
        }
    }
}
