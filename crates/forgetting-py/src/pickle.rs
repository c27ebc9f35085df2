//! States as bytes, and results of updates and runs, for `pickle` and `copy`.

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple};

/// What `__reduce__` returns: a function and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

/// An object as its static method `_of`, called with these attributes.
///
/// # Errors
/// None but those of Python.
pub fn reduce<'py, T>(object: &Bound<'py, T>, attributes: &[&str]) -> PyResult<Reduced<'py>> {
    let object = object.as_any();
    let values = attributes.iter().map(|name| object.getattr(*name));
    let values = PyTuple::new(object.py(), values.collect::<PyResult<Vec<_>>>()?)?;
    Ok((object.getattr("_of")?, values))
}

/// A state for Python.
///
/// # Errors
/// `MemoryError`.
pub fn bytes<'py>(py: Python<'py>, state: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, state.len(), |place| {
        place.copy_from_slice(state);
        Ok(())
    })
}
