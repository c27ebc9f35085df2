//! An `RLS` as bytes, pickled and copied.

use super::Rls;
use crate::errors::raise;
use crate::pickle::bytes;
use forgetting_runtime::Estimator;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};

#[pymethods]
impl Rls {
    /// The estimator, configuration and state, as bytes: portable, versioned and checked.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        bytes(py, &self.estimator.lock(py)?.to_bytes().map_err(raise)?)
    }

    /// The estimator that `to_bytes` saved, bit for bit.
    #[classmethod]
    fn from_bytes(_: &Bound<'_, PyType>, state: &[u8]) -> PyResult<Self> {
        Ok(Self::of(Estimator::from_bytes(state).map_err(raise)?))
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = slf.getattr("from_bytes")?;
        Ok((restore, (slf.get().to_bytes(slf.py())?,)))
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py).map(Self::of)
    }

    fn __deepcopy__(&self, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.__copy__(memo.py())
    }
}
