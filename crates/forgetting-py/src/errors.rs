//! Errors of the crate as Python exceptions.

use forgetting::Error;
use pyo3::exceptions::{PyArithmeticError, PyMemoryError, PyValueError};
use pyo3::{create_exception, PyErr};
use std::cell::RefCell;

create_exception!(
    forgetting,
    InvalidInput,
    PyValueError,
    "A value outside its allowed range, a shape that does not fit, or an unreadable state.\n\n\
     The message names the parameter, its value and what is allowed. Nothing has changed."
);
create_exception!(
    forgetting,
    NumericalRange,
    PyArithmeticError,
    "A sample refused because the result would leave the range of the number type.\n\n\
     The estimator is as it was before the sample."
);

thread_local! {
    /// The exception of a callable, while the crate hands its [`Error::Function`] back.
    static EXCEPTION: RefCell<Option<PyErr>> = const { RefCell::new(None) };
}

/// The error that stands for an exception within the crate.
pub fn keep_exception(exception: PyErr) -> Error {
    EXCEPTION.set(Some(exception));
    Error::Function { parameter: "a function of yours" }
}

/// The exception for `error`.
pub fn raise(error: Error) -> PyErr {
    raise_at(error, None)
}

/// The exception for `error` at this sample of a record.
pub fn raise_at(error: Error, sample: Option<usize>) -> PyErr {
    let text = match sample {
        Some(sample) => format!("sample {sample}: {error}"),
        None => error.to_string(),
    };
    match error {
        Error::Function { .. } => EXCEPTION.take().unwrap_or_else(|| InvalidInput::new_err(text)),
        Error::Range { .. } => NumericalRange::new_err(text),
        Error::Memory => PyMemoryError::new_err(text),
        _ => InvalidInput::new_err(text),
    }
}

/// An exception for something that only Python can get wrong.
pub fn invalid(text: impl Into<String>) -> PyErr {
    InvalidInput::new_err(text.into())
}
