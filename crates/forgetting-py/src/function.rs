//! A Python callable as a function of the crate.

use crate::arrays::{contiguous, shaped};
use crate::choice::shape_of;
use crate::errors::{invalid, keep_exception};
use forgetting::function::{Argument, MatrixFunction};
use forgetting::Error;
use numpy::{PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::any::Any;

/// A callable that takes arrays and returns an array.
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

    /// The callable itself.
    pub fn object<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        self.callable.bind(py).clone()
    }

    fn evaluate(
        &self,
        py: Python<'_>,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> PyResult<()> {
        let array = |a: &Argument<'_>| {
            let elements: Vec<f64> = (0..a.rows * a.columns).map(a.elements).collect();
            shaped(py, elements, &[a.rows, a.columns])
        };
        let arguments: PyResult<Vec<_>> = arguments.iter().map(array).collect();
        let result = self.callable.bind(py).call1(PyTuple::new(py, arguments?)?)?;
        let name = format!("the result of {}", self.parameter);
        let found = shape_of(&name, &result)?;
        if found != [shape.0, shape.1] {
            return Err(invalid(format!("{name} has shape {found:?}, expected {shape:?}")));
        }
        let result = contiguous::<f64>(&name, &result)?;
        debug_assert_eq!(result.len(), shape.0 * shape.1);
        for (k, &x) in result.readonly().as_slice()?.iter().enumerate() {
            put(k, x);
        }
        Ok(())
    }
}

impl MatrixFunction for Callable {
    fn call(
        &self,
        arguments: &[Argument<'_>],
        shape: (usize, usize),
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<(), Error> {
        Python::attach(|py| self.evaluate(py, arguments, shape, put)).map_err(keep_exception)
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}
