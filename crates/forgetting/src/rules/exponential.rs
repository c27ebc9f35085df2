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
//!   λ⁻ᵏ (windup): the update reports it, and refuses the sample before P overflows.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
//! - Cost: O(p n²). State: P alone.
//! - Use it when the input excites every parameter all the time. When it may fall silent, use
//!   `subspace` or `exponential_resetting`.
//!
//! Reference: A. Goel, A. L. Bruce, D. S. Bernstein, *Recursive least squares with
//! variable-direction forgetting*, IEEE Control Systems Magazine 40(4), 2020, Theorem 1.

use super::{About, Claim, Forgetting, Forgotten, Step};
use forgetting_kernels::kernel::form::Form;
use crate::parameter::{Value, Values};
use crate::{Error, Memory, Real};
use core::marker::PhantomData;

/// The registry entry.
pub const ABOUT: About = About {
    name: "exponential",
    type_name: "Exponential",
    source: include_str!("exponential.rs"),
    parameters: &[],
    forgetting_factor: true,
    largest_rows: None,
    proper: Claim::Always,
    bounded_above: Claim::No,
    bounded_below: Claim::If("forgetting factor <= lambda_max < 1, regressors bounded"),
    cost: "O(p n^2)",
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

    #[inline]
    fn form(&self, forgetting_factor: M::Real) -> Option<Form<M::Real>> {
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
