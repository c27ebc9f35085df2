//! Predictions with an interval.

use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What `forgetting.predict` says of an `estimator` at a level.
pub fn interval<'py, T>(
    estimator: &Bound<'py, T>,
    phi: &Bound<'py, PyAny>,
    level: &Bound<'py, PyAny>,
    errors: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = estimator.py();
    let named = PyDict::new(py);
    named.set_item("errors", errors)?;
    py.import("forgetting.prediction")?.call_method(
        "predict",
        (estimator.as_any(), phi, level),
        Some(&named),
    )
}
