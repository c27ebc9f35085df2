//! Which values of Python are numbers, and what is said of those that are not.

use crate::errors::invalid;
use numpy::{PyArrayDescrMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyException, PyMemoryError};
use pyo3::prelude::*;

/// `values` as an array that NumPy can convert without losing a part of them.
///
/// # Errors
/// `InvalidInput` names the parameter: complex numbers would lose their imaginary part, a masked
/// array its mask, dates their unit.
pub fn real_numbers<'py>(
    name: &str,
    values: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    let numpy = values.py().import("numpy")?;
    let array = numpy
        .call_method1("asanyarray", (values,))
        .map_err(|error| not_numbers(values.py(), name, error))?;
    let array = array.cast_into::<PyUntypedArray>()?;
    if array.is_instance(&numpy.getattr("ma")?.getattr("MaskedArray")?)? {
        let instead = "put NaN where a value is missing";
        return Err(invalid(format!("{name} must hold numbers, not a masked array: {instead}")));
    }
    let what = match array.dtype().kind() {
        b'c' => "complex ones",
        b'M' | b'm' => "dates or times",
        b'S' | b'U' => "text",
        b'V' => "records",
        _ => return Ok(array),
    };
    Err(invalid(format!("{name} must hold numbers, not {what} ({})", array.dtype())))
}

/// What is raised of values that NumPy cannot read: what only ends the work, such as Ctrl-C, and a lack
/// of memory, as they are.
pub fn not_numbers(py: Python<'_>, name: &str, error: PyErr) -> PyErr {
    if error.is_instance_of::<PyException>(py) && !error.is_instance_of::<PyMemoryError>(py) {
        return invalid(format!("{name} must hold numbers ({error})"));
    }
    error
}
