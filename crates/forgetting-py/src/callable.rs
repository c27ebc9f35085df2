//! Functions of the user's: Python callables that are called in the middle of a sample.

use crate::arrays::{innovation, output, Input};
use crate::errors::{invalid, keep_exception};
use forgetting_runtime::{
    Answer, Argument, Array, CoreError, Elements, Function, NumberType, Numbers,
};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use std::any::Any;

/// What a callable rate or gate judges a sample by, before the sample is used.
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
pub struct Evidence(forgetting_runtime::Evidence);

#[pymethods]
impl Evidence {
    #[getter]
    fn error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        innovation(py, &self.0.error)
    }

    #[getter]
    fn squared_error(&self) -> f64 {
        self.0.squared_error
    }

    #[getter]
    fn leverage(&self) -> f64 {
        self.0.leverage
    }

    #[getter]
    fn normalized_error(&self) -> f64 {
        self.0.normalized_error
    }

    #[getter]
    fn samples(&self) -> u64 {
        self.0.samples
    }

    #[getter]
    fn parameters(&self) -> usize {
        self.0.parameters
    }

    #[getter]
    fn rows(&self) -> usize {
        self.0.rows
    }

    #[getter]
    fn targets(&self) -> usize {
        self.0.targets
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let forgetting_runtime::Evidence { squared_error, leverage, samples, .. } = self.0;
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

/// A callable as the value of a parameter.
#[derive(Debug)]
pub struct Callable {
    parameter: String,
    callable: Py<PyAny>,
}

impl Callable {
    /// `callable` as the value of `parameter`.
    pub fn new(parameter: &str, callable: &Bound<'_, PyAny>) -> Self {
        Self { parameter: parameter.into(), callable: callable.clone().unbind() }
    }

    /// The callable that `function` is; None if it is none.
    pub fn object<'py>(py: Python<'py>, function: &dyn Function) -> Bound<'py, PyAny> {
        let callable = function.as_any().downcast_ref::<Self>();
        callable.map_or(py.None().into_bound(py), |own| own.callable.bind(py).clone())
    }

    fn evaluate(
        &self,
        py: Python<'_>,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> PyResult<()> {
        let array = |a: &Argument<'_>| {
            let elements = (0..a.rows * a.columns).map(a.elements).collect();
            output(py, Array { shape: vec![a.rows, a.columns], elements: Elements::F64(elements) })
        };
        let arguments: PyResult<Vec<_>> = arguments.iter().map(array).collect();
        let result = self.callable.bind(py).call1(PyTuple::new(py, arguments?)?)?;
        let name = format!("the result of {}", self.parameter);
        let result = Input::read(&name, &result, NumberType::F64)?;
        if result.shape() != [shape.0, shape.1] {
            let found = result.shape();
            return Err(invalid(format!("{name} has shape {found:?}, expected {shape:?}")));
        }
        if let Numbers::F64(numbers) = result.numbers()? {
            numbers.iter().enumerate().for_each(|(k, &x)| put(k, x));
        }
        Ok(())
    }

    /// Calls it with the evidence of a sample and reads its answer.
    fn ask<A>(
        &self,
        evidence: &forgetting_runtime::Evidence,
        read: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<A>,
    ) -> Result<A, CoreError> {
        Python::attach(|py| {
            let answer = self.callable.bind(py).call1((Evidence(evidence.clone()),));
            answer.and_then(|answer| read(&answer)).map_err(keep_exception)
        })
    }
}

impl Function for Callable {
    fn matrix(
        &self,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<(), CoreError> {
        Python::attach(|py| self.evaluate(py, arguments, shape, put)).map_err(keep_exception)
    }

    fn forgetting_factor(&self, evidence: &forgetting_runtime::Evidence) -> Result<f64, CoreError> {
        self.ask(evidence, |answer| answer.extract())
    }

    fn gate(&self, evidence: &forgetting_runtime::Evidence) -> Result<Answer, CoreError> {
        self.ask(evidence, answer)
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

/// A gate's answer in Python's words.
fn answer(answer: &Bound<'_, PyAny>) -> PyResult<Answer> {
    let word = answer.extract::<String>().ok();
    word.and_then(|word| Answer::of_word(&word)).ok_or_else(|| {
        invalid(format!("gate answered {answer:?}, allowed: \"update\", \"freeze\", \"hold\""))
    })
}
