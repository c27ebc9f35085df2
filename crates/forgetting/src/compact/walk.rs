//! The rule [`random_walk`](crate::rules::random_walk) where every parameter walks alike: two numbers in
//! the place of a matrix and its root.

use crate::choice::{Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use crate::rules::cycle;
use crate::rules::random_walk::{BOUND, PROCESS_NOISE, SCHEDULE};
use crate::rules::{Forgetting, Forgotten, Step};
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::Real;

/// Adds the same variance to every parameter at each sample, with a bound or without; for
/// [`Compact`](super::Compact).
#[derive(Clone, Copy, Debug)]
pub struct Walk<M: Memory> {
    process_noise: M::Real,
    bound: Option<M::Real>,
}

impl<M: Memory> Walk<M> {
    /// Of this process noise, P staying below `bound`, if there is one.
    ///
    /// # Errors
    /// [`Error::Value`] names the bound unless it is above the process noise and in range.
    pub(super) fn new(process_noise: M::Real, bound: Option<M::Real>) -> Result<Self, Error> {
        match bound {
            Some(bound) if !(bound > process_noise && bound <= M::Real::CEILING) => {
                let allowed = "above process_noise, within the number type's range";
                Err(Error::value(BOUND.name, bound.to_f64(), allowed))
            }
            bound => Ok(Self { process_noise, bound }),
        }
    }
}

impl<M: Memory> Forgetting<M> for Walk<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        let process_noise = PROCESS_NOISE.number(values)?;
        if cycle::is_cyclic(&SCHEDULE, values)? {
            let reason = "a compact estimator adds its process noise at every sample";
            return Err(Error::Unsupported { reason });
        }
        let bound = match values.get(BOUND.name) {
            None => None,
            Some(_) => Some(BOUND.number(values)?),
        };
        Self::new(process_noise, bound)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(PROCESS_NOISE.name, Value::Real(self.process_noise.to_f64()));
        if let Some(bound) = self.bound {
            each(BOUND.name, Value::Real(bound.to_f64()));
        }
        each(SCHEDULE.name, cycle::word(false));
    }

    fn start(&self, _: M) {}

    fn is_bounded(&self) -> bool {
        self.bound.is_some()
    }

    /// So many steps after the last sample: see [`Pace`](super::Pace).
    #[inline]
    fn form(&self, _: M::Real, steps: M::Real) -> Option<Form<M::Real>> {
        let noise = self.process_noise * steps;
        let walks = noise >= M::Real::FLOOR || (noise > M::Real::ZERO && self.bound.is_none());
        let per_bound = self.bound.map_or(M::Real::ZERO, |bound| M::Real::ONE / bound);
        if walks {
            return Some(Form::Walk { noise, per_bound });
        }
        // no time has passed, or too little for numbers to show
        (steps < M::Real::ONE).then_some(Form::NOTHING)
    }

    fn forget(&self, (): &mut (), _: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        Err(Error::Unsupported { reason: "this rule is for compact estimators" })
    }
}
