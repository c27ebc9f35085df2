//! A rule, a rate, a weighting or a gate as Python says it: a name, or an object with the attributes
//! `name` and `parameters`.

use crate::arrays::Input;
use crate::callable::{is_plain, Callable};
use crate::errors::{invalid, raise};
use forgetting_runtime::{Choice, ForgettingFactor, Function, NumberType, Numbers, Value};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyInt, PyList, PyString};
use std::sync::Arc;

/// From a name or from an object with `name` and `parameters`; nothing if there is none.
///
/// # Errors
/// `InvalidInput` names `what` when it is neither.
pub fn read(what: &str, object: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Choice>> {
    object.map(|object| read_choice(what, object)).transpose()
}

/// The gate; a callable is one, too.
///
/// # Errors
/// As for [`read`].
pub fn read_gate(object: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Choice>> {
    match object {
        Some(object) if is_plain(object)? => {
            Ok(Some(Choice::gate_function(Arc::new(Callable::new("gate", object)))))
        }
        object => read("gate", object),
    }
}

/// How much a rule object says to forget.
///
/// # Errors
/// As for [`read`].
pub fn read_forgetting_factor(rule: Option<&Bound<'_, PyAny>>) -> PyResult<ForgettingFactor> {
    let factor = rule.and_then(|rule| rule.getattr_opt("forgetting_factor").ok().flatten());
    Ok(match factor {
        None => ForgettingFactor::Default,
        Some(factor) if factor.is_none() => ForgettingFactor::None,
        Some(factor) => read_factor(&factor)?,
    })
}

/// How much to forget: a number or a rate.
///
/// # Errors
/// As for [`read`].
pub fn read_factor(factor: &Bound<'_, PyAny>) -> PyResult<ForgettingFactor> {
    match factor.extract() {
        Ok(number) => Ok(ForgettingFactor::constant(number)),
        Err(_) => Ok(ForgettingFactor::Rate(read_choice("forgetting_factor", factor)?)),
    }
}

fn read_choice(what: &str, object: &Bound<'_, PyAny>) -> PyResult<Choice> {
    if let Ok(name) = object.cast::<PyString>() {
        return Ok(Choice::named(name.to_string()));
    }
    let attribute = |name| {
        object.getattr(name).map_err(|_| {
            invalid(format!("{what} = {object:?}, allowed: a name or a {what} object"))
        })
    };
    let mut choice = Choice::named(attribute("name")?.extract::<String>()?);
    for (name, value) in attribute("parameters")?.cast_into::<PyDict>()? {
        let name: String = name.extract()?;
        if !value.is_none() {
            let value = read_value(&name, &value)?;
            choice.parameters.push((name, value));
        }
    }
    Ok(choice)
}

fn read_value(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(word) = value.cast::<PyString>() {
        return Ok(Value::Word(word.to_string()));
    }
    if value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>() {
        return value.extract().map(Value::Number);
    }
    if value.hasattr("name")? && value.hasattr("parameters")? {
        return read_choice(name, value).map(Value::Choice);
    }
    if value.is_callable() {
        let function: Arc<dyn Function> = Arc::new(Callable::new(name, value));
        return Ok(Value::Function(function));
    }
    let numbers = Input::read(name, value, NumberType::F64)?;
    let elements = match numbers.numbers()? {
        Numbers::F64(elements) => elements.to_vec(),
        Numbers::F32(elements) => elements.iter().map(|&x| f64::from(x)).collect(),
    };
    Value::array(name, elements, numbers.shape()).map_err(raise)
}

/// A choice for Python: a dictionary of its name and its parameters.
pub fn write<'py>(py: Python<'py>, choice: &Choice) -> PyResult<Bound<'py, PyDict>> {
    let (written, parameters) = (PyDict::new(py), PyDict::new(py));
    for (name, value) in &choice.parameters {
        parameters.set_item(name, write_value(py, value)?)?;
    }
    written.set_item("name", &choice.name)?;
    written.set_item("parameters", parameters)?;
    Ok(written)
}

/// A parameter's value for Python; numbers as lists, which compare and print as they were given.
pub fn write_value<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::Number(x) => Ok(PyFloat::new(py, *x).into_any()),
        Value::Word(word) => Ok(PyString::new(py, word).into_any()),
        Value::Matrix { rows: 1, elements, .. } => Ok(PyList::new(py, elements)?.into_any()),
        Value::Matrix { columns, elements, .. } => {
            let rows = elements.chunks(*columns).map(|row| PyList::new(py, row));
            Ok(PyList::new(py, rows.collect::<PyResult<Vec<_>>>()?)?.into_any())
        }
        Value::Function(function) => Ok(Callable::object(py, &**function)),
        Value::Choice(choice) => write(py, choice).map(Bound::into_any),
    }
}
