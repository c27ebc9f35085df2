//! What a sample of each stream did, for Python.

use crate::pickle::{reduce, Reduced};
use pyo3::prelude::*;

/// What a sample of each stream did: returned by `Fleet.update`. An output that was not asked
/// for is None.
///
/// Attributes
/// ----------
/// error : (count,) ndarray
///     y - phi @ theta with the theta of before, in units of y; NaN where there was no sample or
///     it was refused.
/// leverage : (count,) ndarray
///     Variance of the prediction in units of the noise variance; NaN as above.
/// skipped : (count,) ndarray of uint8
///     0 where the sample was used, else the code of the reason, see `forgetting.SKIPPED`.
/// used : int
///     Number of streams that used their sample.
#[pyclass(frozen, get_all, module = "forgetting")]
pub struct FleetUpdate {
    pub(super) error: Option<Py<PyAny>>,
    pub(super) leverage: Option<Py<PyAny>>,
    pub(super) skipped: Option<Py<PyAny>>,
    pub(super) used: usize,
}

#[pymethods]
impl FleetUpdate {
    fn __repr__(&self) -> String {
        format!("FleetUpdate(used={})", self.used)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduce(slf, &["error", "leverage", "skipped", "used"])
    }

    #[staticmethod]
    fn _of(
        error: Option<Py<PyAny>>,
        leverage: Option<Py<PyAny>>,
        skipped: Option<Py<PyAny>>,
        used: usize,
    ) -> Self {
        Self { error, leverage, skipped, used }
    }
}
