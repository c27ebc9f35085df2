//! Asks a function of yours what to do with each sample.
//!
//! ```text
//! update, freeze or hold = f(evidence of sample k)
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | f | function | a function of the evidence that answers `update`, `freeze` or `hold` | |
//!
//! - The function sees the whitened errors, not clipped by the weighting, and what P says of the
//!   sample, before anything is forgotten.
//! - Any other answer, or a failure of the function, refuses the sample: the estimator is as it
//!   was, bit for bit. A function that remembers has then still seen the sample.
//! - Cost: the function, and O(p n²/2 + p² n) for what it is shown. State: none that is saved; an
//!   estimator with a function cannot be.
//! - Use it for what you know and the record does not say: a valve that is shut, a sensor that
//!   saturates.
//! - Not where speed counts: the function is called at every sample.

use super::{Answer, Gate};
use crate::choice::function::EvidenceFunction;
use crate::choice::{About, Kind, Parameter, Range, Value, Values};
use crate::sample::{Evidence, Needs};
use crate::error::Error;
use crate::memory::Memory;

const FUNCTION: Parameter = Parameter::elements(
    "function",
    Kind::Function,
    1.0,
    Range::FINITE,
    "function of the evidence of a sample that answers update, freeze or hold",
)
.required();

/// The registry entry.
pub const ABOUT: About = About::new(&[FUNCTION]);

/// An answer from a function; see [`self`](crate::gates::gate_function).
///
/// ```
/// use forgetting::gates::{Answer, AnyGate, GateFunction};
/// use forgetting::{Constant, Equal, Estimator, Exponential, Fixed, Prior};
///
/// let memory = Fixed::<f64, 1>::new();
/// let gate = GateFunction::<Fixed<f64, 1>>::new(|evidence| {
///     Ok(if evidence.errors[0].abs() > 100.0 { Answer::Hold } else { Answer::Update })
/// });
/// let mut estimator = Estimator::new(
///     Exponential::new(),
///     Constant::new(0.9)?,
///     Equal::new(),
///     Prior::scalar(memory, 100.0)?,
/// )
/// .with_gate(AnyGate::GateFunction(gate));
/// assert_eq!(estimator.update(&[1.0], &[1e6])?.gate, Answer::Hold);
/// # Ok::<(), forgetting::Error>(())
/// ```
pub type GateFunction<M> = EvidenceFunction<M, Answer>;

impl<M: Memory> Gate<M> for GateFunction<M> {
    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::from_values(&FUNCTION, values)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(FUNCTION.name, Value::Function(self));
    }

    fn needs(&self) -> Needs {
        Needs::NormalizedError
    }

    #[inline]
    fn answer(&self, evidence: &Evidence<'_, '_, M>) -> Result<Answer, Error> {
        self.ask(evidence)
    }
}
