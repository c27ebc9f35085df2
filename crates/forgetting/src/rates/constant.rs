//! The same forgetting factor at every sample.
//!
//! ```text
//! λ_k = λ
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | λ | forgetting_factor | (0, 1] | 0.99 |
//!
//! - The memory is 1/(1 − λ) samples long; after ln(1/2)/ln λ samples (the half-life) a sample
//!   counts half.
//! - Cost: none. State: none.
//! - Use it first: it is the one number that the others replace.
//! - Not where parameters rest and move in turns: one factor is too noisy for the one or too slow
//!   for the other.
//!
//! Reference: GF-RLS (35).

use super::{Evidence, Rate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const FORGETTING_FACTOR: Parameter = Parameter::real(
    "forgetting_factor",
    0.99,
    Range::FRACTION,
    "weight that old information keeps at each sample; 1 never forgets",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[FORGETTING_FACTOR]);

/// λ_k = λ; see [`self`](crate::rates::constant).
#[derive(Clone, Copy, Debug)]
pub struct Constant<M: Memory> {
    forgetting_factor: M::Real,
}

impl<M: Memory> Constant<M> {
    /// With λ in (0, 1].
    ///
    /// # Errors
    /// [`Error::Value`] unless it is.
    pub fn new(forgetting_factor: M::Real) -> Result<Self, Error> {
        Ok(Self { forgetting_factor: FORGETTING_FACTOR.check(forgetting_factor)? })
    }

    /// With the factor that forgets half of a sample in `samples` samples: λ = 2^(−1/samples).
    ///
    /// # Errors
    /// [`Error::Value`] unless `samples` is positive.
    pub fn half_life(samples: M::Real) -> Result<Self, Error> {
        const HALF_LIFE: Parameter = Parameter::real("half_life", 1.0, Range::POSITIVE, "samples");
        let samples = HALF_LIFE.check(samples)?;
        Self::new((M::Real::from_f64(0.5).ln() / samples).exp())
    }

    /// With the factor whose memory is `samples` long: λ = 1 − 1/samples.
    ///
    /// # Errors
    /// [`Error::Value`] unless `samples` is greater than 1.
    pub fn memory_length(samples: M::Real) -> Result<Self, Error> {
        const RANGE: Range = Range::open(1.0, f64::INFINITY, "(1, inf)");
        const LENGTH: Parameter = Parameter::real("memory_length", 100.0, RANGE, "samples");
        let samples = LENGTH.check(samples)?;
        Self::new(M::Real::ONE - M::Real::ONE / samples)
    }
}

impl<M: Memory> Rate<M> for Constant<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(FORGETTING_FACTOR.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(FORGETTING_FACTOR.name, Value::Real(self.forgetting_factor.to_f64()));
    }

    fn start(&self, _: M) {}

    fn constant(&self) -> Option<M::Real> {
        Some(self.forgetting_factor)
    }

    #[inline]
    fn forgetting_factor(&self, (): &(), _: &Evidence<'_, '_, M>) -> Result<M::Real, Error> {
        Ok(self.forgetting_factor)
    }
}
