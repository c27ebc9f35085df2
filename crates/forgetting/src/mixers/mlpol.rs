//! Believes members in proportion to how much better than the mixture they have been, with nothing to tune.
//!
//! ```text
//! r_i = 2 e (e − e_i)                    how much following member i more would have helped
//! R_i ← R_i + r_i                        regret of not having followed it
//! B⁺ = max(B_i, r_i²),  S_i ← S_i + r_i² + B⁺ − B_i,  B_i ← B⁺
//! w_i ∝ max(R_i, 0)/S_i                  all alike while no regret is positive
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//!
//! e is the error of the mixture and e_i that of member i; for several rows and targets the products
//! are sums over them.
//!
//! - After T samples the squared error of the mixture exceeds that of the best fixed convex
//!   combination of the K members by at most the root of K (1 + ln T) times the largest S_i, whatever
//!   the samples are.
//! - It has no unit: errors are taken in units of the largest so far.
//! - A member that has always been worse than the mixture has weight 0, and costs nothing.
//! - Cost: O(K p m). State: 3 K + 1 numbers.
//! - Use it first: it is the default mixer.
//!
//! Reference: P. Gaillard, G. Stoltz, T. van Erven, *A second-order bound with excess losses*,
//! Proceedings of the 27th Conference on Learning Theory, 2014 (ML-Poly).

use super::{Forecasts, Mixer};
use crate::choice::{About, Value, Values};
use crate::error::Error;
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use core::marker::PhantomData;
use forgetting_kernels::Real;

/// The registry entry.
pub const ABOUT: About = About::new(&[]);

/// Polynomially weighted averages with a learning rate a member; see [`self`](crate::mixers::mlpol).
#[derive(Clone, Copy, Debug, Default)]
pub struct Mlpol<M>(PhantomData<M>);

/// What each member has been worth.
#[derive(Clone, Debug)]
pub struct Regrets<M: Memory> {
    /// R, in units of `unit`²
    regrets: M::Vector,
    /// S, in units of `unit`⁴
    squares: M::Vector,
    /// B
    largest: M::Vector,
    /// the largest error so far
    unit: M::Real,
}

impl<M> Mlpol<M> {
    /// The mixer.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<M: Memory> Mixer<M> for Mlpol<M> {
    type State = Regrets<M>;

    fn configure(_: &dyn Values, _: M) -> Result<Self, Error> {
        Ok(Self::new())
    }

    fn describe(&self, _: &mut dyn FnMut(&'static str, Value<'_>)) {}

    fn start(&self, memory: M) -> Regrets<M> {
        let (regrets, squares, largest) = (memory.vector(), memory.vector(), memory.vector());
        Regrets { regrets, squares, largest, unit: M::Real::ZERO }
    }

    fn weigh(&self, state: &Regrets<M>, weights: &mut [M::Real]) {
        let zero = M::Real::ZERO;
        let parts = state.regrets.as_ref().iter().zip(state.squares.as_ref());
        for (weight, (&regret, &square)) in weights.iter_mut().zip(parts) {
            *weight = if regret > zero && square > zero { regret / square } else { zero };
        }
    }

    fn learn(&self, state: &mut Regrets<M>, forecasts: &Forecasts<'_, M::Real>) {
        state.widen(forecasts);
        if state.unit == M::Real::ZERO {
            return;
        }
        let (unit, two) = (state.unit, M::Real::from_f64(2.0));
        for i in forecasts.awake() {
            let parts = forecasts.mixed.iter().zip(forecasts.error(i));
            let regret = parts.fold(M::Real::ZERO, |sum, (&mixed, &own)| {
                sum + two * (mixed / unit) * ((mixed - own) / unit)
            });
            let largest = &mut state.largest.as_mut()[i];
            let next = largest.max(regret * regret);
            state.regrets.as_mut()[i] += regret;
            state.squares.as_mut()[i] += regret * regret + (next - *largest);
            *largest = next;
        }
    }
}

impl<M: Memory> Regrets<M> {
    /// Makes the unit the largest error so far.
    fn widen(&mut self, forecasts: &Forecasts<'_, M::Real>) {
        let own = forecasts.awake().flat_map(|i| forecasts.error(i));
        let unit = own.fold(self.unit, |largest, e| largest.max(e.abs()));
        let ratio = self.unit / unit;
        if unit > self.unit {
            let squared = ratio * ratio;
            self.regrets.as_mut().iter_mut().for_each(|r| *r *= squared);
            for sum in self.squares.as_mut().iter_mut().chain(self.largest.as_mut()) {
                *sum = *sum * squared * squared;
            }
            self.unit = unit;
        }
    }
}

impl<M: Memory> State<M::Real> for Regrets<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        for numbers in [&mut self.regrets, &mut self.squares, &mut self.largest] {
            visitor.reals(numbers.as_mut());
        }
        visitor.reals(core::slice::from_mut(&mut self.unit));
    }

    fn is_sound(&self) -> bool {
        let sums = self.squares.as_ref().iter().chain(self.largest.as_ref());
        is_finite(self) && self.unit >= M::Real::ZERO && sums.into_iter().all(|x| *x >= M::Real::ZERO)
    }
}

#[cfg(test)]
mod tests {
    use super::Mlpol;
    use crate::memory::Dynamic;
    use crate::mixers::{Forecasts, Mixer};

    /// Errors 3 and 1 of two members of equal weight: e = 2, r = (−4, 4), S = 2 r².
    #[test]
    fn one_step_by_hand() {
        let (mixer, memory) = (Mlpol::<Dynamic<f64>>::new(), Dynamic::new(2, 1, 1).unwrap());
        let mut state = mixer.start(memory);
        let forecasts = Forecasts {
            errors: &[3.0, 1.0],
            mixed: &[2.0],
            leverages: &[0.0; 2],
            awake: &[true; 2],
        };
        mixer.learn(&mut state, &forecasts);
        let unit = 9.0;
        assert!((state.regrets[0] * unit + 4.0).abs() < 1e-14);
        assert!((state.squares[1] * unit * unit - 32.0).abs() < 1e-13);
        let mut weights = [0.0; 2];
        mixer.weigh(&state, &mut weights);
        assert!(weights[0] == 0.0 && weights[1] > 0.0);
    }

    #[test]
    fn a_member_that_sleeps_is_not_judged() {
        let (mixer, memory) = (Mlpol::<Dynamic<f64>>::new(), Dynamic::new(2, 1, 1).unwrap());
        let mut state = mixer.start(memory);
        let forecasts = Forecasts {
            errors: &[f64::NAN, 1.0],
            mixed: &[1.0],
            leverages: &[0.0; 2],
            awake: &[false, true],
        };
        mixer.learn(&mut state, &forecasts);
        assert_eq!((state.regrets[0], state.squares[0]), (0.0, 0.0));
    }
}
