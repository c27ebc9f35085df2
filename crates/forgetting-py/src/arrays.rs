//! NumPy arrays as slices of numbers, without a copy where type and layout allow it.

use crate::errors::invalid;
use bytemuck::{TransparentWrapper, TransparentWrapperAlloc};
use forgetting::Kernels;
use forgetting_cpu::Fused;
use numpy::{
    Element, IxDyn, PyArray, PyArrayDescr, PyArrayDyn, PyArrayMethods, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyFloat;

/// Anything that NumPy can make an array of.
pub type Array<'a, 'py> = &'a Bound<'py, PyAny>;

/// What an array of NumPy can be made of.
pub trait Stored: Sized {
    /// the same number, as NumPy knows it
    type Element: Element + Copy;
    /// The same numbers, for NumPy.
    fn peel(numbers: Vec<Self>) -> Vec<Self::Element>;
}

/// A number type to compute with.
pub trait Number: Kernels + Stored {
    /// the name of NumPy's type
    const DTYPE: &'static str;
    /// NumPy's type, which it makes once.
    fn dtype(py: Python<'_>) -> &Py<PyArrayDescr>;
    /// NumPy's numbers, to compute with.
    fn wrap(numbers: &[Self::Element]) -> &[Self];
}

macro_rules! plain {
    ($($type:ty),*) => {$(
        impl Stored for $type {
            type Element = Self;
            fn peel(numbers: Vec<Self>) -> Vec<Self> {
                numbers
            }
        }
    )*};
}
plain!(f64, f32, i64, u8, bool);

macro_rules! number {
    ($float:ty, $name:literal) => {
        impl Number for $float {
            const DTYPE: &'static str = $name;
            #[inline(always)]
            fn dtype(py: Python<'_>) -> &Py<PyArrayDescr> {
                static DTYPE: PyOnceLock<Py<PyArrayDescr>> = PyOnceLock::new();
                DTYPE.get_or_init(py, || numpy::dtype::<$float>(py).unbind())
            }
            #[inline(always)]
            fn wrap(numbers: &[Self]) -> &[Self] {
                numbers
            }
        }

        impl Stored for Fused<$float> {
            type Element = $float;
            fn peel(numbers: Vec<Self>) -> Vec<$float> {
                Self::peel_vec(numbers)
            }
        }

        impl Number for Fused<$float> {
            const DTYPE: &'static str = $name;
            #[inline(always)]
            fn dtype(py: Python<'_>) -> &Py<PyArrayDescr> {
                <$float as Number>::dtype(py)
            }
            #[inline(always)]
            fn wrap(numbers: &[$float]) -> &[Self] {
                Self::wrap_slice(numbers)
            }
        }
    };
}
number!(f64, "float64");
number!(f32, "float32");

/// An array of `T` in C order: the one given, or a converted copy of it.
///
/// # Errors
/// `InvalidInput` names the parameter when its values are not numbers.
pub fn contiguous<'py, T: Number>(
    name: &str,
    values: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<T::Element>>> {
    if let Ok(array) = values.cast::<PyArray<T::Element, IxDyn>>() {
        if is_slice(array) {
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
        .call1((values, T::DTYPE, "CA"))
        .map_err(|error| invalid(format!("{name} must hold numbers ({error})")))?;
    Ok(array.cast_into::<PyArray<T::Element, IxDyn>>()?)
}

/// `values` if it is an array of `T` as NumPy itself makes them, in C order: a few comparisons tell.
#[inline]
fn native<'a, 'py, T: Number>(
    values: &'a Bound<'py, PyAny>,
) -> Option<&'a Bound<'py, PyArrayDyn<T::Element>>> {
    let array = values.cast_exact::<PyUntypedArray>().ok()?;
    if !array.dtype().is(T::dtype(values.py())) {
        return None;
    }
    // SAFETY: it is an array, and its numbers are `T`
    let array = unsafe { values.cast_unchecked() };
    is_slice(array).then_some(array)
}

/// Whether the numbers lie in C order where a slice may.
#[inline]
fn is_slice<T: Element>(array: &Bound<'_, PyArrayDyn<T>>) -> bool {
    array.is_c_contiguous() && array.data().is_aligned()
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
    if let Some(array) = native::<T>(values) {
        // SAFETY: the interpreter is held and no Python code runs while the slice lives
        return use_slice(T::wrap(unsafe { array.as_slice() }?));
    }
    if let Ok(number) = values.cast::<PyFloat>() {
        return use_slice(&[T::from_f64(number.value())]);
    }
    let array = contiguous::<T>(name, values)?;
    // SAFETY: as above
    use_slice(T::wrap(unsafe { array.as_slice() }?))
}

/// The numbers of `values`, copied.
///
/// # Errors
/// As for [`contiguous`].
pub fn owned<T: Number>(name: &str, values: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    with_slice(name, values, |values: &[T]| Ok(values.to_vec()))
}

/// `values` as an array of this shape.
pub fn shaped<'py, T: Stored>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    Ok(PyArray::from_vec(py, T::peel(values)).reshape(shape.to_vec())?.into_any())
}
