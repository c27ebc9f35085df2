//! Functions of the user's: Python callables that the core asks in the middle of a sample.

use crate::arrays::{shaped, Number};
use crate::errors::keep_exception;
use crate::function::Callable;
use forgetting::function::MatrixFunction;
use forgetting::parameter::{Kind, Parameter, Value};
use forgetting::rates::Function;
use forgetting::rules::Forgetting;
use forgetting::saved::AnyEstimator;
use forgetting::{Dynamic, Error};
use forgetting_cpu::Fused;
use pyo3::prelude::*;
use pyo3::types::PyFloat;
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

/// What a callable rate is told of a sample, before the sample is used.
///
/// Errors are whitened by gamma and clipped by the weighting. S is phi @ P @ phi.T, whitened, with
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

/// The rate that asks `callable` for the forgetting factor of each sample.
pub fn rate<T: Number>(callable: &Bound<'_, PyAny>) -> Function<Dynamic<T>> {
    let asked = callable.clone().unbind();
    Function::new(move |evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>| ask(&asked, evidence))
        .with_origin(callable.clone().unbind())
}

/// The callable that a function of the core was made from; None if it was not.
pub fn python<'py>(py: Python<'py>, function: &(dyn Any + Send + Sync)) -> Bound<'py, PyAny> {
    fn origin<T: Number>(function: &(dyn Any + Send + Sync)) -> Option<&Py<PyAny>> {
        function.downcast_ref::<Function<Dynamic<T>>>()?.origin().downcast_ref()
    }
    let matrix = || function.downcast_ref::<Arc<dyn MatrixFunction>>()?.as_any().downcast_ref();
    let plain = origin::<f64>(function).or_else(|| origin::<f32>(function));
    let fused = || origin::<Fused<f64>>(function).or_else(|| origin::<Fused<f32>>(function));
    let rate = plain.or_else(fused);
    let rule = matrix().map(|callable: &Callable| callable.object(py));
    rate.map(|callable| callable.bind(py).clone()).or(rule).unwrap_or(py.None().into_bound(py))
}

fn ask<T: Number>(
    callable: &Py<PyAny>,
    evidence: &forgetting::Evidence<'_, '_, Dynamic<T>>,
) -> Result<T, Error> {
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
        let answer = callable.call1(py, (seen,)).and_then(|answer| answer.extract::<f64>(py));
        answer.map(T::from_f64).map_err(keep_exception)
    })
}
