//! Trusts every sample as much as its Γ says.
//!
//! ```text
//! w_k = 1
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//!
//! - Influence is not bounded: an error twice as large moves θ twice as far.
//! - Cost: none. State: none.
//! - Use it when the noise is near to Gaussian, or Γ tells how good each sample is.
//! - Not with gross errors: one moves θ as far as it is large.
//!
//! Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
//! stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024, Theorem 1.

use super::Weighting;
use crate::choice::{About, Value, Values};
use crate::sample::Evidence;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;
use core::marker::PhantomData;

/// The registry entry.
pub const ABOUT: About = About::new(&[]);

/// w_k = 1; see [`self`](crate::weightings::equal).
#[derive(Clone, Copy, Debug, Default)]
pub struct Equal<M>(PhantomData<M>);

impl<M> Equal<M> {
    /// The weighting.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<M: Memory> Weighting<M> for Equal<M> {
    fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
        Ok(Self::new())
    }

    fn describe(&self, _: &mut dyn FnMut(&'static str, Value<'_>)) {}

    fn is_equal(&self) -> bool {
        true
    }

    #[inline]
    fn weight(&self, _: &Evidence<'_, '_, M>) -> M::Real {
        M::Real::ONE
    }

    fn influence(&self, _: usize) -> Option<M::Real> {
        None
    }
}
