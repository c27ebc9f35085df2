//! Believes members in proportion to how much better than the mixture they have been, with nothing to tune.
//!
//! ```text
//! r_i = 2 e (e − e_i)                    how much following member i more would have helped
//! R_i ← R_i + r_i                        regret of not having followed it
//! B⁺ = max(B_i, r_i²),  S_i ← S_i + r_i² + B⁺ − B_i,  B_i ← B⁺
//! w_i ∝ π_i max(R_i, 0)/S_i              w_i ∝ π_i while no regret is positive
//! π_i = q^i                              the weights beforehand, i = 0 for the first member
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | q | prior_ratio | (0, 1] | 1; 0.93 for the default members of a bank |
//!
//! e is the error of the mixture and e_i that of member i; for several rows and targets the products
//! are sums over them.
//!
//! - After T samples the sum of squared errors of the mixture exceeds that of member i by at most the
//!   root of (1 + ln T) S_i Σπ/π_i, whatever the samples are; with q = 1 the same with K max S_i holds for
//!   every fixed convex combination of the K members.
//! - Weights beforehand are for members in an order. The slowest of those that are there by default
//!   comes first: where nothing changes, members that forget more than need be are given up sooner.
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
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::state::{is_finite, State, Visitor};
use crate::memory::Memory;
use forgetting_kernels::Real;

const PRIOR_RATIO: Parameter = Parameter::real(
    "prior_ratio",
    1.0,
    Range::FRACTION,
    "weight beforehand of each member over that of the one before it: 1 for all alike",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[PRIOR_RATIO]);

/// Polynomially weighted averages with a learning rate a member; see [`self`](crate::mixers::mlpol).
#[derive(Clone, Debug)]
pub struct Mlpol<M: Memory> {
    prior_ratio: M::Real,
    /// π
    priors: M::Vector,
}

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

impl<M: Memory> Mlpol<M> {
    /// With the ratio q of the weights beforehand, for the members that `memory` counts.
    ///
    /// # Errors
    /// [`Error::Value`] unless `prior_ratio` is in (0, 1].
    pub fn new(prior_ratio: M::Real, memory: M) -> Result<Self, Error> {
        let prior_ratio = PRIOR_RATIO.check(prior_ratio)?;
        let mut priors = memory.vector();
        let mut next = M::Real::ONE;
        for prior in priors.as_mut() {
            *prior = next;
            next *= prior_ratio;
        }
        Ok(Self { prior_ratio, priors })
    }
}

impl<M: Memory> Mixer<M> for Mlpol<M> {
    type State = Regrets<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        Self::new(PRIOR_RATIO.number(values)?, memory)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(PRIOR_RATIO.name, Value::Real(self.prior_ratio.to_f64()));
    }

    fn start(&self, memory: M) -> Regrets<M> {
        let (regrets, squares, largest) = (memory.vector(), memory.vector(), memory.vector());
        Regrets { regrets, squares, largest, unit: M::Real::ZERO }
    }

    fn weigh(&self, state: &Regrets<M>, weights: &mut [M::Real]) {
        let zero = M::Real::ZERO;
        let count = weights.len();
        let regrets = &state.regrets.as_ref()[..count];
        let squares = &state.squares.as_ref()[..count];
        let priors = &self.priors.as_ref()[..count];
        let mut positive = false;
        for i in 0..count {
            let ratio = priors[i] * (regrets[i] / squares[i]);
            // no branch: where it is not to be used it may be no number
            let is_positive = (regrets[i] > zero) & (squares[i] > zero);
            weights[i] = if is_positive { ratio } else { zero };
            positive |= is_positive;
        }
        if !positive {
            weights.copy_from_slice(priors);
        }
    }

    // always, so that it is compiled for the number of members that whoever calls it has
    #[inline(always)]
    fn learn(&self, state: &mut Regrets<M>, forecasts: &Forecasts<'_, M::Real>) {
        if let ([mixed], true) = (forecasts.mixed, forecasts.are_all_awake()) {
            return state.learn_one(*mixed, forecasts.errors);
        }
        let each = forecasts.errors.chunks_exact(forecasts.mixed.len()).zip(forecasts.awake);
        let awake = each.clone().filter(|(_, &awake)| awake).flat_map(|(errors, _)| errors);
        state.widen(awake.fold(M::Real::ZERO, |largest, e| largest.max(e.abs())));
        let per_unit = state.per_unit();
        for (own, (errors, _)) in state.each().zip(each).filter(|(_, (_, &awake))| awake) {
            let pairs = forecasts.mixed.iter().zip(errors);
            own.add(pairs.fold(M::Real::ZERO, |sum, (&mixed, &e)| sum + regret(mixed, e, per_unit)));
        }
    }
}

/// 2 e (e − e_i) in the unit of which this is the reciprocal
#[inline(always)]
fn regret<T: Real>(mixed: T, error: T, per_unit: T) -> T {
    let scaled = mixed * per_unit;
    (scaled + scaled) * ((mixed - error) * per_unit)
}

/// What is remembered of a member.
struct Own<'a, T> {
    regret: &'a mut T,
    squares: &'a mut T,
    largest: &'a mut T,
}

impl<T: Real> Own<'_, T> {
    #[inline(always)]
    fn add(self, regret: T) {
        let squared = regret * regret;
        let next = self.largest.max(squared);
        *self.regret += regret;
        *self.squares += squared + (next - *self.largest);
        *self.largest = next;
    }
}

impl<M: Memory> Regrets<M> {
    #[inline(always)]
    fn each(&mut self) -> impl Iterator<Item = Own<'_, M::Real>> {
        let (regrets, squares) = (self.regrets.as_mut().iter_mut(), self.squares.as_mut());
        let each = regrets.zip(squares).zip(self.largest.as_mut());
        each.map(|((regret, squares), largest)| Own { regret, squares, largest })
    }

    /// Learns from one error of each member, none of which is asleep.
    #[inline(always)]
    fn learn_one(&mut self, mixed: M::Real, errors: &[M::Real]) {
        let (fours, rest) = errors.as_chunks::<4>();
        // four side by side, so that fewer wait for each other
        let mut parts = [self.unit; 4];
        for four in fours {
            for j in 0..4 {
                parts[j] = parts[j].max(four[j].abs());
            }
        }
        for (part, e) in parts.iter_mut().zip(rest) {
            *part = part.max(e.abs());
        }
        self.widen(parts[0].max(parts[1]).max(parts[2].max(parts[3])));
        let per_unit = self.per_unit();
        for (own, &e) in self.each().zip(errors) {
            own.add(regret(mixed, e, per_unit));
        }
    }

    /// Bounded, so that 0 times it is 0.
    #[inline(always)]
    fn per_unit(&self) -> M::Real {
        (M::Real::ONE / self.unit).min(M::Real::CEILING)
    }

    /// Makes `largest`, the largest error of a sample, the unit if it is larger than all before.
    #[inline(always)]
    fn widen(&mut self, largest: M::Real) {
        if largest > self.unit {
            let ratio = self.unit / largest;
            let squared = ratio * ratio;
            self.regrets.as_mut().iter_mut().for_each(|r| *r *= squared);
            for sum in self.squares.as_mut().iter_mut().chain(self.largest.as_mut()) {
                *sum = *sum * squared * squared;
            }
            self.unit = largest;
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
        let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
        let mixer = Mlpol::new(1.0, memory).unwrap();
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
        let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
        let mixer = Mlpol::new(1.0, memory).unwrap();
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
