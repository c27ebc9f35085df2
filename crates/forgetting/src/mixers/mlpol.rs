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
//! - Not where the best member changes often: regret is added up since the start, and the weights
//!   turn back slowly.
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
        let count = weights.len();
        let regrets = &state.regrets.as_ref()[..count];
        let squares = &state.squares.as_ref()[..count];
        for i in 0..count {
            let ratio = regrets[i] / squares[i];
            // no branch: where it is not to be used it may be no number
            weights[i] = if regrets[i] > zero && squares[i] > zero { ratio } else { zero };
        }
    }

    // always, so that it is compiled for the number of members that whoever calls it has
    #[inline(always)]
    fn learn(&self, state: &mut Regrets<M>, forecasts: &Forecasts<'_, M::Real>) {
        state.widen(forecasts);
        if state.unit == M::Real::ZERO {
            return;
        }
        // bounded, so that 0 times it is 0
        let per_unit = (M::Real::ONE / state.unit).min(M::Real::CEILING);
        let two = M::Real::from_f64(2.0);
        let (count, width) = (forecasts.awake.len(), forecasts.mixed.len());
        let regrets = &mut state.regrets.as_mut()[..count];
        let squares = &mut state.squares.as_mut()[..count];
        let largest = &mut state.largest.as_mut()[..count];
        let errors = &forecasts.errors[..count * width];
        for i in 0..count {
            if !forecasts.awake[i] {
                continue;
            }
            let mut regret = M::Real::ZERO;
            for j in 0..width {
                let mixed = forecasts.mixed[j];
                let worse = (mixed - errors[i * width + j]) * per_unit;
                regret += two * (mixed * per_unit) * worse;
            }
            let squared = regret * regret;
            let next = largest[i].max(squared);
            regrets[i] += regret;
            squares[i] += squared + (next - largest[i]);
            largest[i] = next;
        }
    }
}

impl<M: Memory> Regrets<M> {
    /// Makes the unit the largest error so far.
    #[inline(always)]
    fn widen(&mut self, forecasts: &Forecasts<'_, M::Real>) {
        let width = forecasts.mixed.len();
        let mut unit = self.unit;
        for (i, &awake) in forecasts.awake.iter().enumerate() {
            for j in 0..width {
                let error = forecasts.errors[i * width + j].abs();
                unit = if awake { unit.max(error) } else { unit };
            }
        }
        if unit > self.unit {
            let ratio = self.unit / unit;
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
