//! Errors as Python exceptions.

use forgetting_runtime::{CoreError, Error, Kind};
use pyo3::exceptions::{PyArithmeticError, PyIndexError, PyMemoryError, PyValueError};
use pyo3::{create_exception, PyErr, Python};
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
    /// The exception of a callable, while its [`CoreError::Function`] is on its way back.
    static EXCEPTION: RefCell<Option<PyErr>> = const { RefCell::new(None) };
}

/// The error that stands for an exception on its way through the estimator.
pub fn keep_exception(exception: PyErr) -> CoreError {
    EXCEPTION.set(Some(exception));
    CoreError::Function { parameter: "a function of yours" }
}

/// Whether a long calculation goes on: not once Python has a signal to raise an exception for, such
/// as Ctrl-C.
pub fn heed_signals() -> Result<(), CoreError> {
    Python::attach(|py| py.check_signals()).map_err(keep_exception)
}

/// The exception for `error`.
#[cold]
pub fn raise(error: Error) -> PyErr {
    let text = error.to_string();
    match error.kind() {
        Kind::Function => EXCEPTION.take().unwrap_or_else(|| InvalidInput::new_err(text)),
        Kind::Range => NumericalRange::new_err(text),
        Kind::Memory => PyMemoryError::new_err(text),
        Kind::Index => PyIndexError::new_err(text),
        Kind::Invalid => InvalidInput::new_err(text),
    }
}

/// An exception for something that only Python can get wrong.
pub fn invalid(text: impl Into<String>) -> PyErr {
    InvalidInput::new_err(text.into())
}
