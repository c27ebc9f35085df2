//! Functions of the user's: Python callables that the core asks in the middle of a sample.

use crate::arrays::{shaped, Number};
use crate::errors::{invalid, keep_exception};
use crate::function::Callable;
use forgetting::choice::{Kind, Parameter, Value};
use forgetting::function::{EvidenceFunction, MatrixFunction};
use forgetting::gates::{Answer, GateFunction};
use forgetting::rates::Function;
use forgetting::rules::Forgetting;
use forgetting::saved::AnyEstimator;
use forgetting::{Dynamic, Error};
use forgetting_cpu::Fused;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyType};
use std::any::Any;
use std::sync::Arc;

/// Whether the estimator runs Python code in the middle of a sample.
///
/// Such code may change any array, so that none may be borrowed meanwhile.
pub fn calls_python<T: Number>(estimator: &AnyEstimator<T>) -> bool {
    let (rule, rate) = (estimator.rule(), estimator.rate());
    let has = |parameters: &[Parameter], kind| parameters.iter().any(|p| p.kind == kind);
    let parameters = rule.about().parameters;
    has(rate.about().parameters, Kind::Function)
        || has(estimator.gate().about().parameters, Kind::Function)
        || has(parameters, Kind::Function)
        || has(parameters, Kind::Rule) && {
            let mut found = false;
            rule.describe(&mut |_, value| found |= is_function(value));
            found
        }
}

fn is_function(value: Value<'_>) -> bool {
    match value {
        Value::Function(_) => true,
        Value::Choice { values, .. } => {
            let mut found = false;
            values.each(&mut |_, value| found |= is_function(value));
            found
        }
        _ => false,
    }
}

/// What a callable rate or gate is told of a sample, before the sample is used.
///
/// Errors are whitened by gamma; a rate sees them clipped by the weighting. S is phi @ P @ phi.T, whitened, with
/// the P before forgetting.
///
/// Attributes
/// ----------
/// error : float or ndarray
///     The error; (rows,) or (rows, targets) unless there is one only.
/// squared_error : float
///     Sum of its squares over the rows, averaged over the targets.
/// leverage : float
///     Trace of S: the variance of the prediction in units of the noise variance.
/// normalized_error : float
///     error.T @ inv(I + S) @ error, averaged over the targets.
/// samples : int
///     Samples used so far, without this one.
/// parameters, rows, targets : int
///     Sizes of the estimator.
#[pyclass(frozen, module = "forgetting")]
pub struct Evidence {
    #[pyo3(get)]
    squared_error: f64,
    #[pyo3(get)]
    leverage: f64,
    #[pyo3(get)]
    normalized_error: f64,
    #[pyo3(get)]
    samples: u64,
    #[pyo3(get)]
    parameters: usize,
    #[pyo3(get)]
    rows: usize,
    #[pyo3(get)]
    targets: usize,
    errors: Vec<f64>,
}

#[pymethods]
impl Evidence {
    #[getter]
    fn error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match (self.errors.as_slice(), self.targets) {
            ([error], _) => Ok(PyFloat::new(py, *error).into_any()),
            (errors, 1) => shaped(py, errors.to_vec(), &[self.rows]),
            (errors, targets) => shaped(py, errors.to_vec(), &[self.rows, targets]),
        }
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let Self { squared_error, leverage, samples, .. } = self;
        let error = self.error(py)?.repr()?;
        Ok(format!(
            "Evidence(error={error}, squared_error={squared_error}, leverage={leverage}, \
             samples={samples})"
        ))
    }
}

/// Whether this is a function, not a choice that is made from one.
pub fn is_plain(object: &Bound<'_, PyAny>) -> PyResult<bool> {
    let is_class = object.is_instance_of::<PyType>();
    Ok(object.is_callable()
        && !is_class
        && !(object.hasattr("name")? && object.hasattr("parameters")?))
}

/// The rate that asks `callable` for the forgetting factor of each sample.
pub fn rate<T: Number>(callable: &Bound<'_, PyAny>) -> Function<Dynamic<T>> {
    let asked = callable.clone().unbind();
    Function::new(move |evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>| {
        ask(&asked, evidence, |answer| answer.extract().map(T::from_f64))
    })
    .with_origin(callable.clone().unbind())
}

/// The gate that asks `callable` what to do with each sample.
pub fn gate<T: Number>(callable: &Bound<'_, PyAny>) -> GateFunction<Dynamic<T>> {
    let asked = callable.clone().unbind();
    GateFunction::new(move |evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>| {
        ask(&asked, evidence, answer)
    })
    .with_origin(callable.clone().unbind())
}

/// A gate's answer in Python's words.
fn answer(answer: &Bound<'_, PyAny>) -> PyResult<Answer> {
    let word = answer.extract::<String>().ok();
    word.and_then(|word| Answer::of_word(&word)).ok_or_else(|| {
        invalid(format!("gate answered {answer:?}, allowed: \"update\", \"freeze\", \"hold\""))
    })
}

/// The callable that a function of the core was made from; None if it was not.
pub fn python<'py>(py: Python<'py>, function: &(dyn Any + Send + Sync)) -> Bound<'py, PyAny> {
    let matrix = || function.downcast_ref::<Arc<dyn MatrixFunction>>()?.as_any().downcast_ref();
    let asked = origin::<f64>(function).or_else(|| origin::<f32>(function));
    let asked = asked.or_else(|| origin::<Fused<f64>>(function));
    let asked = asked.or_else(|| origin::<Fused<f32>>(function));
    let rule = matrix().map(|callable: &Callable| callable.object(py));
    asked.map(|callable| callable.bind(py).clone()).or(rule).unwrap_or(py.None().into_bound(py))
}

/// The callable of a rate or a gate in this number type.
fn origin<T: Number>(function: &(dyn Any + Send + Sync)) -> Option<&Py<PyAny>> {
    fn of<T: Number, A: 'static>(function: &(dyn Any + Send + Sync)) -> Option<&Py<PyAny>> {
        function.downcast_ref::<EvidenceFunction<Dynamic<T>, A>>()?.origin().downcast_ref()
    }
    of::<T, T>(function).or_else(|| of::<T, Answer>(function))
}

fn ask<T: Number, A>(
    callable: &Py<PyAny>,
    evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>,
    read: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<A>,
) -> Result<A, Error> {
    let seen = Evidence {
        squared_error: evidence.squared_error.to_f64(),
        leverage: evidence.leverage.to_f64(),
        normalized_error: evidence.normalized_error.to_f64(),
        samples: evidence.samples,
        parameters: evidence.factor.parameters(),
        rows: evidence.rows,
        targets: evidence.targets,
        errors: evidence.errors.iter().map(|error| error.to_f64()).collect(),
    };
    Python::attach(|py| {
        let answer = callable.bind(py).call1((seen,));
        answer.and_then(|answer| read(&answer)).map_err(keep_exception)
    })
}
