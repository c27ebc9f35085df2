//! The registries as Python dictionaries.

use crate::choice::{read, write_value};
use crate::errors::raise;
use forgetting::choice::{About, Axis, Constants, Guarantees, Parameter, Setting};
use forgetting::gates::Answer;
use forgetting::AXES;
use forgetting_runtime::{covariance_bounds, Choice, CovarianceBounds, FleetUpdate, Value};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// What a rule guarantees, in words, and the settings in which each claim holds and fails.
fn write_guarantees(entry: &Bound<'_, PyDict>, guarantees: &Guarantees) -> PyResult<()> {
    let settings = PyDict::new(entry.py());
    for (name, guarantee) in guarantees.named() {
        let shown = PyDict::new(entry.py());
        shown.set_item("holds", setting(entry.py(), guarantee.holds)?)?;
        shown.set_item("fails", setting(entry.py(), guarantee.fails)?)?;
        settings.set_item(name, shown)?;
        entry.set_item(name, guarantee.claim.to_string())?;
    }
    entry.set_item("settings", settings)
}

fn setting(py: Python<'_>, setting: Option<Setting>) -> PyResult<Option<Bound<'_, PyDict>>> {
    let Some(Setting { parameters, forgetting_factor, variance, input, error }) = setting else {
        return Ok(None);
    };
    let (written, values) = (PyDict::new(py), PyDict::new(py));
    for &(name, value) in parameters {
        let value = Value::of_core(value).map(|value| write_value(py, &value)).transpose()?;
        values.set_item(name, value)?;
    }
    written.set_item("parameters", values)?;
    written.set_item("forgetting_factor", forgetting_factor)?;
    written.set_item("variance", variance)?;
    written.set_item("input", format!("{input:?}"))?;
    written.set_item("error", error)?;
    Ok(Some(written))
}

fn parameter<'py>(py: Python<'py>, parameter: &Parameter) -> PyResult<Bound<'py, PyDict>> {
    let entry = PyDict::new(py);
    entry.set_item("name", parameter.name)?;
    entry.set_item("about", parameter.about)?;
    entry.set_item("kind", parameter.kind.name())?;
    entry.set_item("range", parameter.allowed().to_string())?;
    entry.set_item("required", parameter.is_required())?;
    let default = parameter.default.and_then(Value::of_core);
    let default = default.map(|value| write_value(py, &value)).transpose()?;
    entry.set_item("default", default)?;
    Ok(entry)
}

/// The entry of a registry.
fn entry<'py>(py: Python<'py>, about: &About) -> PyResult<Bound<'py, PyDict>> {
    let entry = PyDict::new(py);
    entry.set_item("name", about.name)?;
    entry.set_item("type_name", about.type_name)?;
    entry.set_item("summary", about.summary())?;
    entry.set_item("header", about.header().collect::<Vec<_>>().join("\n"))?;
    let parameters: PyResult<Vec<_>> = about.parameters.iter().map(|p| parameter(py, p)).collect();
    entry.set_item("parameters", PyList::new(py, parameters?)?)?;
    if let Some(guarantees) = about.guarantees {
        entry.set_item("forgetting_factor", about.forgetting_factor)?;
        entry.set_item("largest_rows", about.largest_rows)?;
        write_guarantees(&entry, &guarantees)?;
        entry.set_item("cost", about.cost)?;
    }
    Ok(entry)
}

/// The choices that make an estimator: name, plural, summary and entries of each.
///
/// An entry has name, type_name, summary, header and parameters; that of a rule also
/// forgetting_factor, largest_rows, its guarantees (proper, bounded_above, bounded_below), the
/// settings that show them, and cost.
#[pyfunction]
pub fn axes(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let describe = |axis: &Axis| {
        let dictionary = PyDict::new(py);
        dictionary.set_item("name", axis.name)?;
        dictionary.set_item("plural", axis.plural)?;
        dictionary.set_item("summary", axis.summary().collect::<Vec<_>>().join(" "))?;
        let entries: PyResult<Vec<_>> = axis.entries.iter().map(|about| entry(py, about)).collect();
        dictionary.set_item("entries", PyList::new(py, entries?)?)?;
        Ok(dictionary)
    };
    AXES.iter().map(describe).collect()
}

/// The bounds that a rule states for the eigenvalues of P, P_0 taken in: the lower, the upper (None
/// where there is none, or no formula), and whether P stays bounded whatever the input.
#[pyfunction]
pub fn bounds(
    rule: &Bound<'_, PyAny>,
    parameters: usize,
    initial: (f64, f64),
    forgetting_factors: (f64, f64),
    regressor_bound: f64,
) -> PyResult<(Option<f64>, Option<f64>, bool)> {
    let rule = read("rule", Some(rule))?.unwrap_or_else(|| Choice::named(""));
    let constants = Constants { parameters, initial, forgetting_factors, regressor_bound };
    let CovarianceBounds { below, above, bounded } =
        covariance_bounds(&rule, &constants).map_err(raise)?;
    Ok((below, above, bounded))
}

/// The codes of a record's `gate`: 0 is "update".
pub fn gate_codes(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let codes = PyDict::new(py);
    for answer in Answer::ALL {
        codes.set_item(answer.code(), answer.word())?;
    }
    Ok(codes)
}

/// The codes of `skipped` in the results of a record or a fleet: 0 is None.
pub fn skip_codes(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let codes = PyDict::new(py);
    for (code, word) in FleetUpdate::codes() {
        codes.set_item(code, word)?;
    }
    Ok(codes)
}
