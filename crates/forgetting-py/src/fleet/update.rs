//! A sample for every stream of a fleet.

use super::streams::Streams;
use crate::arrays::{contiguous, shaped, Array, Number};
use crate::errors::{invalid, raise};
use forgetting::fleet::{Outputs, Samples};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// What a sample of each stream told: returned by `Fleet.update`. An output that was not asked
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
    error: Option<Py<PyAny>>,
    leverage: Option<Py<PyAny>>,
    skipped: Option<Py<PyAny>>,
    used: usize,
}

#[pymethods]
impl FleetUpdate {
    fn __repr__(&self) -> String {
        format!("FleetUpdate(used={})", self.used)
    }
}

/// Names of the outputs that are kept when none are named.
pub const DEFAULT_OUTPUTS: [&str; 2] = ["error", "skipped"];
const ALL_OUTPUTS: [&str; 3] = ["error", "leverage", "skipped"];

/// Takes a sample for each stream, without the interpreter.
pub fn update<T: Number>(
    py: Python<'_>,
    streams: &mut Streams<T>,
    (phi, y, mask): (Array<'_, '_>, Array<'_, '_>, Option<Array<'_, '_>>),
    outputs: &[String],
    threads: Option<usize>,
) -> PyResult<FleetUpdate> {
    let count = streams.len();
    if let Some(name) = outputs.iter().find(|name| !ALL_OUTPUTS.contains(&name.as_str())) {
        let allowed = ALL_OUTPUTS.join(", ");
        return Err(invalid(format!("outputs has {name:?}, allowed: {allowed}")));
    }
    let phi = read::<T>("phi", phi, &[count, streams.parameters()])?;
    let y = read::<T>("y", y, &[count])?;
    let mask = mask.map(|mask| read_mask(mask, count)).transpose()?;
    let wanted = |name: &str| outputs.iter().any(|output| output == name);
    let mut error = wanted("error").then(|| vec![T::ZERO; count]);
    let mut leverage = wanted("leverage").then(|| vec![T::ZERO; count]);
    let mut skipped = wanted("skipped").then(|| vec![0; count]);
    let told = Outputs {
        error: error.as_deref_mut(),
        leverage: leverage.as_deref_mut(),
        skipped: skipped.as_deref_mut(),
    };
    let (phi, y) = (T::wrap(phi.as_slice()?), T::wrap(y.as_slice()?));
    let samples = Samples { phi, y, mask: mask.as_deref() };
    let used = py.detach(|| streams.update(samples, told, threads)).map_err(raise)?;
    let array = |numbers: Option<Vec<T>>| {
        numbers.map(|numbers| shaped(py, numbers, &[count]).map(Bound::unbind)).transpose()
    };
    Ok(FleetUpdate {
        error: array(error)?,
        leverage: array(leverage)?,
        skipped: skipped.map(|codes| shaped(py, codes, &[count]).map(Bound::unbind)).transpose()?,
        used,
    })
}

/// phi @ theta of each stream.
pub fn predict<'py, T: Number>(
    py: Python<'py>,
    streams: &Streams<T>,
    phi: Array<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let count = streams.len();
    let phi = read::<T>("phi", phi, &[count, streams.parameters()])?;
    let mut prediction = vec![T::ZERO; count];
    let phi = T::wrap(phi.as_slice()?);
    py.detach(|| streams.predict(phi, &mut prediction)).map_err(raise)?;
    shaped(py, prediction, &[count])
}

/// An array of numbers of this shape.
fn read<'py, T: Number>(
    name: &str,
    values: Array<'_, 'py>,
    shape: &[usize],
) -> PyResult<PyReadonlyArrayDyn<'py, T::Element>> {
    let array = contiguous::<T>(name, values)?;
    check_shape(name, array.shape(), shape)?;
    Ok(array.readonly())
}

/// A yes or no for each stream, copied.
pub fn read_mask(mask: Array<'_, '_>, count: usize) -> PyResult<Vec<bool>> {
    let array = mask.py().import("numpy")?.call_method1("asarray", (mask,))?;
    let flat = array.call_method0("ravel")?;
    let Ok(flat) = flat.cast::<PyArray1<bool>>() else {
        return Err(invalid("mask must hold True or False, one for each stream"));
    };
    check_shape("mask", &array.getattr("shape")?.extract::<Vec<usize>>()?, &[count])?;
    Ok(flat.to_vec()?)
}

fn check_shape(name: &str, shape: &[usize], expected: &[usize]) -> PyResult<()> {
    if shape == expected {
        return Ok(());
    }
    Err(invalid(format!("{name} has shape {shape:?}, expected {expected:?}")))
}
