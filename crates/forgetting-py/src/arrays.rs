//! NumPy arrays as slices of numbers, without a copy where type and layout allow it.

use crate::conversion::{not_numbers, real_numbers};
use crate::errors::raise;
use forgetting_runtime::{Array, Elements, Innovation, NumberType, Numbers, View};
use numpy::{
    Element, IxDyn, PyArray, PyArrayDescr, PyArrayDyn, PyArrayMethods, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyFloat;

/// A NumPy type of the numbers that an estimator takes.
pub trait Number: Element + Copy {
    /// The number type of the estimator.
    const TYPE: NumberType;
    /// NumPy's type, which it makes once.
    fn dtype(py: Python<'_>) -> &Py<PyArrayDescr>;
    /// The number nearest to `x`.
    fn from_f64(x: f64) -> Self;
}

macro_rules! number {
    ($float:ty, $Type:ident) => {
        impl Number for $float {
            const TYPE: NumberType = NumberType::$Type;
            #[inline(always)]
            fn dtype(py: Python<'_>) -> &Py<PyArrayDescr> {
                static DTYPE: PyOnceLock<Py<PyArrayDescr>> = PyOnceLock::new();
                DTYPE.get_or_init(py, || numpy::dtype::<$float>(py).unbind())
            }
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as Self
            }
        }
    };
}
number!(f64, F64);
number!(f32, F32);

/// Finds NumPy's functions and types. Where they are needed first, a Ctrl-C in the middle of the search
/// would be a panic.
///
/// # Errors
/// That of NumPy's import.
pub fn load(py: Python<'_>) -> PyResult<()> {
    py.import("numpy")?;
    <f64 as Number>::dtype(py);
    <f32 as Number>::dtype(py);
    Ok(())
}

/// Numbers from Python in the type of an estimator.
pub enum Input<'a, 'py> {
    F64(Source<'a, 'py, f64>),
    F32(Source<'a, 'py, f32>),
}

/// Where numbers from Python are.
pub enum Source<'a, 'py, T> {
    /// in the array that was given
    Borrowed(&'a Bound<'py, PyArrayDyn<T>>),
    /// in an array made from it
    Owned(Bound<'py, PyArrayDyn<T>>),
    /// a single number that was no array
    Number([T; 1]),
}

impl<'a, 'py> Input<'a, 'py> {
    /// The numbers of `values`: of an array of this type in C order without a copy, of a Python
    /// float without an array.
    ///
    /// # Errors
    /// `InvalidInput` names the parameter when its values are not numbers.
    #[inline(always)]
    pub fn read(
        name: &str,
        values: &'a Bound<'py, PyAny>,
        number_type: NumberType,
    ) -> PyResult<Self> {
        match number_type {
            NumberType::F64 => Source::read(name, values).map(Self::F64),
            NumberType::F32 => Source::read(name, values).map(Self::F32),
        }
    }

    /// The same in an array of its own, if `copy` says so.
    #[inline(always)]
    pub fn read_or_copy(
        name: &str,
        values: &'a Bound<'py, PyAny>,
        number_type: NumberType,
        copy: bool,
    ) -> PyResult<Self> {
        let input = Self::read(name, values, number_type)?;
        if copy {
            input.copy()
        } else {
            Ok(input)
        }
    }

    #[cold]
    fn copy(self) -> PyResult<Self> {
        match self {
            Self::F64(source) => source.copy().map(Self::F64),
            Self::F32(source) => source.copy().map(Self::F32),
        }
    }

    /// The numbers.
    ///
    /// The interpreter is held by whoever has an `Input`. While the slice lives, no Python code
    /// may run that could change the array; where code of the user's may, it gets a copy.
    #[inline(always)]
    pub fn numbers(&self) -> PyResult<Numbers<'_>> {
        Ok(match self {
            Self::F64(source) => Numbers::F64(source.slice()?),
            Self::F32(source) => Numbers::F32(source.slice()?),
        })
    }

    /// Their shape.
    pub fn shape(&self) -> &[usize] {
        match self {
            Self::F64(source) => source.shape(),
            Self::F32(source) => source.shape(),
        }
    }

    /// The numbers in their shape; see [`Input::numbers`].
    pub fn view(&self, name: &'static str) -> PyResult<View<'_>> {
        View::new(name, self.numbers()?, self.shape()).map_err(raise)
    }
}

impl<'a, 'py, T: Number> Source<'a, 'py, T> {
    #[inline(always)]
    fn read(name: &str, values: &'a Bound<'py, PyAny>) -> PyResult<Self> {
        if let Some(array) = native(values) {
            return Ok(Self::Borrowed(array));
        }
        match values.cast::<PyFloat>() {
            Ok(number) => Ok(Self::Number([T::from_f64(number.value())])),
            Err(_) => contiguous(name, values).map(Self::Owned),
        }
    }

    fn copy(self) -> PyResult<Self> {
        let array = match &self {
            Self::Borrowed(array) => array,
            Self::Owned(array) => array,
            Self::Number(_) => return Ok(self),
        };
        let copy = array.call_method0("copy")?;
        Ok(Self::Owned(copy.cast_into::<PyArray<T, IxDyn>>()?))
    }

    #[inline(always)]
    fn slice(&self) -> PyResult<&[T]> {
        let array = match self {
            Self::Borrowed(array) => array,
            Self::Owned(array) => array,
            Self::Number(number) => return Ok(number),
        };
        // SAFETY: see `Input::numbers`
        Ok(unsafe { array.as_slice() }?)
    }

    fn shape(&self) -> &[usize] {
        match self {
            Self::Borrowed(array) => array.shape(),
            Self::Owned(array) => array.shape(),
            Self::Number(_) => &[],
        }
    }
}

/// An array of `T` in C order: the one given, or a converted copy of it.
fn contiguous<'py, T: Number>(
    name: &str,
    values: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    static CONVERT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = values.py();
    let convert = CONVERT.get_or_try_init(py, || -> PyResult<Py<PyAny>> {
        Ok(py.import("numpy")?.getattr("require")?.unbind())
    })?;
    let array = real_numbers(name, values)?;
    let array = convert
        .bind(py)
        .call1((array, T::TYPE.name(), "CA"))
        .map_err(|error| not_numbers(py, name, error))?;
    Ok(array.cast_into::<PyArray<T, IxDyn>>()?)
}

/// `values` if it is an array of `T` as NumPy itself makes them, in C order: a few comparisons tell.
#[inline(always)]
fn native<'a, 'py, T: Number>(
    values: &'a Bound<'py, PyAny>,
) -> Option<&'a Bound<'py, PyArrayDyn<T>>> {
    let array = values.cast_exact::<PyUntypedArray>().ok()?;
    if !array.dtype().is(T::dtype(values.py())) {
        return None;
    }
    // SAFETY: it is an array, and its numbers are `T`
    let array = unsafe { values.cast_unchecked() };
    is_slice(array).then_some(array)
}

/// Whether the numbers lie in C order where a slice may.
#[inline(always)]
fn is_slice<T: Element>(array: &Bound<'_, PyArrayDyn<T>>) -> bool {
    array.is_c_contiguous() && array.data().is_aligned()
}

/// The numbers of `values`, an argument called `name`, as an array of float64: what every function
/// takes for numbers.
#[pyfunction]
pub fn numbers<'py>(name: &str, values: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    Ok(contiguous::<f64>(name, values)?.into_any())
}

