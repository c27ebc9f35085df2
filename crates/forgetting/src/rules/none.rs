//! Never forgets: plain recursive least squares.
//!
//! ```text
//! F_k = 0                                  GF-RLS section V-A, (32)
//! R̄ = R                                    nothing to do
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//!
//! - Proper (A1): always.
//! - P̄ bounded above without excitation (A2): always, by P₀.
//! - P bounded below (A3): no, P → 0 under persistent excitation; old data weigh as much as new.
//! - Cost: O(p n²). State: P alone.
//! - Use it for parameters that never change. With parameters that drift, the estimate lags more
//!   and more.
//!
//! Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
//! stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024.

use super::{Forgetting, Forgotten, Step};
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Setting, Value, Values,
};
use crate::error::Error;
use crate::memory::Memory;
use core::marker::PhantomData;
use forgetting_kernels::kernel::form::Form;

/// The registry entry.
pub const ABOUT: About = About {
    cost: "O(p n^2)",
    guarantees: Some(Guarantees {
        proper: Guarantee::ALWAYS,
        bounded_above: Guarantee::ALWAYS,
        bounded_below: Guarantee::no(Setting::usual(Input::Exciting(1))),
    }),
    ..About::new(&[])
};

/// Never forgets; see [`self`](crate::rules::none).
#[derive(Clone, Copy, Debug, Default)]
pub struct NoForgetting<M>(PhantomData<M>);

impl<M> NoForgetting<M> {
    /// The rule.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<M: Memory> Forgetting<M> for NoForgetting<M> {
    type State = ();

    fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
        Ok(Self::new())
    }

    fn describe(&self, _: &mut dyn FnMut(&'static str, Value<'_>)) {}

    fn start(&self, _: M) {}

    fn is_bounded(&self) -> bool {
        true
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        Bounds { below: None, above: Some(constants.initial.1) }
    }

    #[inline]
    fn form(&self, _: M::Real, _: M::Real) -> Option<Form<M::Real>> {
        Some(Form::NOTHING)
    }

    #[inline]
    fn forget(&self, (): &mut (), _: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        Ok(Forgotten::rank(0).with_factor(1.0))
    }
}
