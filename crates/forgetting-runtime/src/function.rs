//! Functions of the user's, written in any language, that are called in the middle of a sample.

use crate::number::Number;
use crate::update::Innovation;
use forgetting::choice::function::{Argument, EvidenceFunction, MatrixFunction};
use forgetting::gates::GateFunction;
use forgetting::{rates, Answer, Dynamic, Error};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// A function of the user's. It is called by the method that fits the parameter it was given for.
///
/// Each method returns [`Error::Function`] when the function failed; the sample is then refused.
pub trait Function: Debug + Send + Sync {
    /// From matrices to a matrix: calls `put` with the position, row by row, and the value of each
    /// of the rows x columns elements of the result.
    ///
    /// # Errors
    /// When it failed, or its result has another shape.
    fn matrix(
        &self,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<(), Error>;

    /// The forgetting factor of a sample, in (0, 1].
    ///
    /// # Errors
    /// When it failed, or its result is not a number.
    fn forgetting_factor(&self, evidence: &Evidence) -> Result<f64, Error>;

    /// Whether a sample is used.
    ///
    /// # Errors
    /// When it failed, or its result is not an answer.
    fn gate(&self, evidence: &Evidence) -> Result<Answer, Error>;

    /// The function with its own type, for the interface that made it.
    fn as_any(&self) -> &dyn Any;
}

/// What a function judges a sample by, before the sample is used.
///
/// Errors are whitened by Γ; a rate sees them clipped by the weighting. S is φPφᵀ, whitened, with
/// the P before forgetting.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// the error
    pub error: Innovation,
    /// sum of its squares over the rows, averaged over the targets
    pub squared_error: f64,
    /// tr S: the variance of the prediction in units of the noise variance
    pub leverage: f64,
    /// eᵀ(I + S)⁻¹e, averaged over the targets
    pub normalized_error: f64,
    /// samples used so far, without this one
    pub samples: u64,
    /// n
    pub parameters: usize,
    /// p
    pub rows: usize,
    /// m
    pub targets: usize,
}

impl Evidence {
    fn of<T: Number>(evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>) -> Self {
        let &forgetting::Evidence { rows, targets, samples, .. } = evidence;
        Self {
            error: Innovation::new(evidence.errors, targets),
            squared_error: evidence.squared_error.to_f64(),
            leverage: evidence.leverage.to_f64(),
            normalized_error: evidence.normalized_error.to_f64(),
            samples,
            parameters: evidence.factor.parameters(),
            rows,
            targets,
        }
    }
}

/// A function of the user's as a rule takes it.
#[derive(Debug)]
struct ForRule(Arc<dyn Function>);

impl MatrixFunction for ForRule {
    fn call(
        &self,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<(), Error> {
        self.0.matrix(arguments, shape, put)
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

/// A function in the type that a parameter of the core takes.
pub(crate) type CoreFunction = Box<dyn Any + Send + Sync>;

/// `function` as a parameter of a rule.
pub(crate) fn for_rule(function: &Arc<dyn Function>) -> CoreFunction {
    let function: Arc<dyn MatrixFunction> = Arc::new(ForRule(Arc::clone(function)));
    Box::new(function)
}

/// `function` as the parameter of a rate.
pub(crate) fn for_rate<T: Number>(function: &Arc<dyn Function>) -> CoreFunction {
    let (function, origin) = (Arc::clone(function), Arc::clone(function));
    let call = move |evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>| {
        function.forgetting_factor(&Evidence::of(evidence)).map(T::from_f64)
    };
    Box::new(rates::Function::<Dynamic<T>>::new(call).with_origin(origin))
}

/// `function` as the parameter of a gate.
pub(crate) fn for_gate<T: Number>(function: &Arc<dyn Function>) -> CoreFunction {
    let (function, origin) = (Arc::clone(function), Arc::clone(function));
    let call = move |evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>| {
        function.gate(&Evidence::of(evidence))
    };
    Box::new(GateFunction::<Dynamic<T>>::new(call).with_origin(origin))
}

/// The function of the user's that [`for_rule`], [`for_rate`] or [`for_gate`] made `function` of.
pub(crate) fn original<T: Number>(function: &(dyn Any + Send + Sync)) -> Option<Arc<dyn Function>> {
    if let Some(matrix) = function.downcast_ref::<Arc<dyn MatrixFunction>>() {
        return matrix.as_any().downcast_ref::<ForRule>().map(|rule| Arc::clone(&rule.0));
    }
    let rate = function.downcast_ref::<EvidenceFunction<Dynamic<T>, T>>().map(|f| f.origin());
    let gate = || function.downcast_ref::<EvidenceFunction<Dynamic<T>, Answer>>();
    rate.or_else(|| gate().map(|f| f.origin()))?.downcast_ref::<Arc<dyn Function>>().cloned()
}
