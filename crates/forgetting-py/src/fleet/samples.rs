//! What the streams of a `Fleet` make of samples.

use super::{Fleet, FleetUpdate};
use crate::arrays::{optional, output, Input};
use crate::errors::{heed_signals, invalid, raise};
use crate::settings::{names, read_optional, view, Names};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

#[pymethods]
impl Fleet {
    /// phi @ theta of each stream.
    ///
    /// Parameters
    /// ----------
    /// phi : (count, n) array
    ///
    /// Returns
    /// -------
    /// (count,) ndarray
    fn predict<'py>(
        &self,
        py: Python<'py>,
        phi: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let phi = Input::read("phi", phi, self.number_type)?;
        let held = self.fleet.lock(py)?;
        let (fleet, phi) = (&*held, phi.view("phi")?);
        output(py, py.detach(|| fleet.predict(phi, &mut heed_signals)).map_err(raise)?)
    }

    /// Take a sample of each stream, without holding the interpreter. Ctrl-C is heard within half a
    /// second; the fleet is then as it was before, bit for bit.
    ///
    /// Parameters
    /// ----------
    /// phi : (count, n) array
    /// y : (count,) array
    /// mask : (count,) array of bool, optional
    ///     Which streams have a sample; all if not given. A NaN in phi or y says the same of its
    ///     stream.
    /// outputs : str or sequence of str, default ("error", "skipped")
    ///     What to keep, of "error", "leverage" and "skipped".
    /// elapsed : float or (count,) array, optional
    ///     Time since the last sample of each stream, as that of `RLS.update`. Streams are then taken
    ///     one by one, in microseconds each; of banks each member, too.
    ///
    /// Returns
    /// -------
    /// FleetUpdate
    ///
    /// Raises
    /// ------
    /// InvalidInput
    ///     For a wrong shape; nothing has changed. What a stream cannot use is not raised: the
    ///     code in `skipped` says "refused" where the sample has an infinite number or the result
    ///     would leave the range of the number type, and that stream is as it was.
    #[pyo3(signature = (phi, y, mask=None, outputs=None, *, elapsed=None))]
    fn update(
        &self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        mask: Option<&Bound<'_, PyAny>>,
        outputs: Option<Names>,
        elapsed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<FleetUpdate> {
        let number_type = self.number_type;
        let mask = mask.map(|mask| read_mask(mask)).transpose()?;
        let phi = Input::read("phi", phi, number_type)?;
        let y = Input::read("y", y, number_type)?;
        let elapsed = read_optional("elapsed", elapsed, number_type)?;
        let mut held = self.fleet.lock(py)?;
        let elapsed = view("elapsed", &elapsed)?;
        let samples = (phi.view("phi")?, y.view("y")?, mask.as_deref());
        let (fleet, outputs) = (&mut *held, names(outputs.as_ref()));
        let update = py
            .detach(|| fleet.update_while(elapsed, samples, outputs.as_deref(), &mut heed_signals))
            .map_err(raise)?;
        Ok(FleetUpdate {
            error: optional(py, update.error)?,
            leverage: optional(py, update.leverage)?,
            skipped: optional(py, update.skipped)?,
            used: update.used,
        })
    }

    /// Back to the initial estimate and covariance, as if no sample had been seen.
    ///
    /// Parameters
    /// ----------
    /// mask : (count,) array of bool, optional
    ///     Which streams; all if not given.
    #[pyo3(signature = (mask=None))]
    fn reset(&self, py: Python<'_>, mask: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let mask = mask.map(|mask| read_mask(mask)).transpose()?;
        let mut held = self.fleet.lock(py)?;
        let (fleet, mask) = (&mut *held, mask.as_deref());
        py.detach(|| fleet.reset(mask, &mut heed_signals)).map_err(raise)
    }
}

/// A yes or no for each stream, copied; the fleet says how many there are to be.
fn read_mask(mask: &Bound<'_, PyAny>) -> PyResult<Vec<bool>> {
    let array = mask.py().import("numpy")?.call_method1("asarray", (mask,))?;
    let Ok(flat) = array.cast::<PyArray1<bool>>() else {
        let shape = array.getattr("shape")?;
        return Err(invalid(format!(
            "mask must hold True or False, one for each stream; it has shape {shape} and holds {}",
            array.getattr("dtype")?
        )));
    };
    Ok(flat.to_vec()?)
}
