//! Lets every sample through.
//!
//! ```text
//! update, always
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//!
//! - Cost: none. State: none.
//! - Use it where the rule itself knows what to leave alone, as `subspace` does.
//! - Not with a rule that forgets in silence, where the input may fall silent.

use super::{Answer, Gate};
use crate::choice::{About, Value, Values};
use crate::sample::Evidence;
use crate::error::Error;
use crate::memory::Memory;
use core::marker::PhantomData;

/// The registry entry.
pub const ABOUT: About = About::new(&[]);

/// Always open; see [`self`](crate::gates::open).
#[derive(Clone, Copy, Debug, Default)]
pub struct Open<M>(PhantomData<M>);

impl<M> Open<M> {
    /// The gate.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<M: Memory> Gate<M> for Open<M> {
    fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
        Ok(Self::new())
    }

    fn describe(&self, _: &mut dyn FnMut(&'static str, Value<'_>)) {}

    fn is_open(&self) -> bool {
        true
    }

    #[inline]
    fn answer(&self, _: &Evidence<'_, '_, M>) -> Result<Answer, Error> {
        Ok(Answer::Update)
    }
}
