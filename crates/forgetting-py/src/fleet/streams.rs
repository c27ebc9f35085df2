//! Streams of a `Fleet`, one by one: added, taken out and put in.

use super::Fleet;
use crate::bank::Bank;
use crate::errors::{heed_signals, invalid, raise};
use crate::rls::Rls;
use crate::settings::Whole;
use forgetting_runtime::Stream;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::IntoPyObjectExt;

#[pymethods]
impl Fleet {
    /// Add streams after the last. Like `update` it hears Ctrl-C; there are then as many as before.
    ///
    /// Parameters
    /// ----------
    /// more : int or Fleet
    ///     So many new streams, or copies of those of another fleet of the same parameters, rule,
    ///     weighting and dtype. New streams start from what was given for all streams, and from
    ///     the default where one was given for each.
    fn append(slf: &Bound<'_, Self>, more: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = slf.py();
        if let Ok(other) = more.cast::<Self>() {
            // a copy, since it may be this one, or wait for this one elsewhere
            let other = other.get().__copy__(py)?.fleet;
            let (other, mut held) = (other.lock(py)?, slf.get().fleet.lock(py)?);
            let (other, fleet) = (&*other, &mut *held);
            return py.detach(|| fleet.append_while(other, &mut heed_signals)).map_err(raise);
        }
        let count = more
            .extract::<Whole>()
            .map_err(|_| invalid(format!("more = {more:?}, allowed: a whole number or a Fleet")))?;
        let mut held = slf.get().fleet.lock(py)?;
        let fleet = &mut *held;
        py.detach(|| fleet.grow_while(count.0, &mut heed_signals)).map_err(raise)
    }

    /// A copy of the stream at `index`, as an `RLS` or a `Bank` that goes on from there.
    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (position, py) = (read_index(index)?, index.py());
        match self.fleet.lock(py)?.get(position).map_err(raise)? {
            Stream::Estimator(estimator) => Rls::of(estimator).into_bound_py_any(py),
            Stream::Bank(bank) => Bank::of(bank).into_bound_py_any(py),
        }
    }

    /// Puts a copy of `stream`, an `RLS` or a `Bank`, in the place of the stream at `index`.
    fn __setitem__(&self, index: &Bound<'_, PyAny>, stream: &Bound<'_, PyAny>) -> PyResult<()> {
        let (position, py) = (read_index(index)?, index.py());
        let copy = copy(stream)?;
        self.fleet.lock(py)?.put(position, copy).map_err(raise)
    }
}

/// A copy of what is to be a stream.
fn copy(stream: &Bound<'_, PyAny>) -> PyResult<Stream> {
    if let Ok(estimator) = stream.cast::<Rls>() {
        return estimator.get().copy(stream.py()).map(Stream::Estimator);
    }
    if let Ok(bank) = stream.cast::<Bank>() {
        return bank.get().copy(stream.py()).map(Stream::Bank);
    }
    let kind = stream.get_type().name()?;
    Err(PyTypeError::new_err(format!("a stream is an RLS or a Bank, not {kind}")))
}

fn read_index(index: &Bound<'_, PyAny>) -> PyResult<i64> {
    let whole = index.extract::<Whole>();
    whole
        .map(|index| index.0)
        .map_err(|_| PyTypeError::new_err("the index of a stream is a whole number"))
}
