//! NumPy arrays as slices of numbers, without a copy where type and layout allow it.

use crate::errors::invalid;
use forgetting::Real;
use numpy::{Element, IxDyn, PyArray, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyFloat;

/// Anything that NumPy can make an array of.
pub type Array<'a, 'py> = &'a Bound<'py, PyAny>;

/// A number type that NumPy knows by this name.
pub trait Number: Real + Element {
    /// the name of the dtype
    const DTYPE: &'static str;
}

impl Number for f64 {
    const DTYPE: &'static str = "float64";
}

impl Number for f32 {
    const DTYPE: &'static str = "float32";
}

/// An array of `T` in C order: the one given, or a converted copy of it.
///
/// # Errors
/// `InvalidInput` names the parameter when its values are not numbers.
pub fn contiguous<'py, T: Number>(
    name: &str,
    values: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    if let Ok(array) = values.cast::<PyArray<T, IxDyn>>() {
        if array.is_c_contiguous() {
            return Ok(array.clone());
        }
    }
    static CONVERT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = values.py();
    let convert = CONVERT.get_or_try_init(py, || -> PyResult<Py<PyAny>> {
        Ok(py.import("numpy")?.getattr("require")?.unbind())
    })?;
    let array = convert
        .bind(py)
        .call1((values, T::DTYPE, "C"))
        .map_err(|error| invalid(format!("{name} must hold numbers ({error})")))?;
    Ok(array.cast_into::<PyArray<T, IxDyn>>()?)
}

/// Calls `use_slice` with the numbers of `values`: of an array of `T` in C order without a copy,
/// of a Python float or int without an array.
///
/// # Errors
/// As for [`contiguous`], and those of `use_slice`.
#[inline]
pub fn with_slice<T: Number, R>(
    name: &str,
    values: &Bound<'_, PyAny>,
    use_slice: impl FnOnce(&[T]) -> PyResult<R>,
) -> PyResult<R> {
    if let Ok(array) = values.cast::<PyArray<T, IxDyn>>() {
        if array.is_c_contiguous() {
            // SAFETY: the interpreter is held and no Python code runs while the slice lives
            return use_slice(unsafe { array.as_slice() }?);
        }
    }
    if let Ok(number) = values.cast::<PyFloat>() {
        return use_slice(&[T::from_f64(number.value())]);
    }
    let array = contiguous::<T>(name, values)?;
    // SAFETY: as above
    use_slice(unsafe { array.as_slice() }?)
}

/// `values` as an array of this shape.
pub fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    Ok(PyArray::from_vec(py, values).reshape(shape.to_vec())?.into_any())
}
