//! Believes members as far as they are probable, and lets probability drift from one to another.
//!
//! ```text
//! π̂_i ∝ π_i^α                                      between samples: the model may have changed
//! π_i ∝ π̂_i N(y; φθ_i, v_i (1 + s_i))               Gaussian; s_i = φP̄φᵀ, the leverage
//! v_i ← v_i + (e_i²/(1 + s_i) − v_i)/min(k, N)      the noise variance, from member i's own errors
//! w_i = π̂_i
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | α | forgetting | (0, 1] | 0.99 |
//! | N | memory | [1, ∞) | 100 |
//!
//! - The weights are probabilities if one of the members is right and the noise is Gaussian. One gross
//!   error then moves them far: `mlpol` is the sturdier.
//! - Cost: O(K p m) and K logarithms and exponentials. State: 2 K + 1 numbers.
//! - Use it where the probability of each model is itself the result.
//! - Not with gross errors in y.
//!
//! Reference: A. E. Raftery, M. Kárný, P. Ettler, *Online prediction under model uncertainty via
//! dynamic model averaging: application to a cold rolling mill*, Technometrics 52(1), 2010, with the
//! noise variance estimated for each model.

use super::{Forecasts, Mixer};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::state::{is_finite, State, Visitor, MOST_SAMPLES};
use crate::memory::Memory;
use forgetting_kernels::Real;

const FORGETTING: Parameter = Parameter::real(
    "forgetting",
    0.99,
    Range::FRACTION,
    "power to which probabilities are raised between samples: 1 where no model ever takes over",
);
const MEMORY: Parameter = Parameter::real(
    "memory",
    100.0,
    Range::AT_LEAST_ONE,
    "samples over which the noise variance is averaged",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[FORGETTING, MEMORY]);

/// No log-probability is further below the largest than this.
const LEAST: f64 = -60.0;

/// Dynamic model averaging; see [`self`](crate::mixers::dynamic_model_averaging).
#[derive(Clone, Copy, Debug)]
pub struct DynamicModelAveraging<M: Memory> {
    forgetting: M::Real,
    memory: M::Real,
}

/// How probable each member is, and its noise.
#[derive(Clone, Debug)]
pub struct Probabilities<M: Memory> {
    /// ln π, the largest 0
    logarithms: M::Vector,
    /// v
    variances: M::Vector,
    samples: u64,
}

impl<M: Memory> DynamicModelAveraging<M> {
    /// With the power α and the samples N over which the noise variance is averaged.
    ///
    /// # Errors
    /// [`Error::Value`] names the parameter that is out of range.
    pub fn new(forgetting: M::Real, memory: M::Real) -> Result<Self, Error> {
        Ok(Self { forgetting: FORGETTING.check(forgetting)?, memory: MEMORY.check(memory)? })
    }
}

impl<M: Memory> Mixer<M> for DynamicModelAveraging<M> {
    type State = Probabilities<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(FORGETTING.number(values)?, MEMORY.number(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(FORGETTING.name, Value::Real(self.forgetting.to_f64()));
        each(MEMORY.name, Value::Real(self.memory.to_f64()));
    }

    fn start(&self, memory: M) -> Probabilities<M> {
        let (logarithms, variances) = (memory.vector(), memory.vector());
        Probabilities { logarithms, variances, samples: 0 }
    }

    fn weigh(&self, state: &Probabilities<M>, weights: &mut [M::Real]) {
        for (weight, &logarithm) in weights.iter_mut().zip(state.logarithms.as_ref()) {
            *weight = (self.forgetting * logarithm).exp();
        }
    }

    fn learn(&self, state: &mut Probabilities<M>, forecasts: &Forecasts<'_, M::Real>) {
        let (one, half) = (M::Real::ONE, M::Real::from_f64(0.5));
        let width = M::Real::from_f64(forecasts.mixed.len() as f64);
        state.samples += 1;
        let share = one / M::Real::from_f64(state.samples as f64).min(self.memory);
        for i in forecasts.awake() {
            let growth = one + forecasts.leverages[i];
            let normalized: M::Real = {
                let scale = growth.sqrt();
                let error = forecasts.error(i);
                // first so that no square overflows
                error.iter().fold(M::Real::ZERO, |sum, &e| sum + (e / scale) * (e / scale)) / width
            };
            let normalized = normalized.min(M::Real::CEILING);
            let logarithm = &mut state.logarithms.as_mut()[i];
            *logarithm *= self.forgetting;
            let variance = &mut state.variances.as_mut()[i];
            if *variance > M::Real::ZERO {
                let surprise = (*variance).ln() + growth.ln() + normalized / *variance;
                *logarithm -= half * width * surprise;
            }
            *variance += share * (normalized - *variance);
        }
        state.normalize();
    }
}

impl<M: Memory> Probabilities<M> {
    /// The largest logarithm becomes 0, and none is out of sight.
    fn normalize(&mut self) {
        let logarithms = self.logarithms.as_mut();
        let largest = logarithms.iter().fold(logarithms[0], |largest, &x| largest.max(x));
        for logarithm in logarithms {
            *logarithm = (*logarithm - largest).max(M::Real::from_f64(LEAST));
        }
    }
}

impl<M: Memory> State<M::Real> for Probabilities<M> {
    fn visit(&mut self, visitor: &mut dyn Visitor<M::Real>) {
        visitor.reals(self.logarithms.as_mut());
        visitor.reals(self.variances.as_mut());
        visitor.whole(&mut self.samples);
    }

    fn is_sound(&self) -> bool {
        is_finite(self)
            && self.samples <= MOST_SAMPLES
            && self.variances.as_ref().iter().all(|x| *x >= M::Real::ZERO)
            && self.logarithms.as_ref().iter().all(|x| *x <= M::Real::ZERO)
    }
}
