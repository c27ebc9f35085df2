//! The registries as Python dictionaries.

use crate::choice::write_value;
use forgetting::gates::{Answer, GATES};
use forgetting::parameter::{Kind, Parameter};
use forgetting::rates::RATES;
use forgetting::rules::{Claim, RULES};
use forgetting::weighting::WEIGHTINGS;
use forgetting::Skip;
use forgetting_runtime::{FleetUpdate, Value};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

fn claim(claim: Claim) -> String {
    match claim {
        Claim::Always => "always".into(),
        Claim::If(condition) => format!("if {condition}"),
        Claim::No => "no".into(),
    }
}

fn parameter<'py>(py: Python<'py>, parameter: &Parameter) -> PyResult<Bound<'py, PyDict>> {
    let entry = PyDict::new(py);
    let (kind, range) = match parameter.kind {
        Kind::Real => ("real", parameter.range.words.to_owned()),
        Kind::Whole => ("whole", parameter.range.words.to_owned()),
        Kind::Word(words) => ("word", words.join(", ")),
        Kind::Matrix => ("matrix", parameter.range.words.to_owned()),
        Kind::List => ("list", parameter.range.words.to_owned()),
        Kind::Rule => ("rule", "any rule".to_owned()),
        Kind::Function => ("function", "a function".to_owned()),
    };
    entry.set_item("name", parameter.name)?;
    entry.set_item("about", parameter.about)?;
    entry.set_item("kind", kind)?;
    entry.set_item("range", range)?;
    entry.set_item("required", parameter.default.is_none() && !parameter.optional)?;
    let default = Value::default_of(parameter);
    let default = default.map(|value| write_value(py, &value)).transpose()?;
    entry.set_item("default", default)?;
    Ok(entry)
}

/// What every registry says of its entries.
fn entry<'py>(
    py: Python<'py>,
    name: &str,
    type_name: &str,
    source: &str,
    parameters: &[Parameter],
) -> PyResult<Bound<'py, PyDict>> {
    let entry = PyDict::new(py);
    let header: Vec<&str> = source
        .lines()
        .take_while(|line| line.starts_with("//!"))
        .map(|line| line.trim_start_matches("//!").strip_prefix(' ').unwrap_or(""))
        .collect();
    entry.set_item("name", name)?;
    entry.set_item("type_name", type_name)?;
    entry.set_item("summary", header.first().copied().unwrap_or(""))?;
    entry.set_item("header", header.join("\n"))?;
    let parameters: PyResult<Vec<_>> = parameters.iter().map(|p| parameter(py, p)).collect();
    entry.set_item("parameters", PyList::new(py, parameters?)?)?;
    Ok(entry)
}

/// Every forgetting rule: name, type_name, summary, header, parameters, guarantees and cost.
#[pyfunction]
pub fn rules(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let describe = |about: &forgetting::rules::About| {
        let entry = entry(py, about.name, about.type_name, about.source, about.parameters)?;
        entry.set_item("forgetting_factor", about.forgetting_factor)?;
        entry.set_item("largest_rows", about.largest_rows)?;
        entry.set_item("proper", claim(about.proper))?;
        entry.set_item("bounded_above", claim(about.bounded_above))?;
        entry.set_item("bounded_below", claim(about.bounded_below))?;
        entry.set_item("cost", about.cost)?;
        Ok(entry)
    };
    RULES.iter().map(describe).collect()
}

/// Every rate: name, type_name, summary, header and parameters.
#[pyfunction]
pub fn rates(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    RATES.iter().map(|a| entry(py, a.name, a.type_name, a.source, a.parameters)).collect()
}

/// Every weighting: name, type_name, summary, header and parameters.
#[pyfunction]
pub fn weightings(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    WEIGHTINGS.iter().map(|a| entry(py, a.name, a.type_name, a.source, a.parameters)).collect()
}

/// Every gate: name, type_name, summary, header and parameters.
#[pyfunction]
pub fn gates(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    GATES.iter().map(|a| entry(py, a.name, a.type_name, a.source, a.parameters)).collect()
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
    codes.set_item(0, py.None())?;
    for reason in Skip::ALL {
        codes.set_item(reason.code(), reason.word())?;
    }
    codes.set_item(FleetUpdate::REFUSED, "refused")?;
    Ok(codes)
}
