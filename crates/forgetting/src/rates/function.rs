//! Asks a function of yours for the factor of each sample.
//!
//! ```text
//! λ_k = f(evidence of sample k)
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | f | function | a function of the evidence, with values in (0, 1] | |
//!
//! - Uses this sample: the function sees the whitened, clipped errors and what P says of the
//!   sample, before it is used.
//! - A value outside (0, 1], or a failure of the function, refuses the sample: the estimator is as
//!   it was, bit for bit. A function that remembers has then still seen the sample.
//! - Cost: the function, and O(p n²/2 + p² n) for what it is shown. State: none that is saved; an
//!   estimator with a function cannot be.
//! - Use it for a design of your own. One that is to be saved, or to run without an interpreter, is
//!   better a rate.
//! - Not where speed counts: the function is called at every sample.

use super::{Evidence, Needs, Rate};
use crate::choice::function::EvidenceFunction;
use crate::choice::{About, Kind, Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;

const FUNCTION: Parameter = Parameter::elements(
    "function",
    Kind::Function,
    1.0,
    Range::FRACTION,
    "function of the evidence of a sample that gives its forgetting factor",
)
.required();

/// The registry entry.
pub const ABOUT: About = About::new(&[FUNCTION]);

/// λ from a function; see [`self`](crate::rates::function).
///
/// ```
/// use forgetting::rates::Function;
/// use forgetting::{Equal, Estimator, Exponential, Fixed, Prior};
///
/// let memory = Fixed::<f64, 1>::new();
/// let fast_at_first = Function::new(|evidence| Ok(if evidence.samples < 10 { 0.9 } else { 0.99 }));
/// let prior = Prior::scalar(memory, 100.0)?;
/// let mut estimator = Estimator::new(Exponential::new(), fast_at_first, Equal::new(), prior);
/// assert_eq!(estimator.update(&[1.0], &[2.0])?.forgetting_factor, 0.9);
/// # Ok::<(), forgetting::Error>(())
/// ```
pub type Function<M> = EvidenceFunction<M, <M as Memory>::Real>;

impl<M: Memory> Rate<M> for Function<M> {
    type State = ();

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::from_values(&FUNCTION, values)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(FUNCTION.name, Value::Function(self));
    }

    fn start(&self, _: M) {}

    fn needs(&self) -> Needs {
        Needs::NormalizedError
    }

    #[inline]
    fn forgetting_factor(&self, (): &(), evidence: &Evidence<'_, '_, M>) -> Result<M::Real, Error> {
        self.ask(evidence)
    }
}

#[cfg(test)]
mod tests {
    use super::Function;
    use crate::choice::Defaults;
    use crate::choice::{Value, Values};
    use crate::rates::{AnyRate, Rate};
    use crate::rules::Rule;
    use crate::saved::AnyEstimator;
    use crate::weightings::AnyWeighting;
    use crate::covariance::Prior;
    use crate::error::Error;
    use crate::estimator::Estimator;
    use crate::memory::Dynamic;

    fn estimator(function: Function<Dynamic<f64>>) -> AnyEstimator<f64> {
        let memory = Dynamic::new(1, 1, 1).unwrap();
        let rule = Rule::named("exponential", &Defaults, memory).unwrap();
        let weighting = AnyWeighting::named("equal", &Defaults, memory).unwrap();
        let prior = Prior::scalar(memory, 3.0).unwrap();
        Estimator::new(rule, AnyRate::Function(function), weighting, prior)
    }

    #[test]
    fn sees_the_evidence() {
        let mut estimator = estimator(Function::new(|evidence| {
            assert_eq!((evidence.squared_error, evidence.leverage), (4.0, 3.0));
            assert_eq!((evidence.normalized_error, evidence.errors), (1.0, &[2.0][..]));
            Ok(0.5)
        }));
        assert_eq!(estimator.update(&[1.0], &[2.0]).unwrap().forgetting_factor, 0.5);
    }

    #[test]
    fn its_failure_and_a_bad_value_refuse_the_sample() {
        let failure = Error::Function { parameter: "forgetting_factor" };
        for answer in [Err(failure), Ok(0.0), Ok(1.5), Ok(f64::NAN)] {
            let mut estimator = estimator(Function::new(move |_| answer));
            let refused = estimator.update(&[1.0], &[2.0]).unwrap_err();
            assert!(answer.is_ok() || refused == failure);
            assert_eq!((estimator.theta()[0], estimator.samples()), (0.0, 0));
            assert_eq!(estimator.factor().diagonal_elements(), [3.0]);
        }
    }

    #[test]
    fn is_found_by_name_and_cannot_be_saved() {
        struct Given(Function<Dynamic<f64>>);
        impl Values for Given {
            fn get(&self, _: &str) -> Option<Value<'_>> {
                Some(Value::Function(&self.0))
            }
        }
        let given = Given(Function::new(|_| Ok(0.5)).with_origin(7));
        let memory = Dynamic::new(1, 1, 1).unwrap();
        let rate = AnyRate::named("function", &given, memory).unwrap();
        rate.describe(&mut |_, value| {
            let Value::Function(function) = value else { panic!("{value:?}") };
            let function = function.downcast_ref::<Function<Dynamic<f64>>>().unwrap();
            assert_eq!(function.origin().downcast_ref(), Some(&7));
        });
        let AnyRate::Function(function) = rate else { panic!("{rate:?}") };
        let refused = estimator(function).to_bytes();
        assert!(matches!(refused, Err(Error::Unsupported { .. })));
    }
}
