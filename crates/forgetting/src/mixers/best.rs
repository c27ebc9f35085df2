//! Believes the member with the smallest discounted sum of squared errors, and no other.
//!
//! ```text
//! s_i ← α s_i + e_i²                 w_i = 1 for the smallest s_i, shared where several are
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | α | discount | (0, 1] | 0.99 |
//!
//! - Cost: O(K p m). State: K numbers.
//! - Use it to see which member fits when. As a predictor it jumps from member to member where two
//!   are alike: `mlpol` is seldom worse.
//! - Not to predict, where members are alike.
//!
//! Reference: the rule of follow the leader; N. Cesa-Bianchi, G. Lugosi, *Prediction, Learning, and
//! Games*, Cambridge University Press, 2006.

use super::{Forecasts, Mixer};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::dot;
use forgetting_kernels::Real;

const DISCOUNT: Parameter = Parameter::real(
    "discount",
    0.99,
    Range::FRACTION,
    "what past errors are multiplied with at each sample",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[DISCOUNT]);

/// Follows the leader; see [`self`](crate::mixers::best).
#[derive(Clone, Copy, Debug)]
pub struct Best<M: Memory> {
    discount: M::Real,
}

/// The discounted sum of squared errors of each member.
#[derive(Clone, Debug)]
pub struct Losses<M: Memory>(M::Vector);

impl<M: Memory> Best<M> {
    /// With the discount α.
    ///
    /// # Errors
    /// [`Error::Value`] unless `discount` is in (0, 1].
    pub fn new(discount: M::Real) -> Result<Self, Error> {
        Ok(Self { discount: DISCOUNT.check(discount)? })
    }
}

impl<M: Memory> Mixer<M> for Best<M> {
    type State = Losses<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(DISCOUNT.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(DISCOUNT.name, Value::Real(self.discount.to_f64()));
    }

    fn start(&self, memory: M) -> Losses<M> {
        Losses(memory.vector())
    }

    fn weigh(&self, losses: &Losses<M>, weights: &mut [M::Real]) {
        let losses = losses.0.as_ref();
        let least = losses.iter().fold(losses[0], |least, &x| least.min(x));
        for (weight, &loss) in weights.iter_mut().zip(losses) {
            *weight = if loss == least { M::Real::ONE } else { M::Real::ZERO };
        }
    }

    fn learn(&self, losses: &mut Losses<M>, forecasts: &Forecasts<'_, M::Real>) {
        // the square of the largest error that a sample may have
        let most = M::Real::CEILING * M::Real::CEILING;
        for i in forecasts.awake() {
            let (loss, error) = (&mut losses.0.as_mut()[i], forecasts.error(i));
            *loss = (self.discount * *loss + dot(error, error)).min(most);
        }
    }
}

impl<M: Memory> State<M::Real> for Losses<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.0.as_mut());
    }

    fn is_sound(&self) -> bool {
        is_finite(self) && self.0.as_ref().iter().all(|x| *x >= M::Real::ZERO)
    }
}
