//! A `Fleet` as a table of bytes, pickled and copied.

use super::Fleet;
use crate::errors::{heed_signals, raise};
use crate::pickle::bytes;
use forgetting_runtime::Error;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple, PyType};

#[pymethods]
impl Fleet {
    /// The streams as an Arrow table: one row a stream, with its number `stream` and its `state`,
    /// the bytes of `RLS.to_bytes` or `Bank.to_bytes`. Needs pyarrow: ``pip install forgetting[cli]``.
    fn to_arrow<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("forgetting.fleet")?.call_method1("to_arrow", (slf,))
    }

    /// The fleet that `to_arrow` saved, bit for bit; one stream for each row of the table.
    #[classmethod]
    fn from_arrow<'py>(
        _: &Bound<'py, PyType>,
        table: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        table.py().import("forgetting.fleet")?.call_method1("from_arrow", (table,))
    }

    /// The state of a new stream, then that of each stream, as `to_bytes` of a stream says it.
    fn _states<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        let fleet = self.fleet.lock(py)?;
        let fresh = std::iter::once_with(|| fleet.fresh_state());
        let streams = (0..fleet.count() as i64).map(|stream| fleet.state(stream));
        let written = |state: Result<Vec<u8>, Error>| {
            py.check_signals()?;
            bytes(py, &state.map_err(raise)?)
        };
        fresh.chain(streams).map(written).collect()
    }

    /// The fleet that has these states.
    #[staticmethod]
    fn _of_states(py: Python<'_>, fresh: &[u8], states: Vec<Bound<'_, PyBytes>>) -> PyResult<Self> {
        let states: Vec<&[u8]> = states.iter().map(|state| state.as_bytes()).collect();
        py.detach(|| forgetting_runtime::Fleet::from_states(fresh, &states, &mut heed_signals))
            .map(Self::of)
            .map_err(raise)
    }

    #[allow(clippy::type_complexity, reason = "Python's protocol")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyAny>, Bound<'py, PyAny>))> {
        let mut states = slf.get()._states(slf.py())?;
        let each = PyTuple::new(slf.py(), states.split_off(1))?.to_list().into_any();
        Ok((slf.getattr("_of_states")?, (states.remove(0).into_any(), each)))
    }

    pub(super) fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        let held = self.fleet.lock(py)?;
        let fleet = &*held;
        py.detach(|| fleet.copy(&mut heed_signals)).map(Self::of).map_err(raise)
    }

    fn __deepcopy__(&self, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.__copy__(memo.py())
    }
}
