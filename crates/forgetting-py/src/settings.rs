//! What `RLS` and `Fleet` are given alike, and what both show.

use crate::arrays::{output, Input};
use crate::choice::{read, read_factor, read_forgetting_factor, read_gate, write};
use crate::errors::raise;
use forgetting_runtime::{size, Description, Health, NumberType, Settings, View};
use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::Borrowed;

/// The settings that choose a rule, a weighting and a gate, for n = `parameters`.
///
/// # Errors
/// `InvalidInput` names what is neither a name nor an object of its kind.
pub fn read_choices(
    Whole(parameters): Whole,
    rule: Option<&Bound<'_, PyAny>>,
    weighting: Option<&Bound<'_, PyAny>>,
    gate: Option<&Bound<'_, PyAny>>,
) -> PyResult<Settings<'static>> {
    let parameters = size("parameters", parameters).map_err(raise)?;
    Ok(Settings {
        rule: read("rule", rule)?,
        forgetting_factor: read_forgetting_factor(rule)?,
        weighting: read("weighting", weighting)?,
        gate: read_gate(gate)?,
        ..Settings::new(parameters)
    })
}

/// The same with this forgetting factor, a number or a rate, in the place of that of the rule.
///
/// # Errors
/// `InvalidInput` names it when it is neither, and the rule when it uses none.
pub fn with_factor<'a>(
    settings: Settings<'a>,
    factor: Option<&Bound<'_, PyAny>>,
) -> PyResult<Settings<'a>> {
    match factor {
        None => Ok(settings),
        Some(factor) => settings.with_forgetting_factor(read_factor(factor)?).map_err(raise),
    }
}

/// A whole number of Python's, whose numbers have no largest: one beyond 64 bits is the largest of
/// them, to be refused by whoever knows what is allowed.
#[derive(Clone, Copy)]
pub struct Whole(pub i64);

impl<'py> FromPyObject<'_, 'py> for Whole {
    type Error = PyErr;

    fn extract(number: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        match number.extract::<i64>() {
            Err(error) if error.is_instance_of::<PyOverflowError>(number.py()) => {
                Ok(Self(if number.gt(0)? { i64::MAX } else { i64::MIN }))
            }
            whole => whole.map(Self),
        }
    }
}

/// Numbers that may be left out.
///
/// # Errors
/// `InvalidInput` names the parameter when its values are not numbers.
pub fn read_optional<'a, 'py>(
    name: &str,
    values: Option<&'a Bound<'py, PyAny>>,
    number_type: NumberType,
) -> PyResult<Option<Input<'a, 'py>>> {
    values.map(|values| Input::read(name, values, number_type)).transpose()
}

/// The numbers of [`read_optional`] in their shape.
pub fn view<'a>(
    name: &'static str,
    input: &'a Option<Input<'_, '_>>,
) -> PyResult<Option<View<'a>>> {
    input.as_ref().map(|input| input.view(name)).transpose()
}

/// Names of outputs: one, or a sequence of them.
pub struct Names(Vec<String>);

impl<'py> FromPyObject<'_, 'py> for Names {
    type Error = PyErr;

    fn extract(names: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        match names.extract::<String>() {
            Ok(name) => Ok(Self(vec![name])),
            Err(_) => names.extract().map(Self),
        }
    }
}

/// Names of outputs as they are passed on.
pub fn names(outputs: Option<&Names>) -> Option<Vec<&str>> {
    outputs.map(|outputs| outputs.0.iter().map(String::as_str).collect())
}

/// A number type: its name, or NumPy's type.
pub struct Dtype(pub NumberType);

impl Dtype {
    /// The one that is taken if none is given.
    pub const DEFAULT: Self = Self(NumberType::F64);
}

impl<'py> FromPyObject<'_, 'py> for Dtype {
    type Error = PyErr;

    fn extract(dtype: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let name = match dtype.extract::<String>() {
            Ok(name) => name,
            Err(_) => {
                let numpy = dtype.py().import("numpy")?;
                numpy.call_method1("dtype", (dtype,))?.getattr("name")?.extract()?
            }
        };
        NumberType::named(&name).map(Self).map_err(raise)
    }
}

/// Rule, rate, weighting and gate by name, each with its parameters.
pub fn write_description<'py>(
    py: Python<'py>,
    description: &Description,
) -> PyResult<Bound<'py, PyDict>> {
    let Description { rule, rate, weighting, gate } = description;
    let written = PyDict::new(py);
    for (name, choice) in [("rule", rule), ("rate", rate), ("weighting", weighting), ("gate", gate)]
    {
        written.set_item(name, write(py, choice)?)?;
    }
    Ok(written)
}

/// What the monitor has found; the names are those of [`Health`].
pub fn write_health(py: Python<'_>, health: Health) -> PyResult<Bound<'_, PyDict>> {
    let written = PyDict::new(py);
    written.set_item("windup", health.windup)?;
    written.set_item("informed", health.informed)?;
    written.set_item("direction", output(py, health.direction)?)?;
    written.set_item("least_variances", output(py, health.least_variances)?)?;
    written.set_item("variance", health.variance)?;
    written.set_item("growth", health.growth)?;
    written.set_item("since_informed", health.since_informed)?;
    written.set_item("since_excited", output(py, health.since_excited)?)?;
    written.set_item("samples", health.samples)?;
    written.set_item("block", health.block)?;
    written.set_item("noise_variance", health.noise_variance)?;
    written.set_item("correlation", health.correlation)?;
    written.set_item("weight", health.weight)?;
    Ok(written)
}
