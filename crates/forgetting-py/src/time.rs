//! Times from Python: numbers in the unit of time in which forgetting is stated, or dates and
//! durations, which are then in seconds.

use crate::arrays::Input;
use crate::errors::invalid;
use forgetting_runtime::NumberType;
use numpy::{PyArrayDescrMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// How much time has passed since the last sample: a number, or a duration.
///
/// # Errors
/// `InvalidInput` names `elapsed` when it is neither.
pub fn read_elapsed(elapsed: Option<&Bound<'_, PyAny>>) -> PyResult<f64> {
    let Some(elapsed) = elapsed else { return Ok(1.0) };
    if let Ok(number) = elapsed.extract() {
        return Ok(number);
    }
    let refuse = |_| invalid(format!("elapsed = {elapsed:?}, allowed: a number or a duration"));
    match elapsed.call_method0("total_seconds") {
        Ok(seconds) => seconds.extract().map_err(refuse),
        Err(_) => in_seconds(elapsed).and_then(|seconds| seconds.extract()).map_err(refuse),
    }
}

/// The times of a record as an array of numbers, made from dates or durations where it holds these.
///
/// # Errors
/// `InvalidInput` names `time` when it holds neither.
pub fn read_times<'py>(time: Option<&Bound<'py, PyAny>>) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(time) = time else { return Ok(None) };
    let array = time.py().import("numpy")?.call_method1("asarray", (time,))?;
    let array = array.cast_into::<PyUntypedArray>()?;
    let numbers = match array.dtype().kind() {
        b'M' if array.len() > 0 => in_seconds(&array.sub(array.get_item(0)?)?)?,
        b'm' => in_seconds(&array)?,
        _ => array.into_any(),
    };
    Ok(Some(numbers))
}

/// The same as a value that can be passed on.
///
/// # Errors
/// `InvalidInput` names `time` when its values are not numbers.
pub fn times_input<'a, 'py>(
    time: Option<&'a Bound<'py, PyAny>>,
) -> PyResult<Option<Input<'a, 'py>>> {
    time.map(|time| Input::read("time", time, NumberType::F64)).transpose()
}

/// Durations of NumPy in seconds.
fn in_seconds<'py>(durations: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let second = durations.py().import("numpy")?.call_method1("timedelta64", (1, "s"))?;
    durations.div(second)
}