/// An array for Python.
pub fn output(py: Python<'_>, array: Array) -> PyResult<Bound<'_, PyAny>> {
    let Array { shape, elements } = array;
    match elements {
        Elements::F64(elements) => shaped(py, elements, shape),
        Elements::F32(elements) => shaped(py, elements, shape),
        Elements::I64(elements) => shaped(py, elements, shape),
        Elements::U8(elements) => shaped(py, elements, shape),
        Elements::Bool(elements) => shaped(py, elements, shape),
    }
}

/// An array for Python, if there is one.
pub fn optional(py: Python<'_>, array: Option<Array>) -> PyResult<Option<Py<PyAny>>> {
    array.map(|array| output(py, array).map(Bound::unbind)).transpose()
}

/// The numbers of a sample for Python; a float if there is one only.
pub fn innovation<'py>(py: Python<'py>, innovation: &Innovation) -> PyResult<Bound<'py, PyAny>> {
    match innovation {
        Innovation::Scalar(number) => Ok(PyFloat::new(py, *number).into_any()),
        Innovation::Array { .. } => output(py, innovation.array()),
    }
}

/// What [`innovation`] made an object of.
///
/// # Errors
/// `InvalidInput` for what is neither a number nor an array.
pub fn read_innovation(object: &Bound<'_, PyAny>) -> PyResult<Innovation> {
    let input = Input::read("error", object, NumberType::F64)?;
    let elements = match input.numbers()? {
        Numbers::F64(elements) => elements.into(),
        Numbers::F32(elements) => elements.iter().map(|&x| f64::from(x)).collect(),
    };
    Ok(match input.shape() {
        [] => Innovation::Scalar(object.extract()?),
        shape => Innovation::Array { elements, targets: shape.get(1).copied().unwrap_or(1) },
    })
}

/// An array for Python; a float if it has no dimension.
pub fn output_or_float(py: Python<'_>, array: Array) -> PyResult<Bound<'_, PyAny>> {
    match (array.shape.as_slice(), &array.elements) {
        ([], Elements::F64(number)) => Ok(PyFloat::new(py, number[0]).into_any()),
        ([], Elements::F32(number)) => Ok(PyFloat::new(py, number[0].into()).into_any()),
        _ => output(py, array),
    }
}

fn shaped<T: Element>(
    py: Python<'_>,
    elements: Vec<T>,
    shape: Vec<usize>,
) -> PyResult<Bound<'_, PyAny>> {
    Ok(PyArray::from_vec(py, elements).reshape(shape)?.into_any())
}
