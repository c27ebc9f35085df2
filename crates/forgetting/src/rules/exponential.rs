//! Forgets everything at the same rate.
//!
//! ```text
//! F_k = (1 − λ_k) R_k                      GF-RLS (35), with any rate (39)
//! R̄ = λ R,   P̄ = P / λ                    the form used: D ← D / λ
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): no. In a direction without excitation P grows as
//!   λ⁻ᵏ (windup): the update reports it. At the end of the range of numbers P stays
//!   below, and nothing is forgotten until the input returns.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
//! - Cost: O(p n²). State: P alone.
//! - Use it when the input excites every parameter all the time. When it may fall silent, use
//!   `subspace` or `exponential_resetting`.
//!
//! Reference: A. Goel, A. L. Bruce, D. S. Bernstein, *Recursive least squares with
//! variable-direction forgetting*, IEEE Control Systems Magazine 40(4), 2020, Theorem 1.

use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Setting, Value, Values,
};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;
use core::marker::PhantomData;
use forgetting_kernels::kernel::form::Form;

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    cost: "O(p n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::no(Setting::usual(Input::Fixed)),
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[])
};

/// Forgets everything at the same rate; see [`self`](crate::rules::exponential).
#[derive(Clone, Copy, Debug, Default)]
pub struct Exponential<M>(PhantomData<M>);

impl<M> Exponential<M> {
    /// The rule.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<M: Memory> Forgetting<M> for Exponential<M> {
    type State = ();

    fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
        Ok(Self::new())
    }

    fn describe(&self, _: &mut dyn FnMut(&'static str, Value<'_>)) {}

    fn start(&self, _: M) {}

    fn bounds(&self, constants: &Constants) -> Bounds {
        let below = constants.least_remembered(constants.forgetting_factors.1);
        Bounds { below, above: None }
    }

    #[inline]
    fn form(&self, forgetting_factor: M::Real, _: M::Real) -> Option<Form<M::Real>> {
        Some(Form::Scale { growth: M::Real::ONE / forgetting_factor })
    }

    #[inline]
    fn forget(&self, (): &mut (), step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let lambda = step.forgetting_factor;
        if lambda >= M::Real::ONE {
            return Ok(Forgotten::rank(0));
        }
        step.factor.scale(M::Real::ONE / lambda)?;
        Ok(Forgotten::rank(step.factor.parameters()))
    }
}
