//! A rule, a rate, a weighting or a gate as Python says it: a name, or an object with the attributes
//! `name` and `parameters`.

use crate::arrays::with_slice;
use crate::callable;
use crate::errors::{invalid, raise};
use crate::function::Callable;
use forgetting::choice::{Parameter, Value, Values};
use forgetting::function::MatrixFunction;
use forgetting::rules::RULES;
use forgetting::Error;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyInt, PyString};
use std::sync::Arc;

/// A parameter's value, taken from Python.
pub enum Given {
    Real(f64),
    Word(String),
    Matrix { rows: usize, columns: usize, elements: Box<dyn Fn(usize) -> f64 + Send + Sync> },
    Choice(Choice),
    Function(Arc<dyn MatrixFunction>),
}

/// A name and its parameters.
pub struct Choice {
    /// the registry name
    pub name: String,
    parameters: Vec<(String, Given)>,
}

impl Choice {
    /// By name alone.
    pub fn named(name: &str) -> Self {
        Self { name: name.into(), parameters: Vec::new() }
    }

    /// By name, with this one parameter.
    pub fn with_number(name: &str, parameter: &str, value: f64) -> Self {
        Self { name: name.into(), parameters: vec![(parameter.into(), Given::Real(value))] }
    }

    /// From a name or from an object with `name` and `parameters`.
    ///
    /// # Errors
    /// `InvalidInput` names `what` when it is neither.
    pub fn read(what: &str, object: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(name) = object.cast::<PyString>() {
            return Ok(Self { name: name.to_string(), parameters: Vec::new() });
        }
        let attribute = |name| {
            object.getattr(name).map_err(|_| {
                invalid(format!("{what} = {object:?}, allowed: a name or a {what} object"))
            })
        };
        let name = attribute("name")?.extract()?;
        let parameters = attribute("parameters")?.cast_into::<PyDict>()?;
        let mut given = Vec::new();
        for (name, value) in parameters {
            let name: String = name.extract()?;
            if !value.is_none() {
                let value = read_value(&name, &value)?;
                given.push((name, value));
            }
        }
        Ok(Self { name, parameters: given })
    }

    /// The callable given for the parameter `name`, if one was.
    pub fn callable<'py>(&self, py: Python<'py>, name: &str) -> Option<Bound<'py, PyAny>> {
        self.parameters.iter().find(|(known, _)| known == name).and_then(|(_, value)| match value {
            Given::Function(function) => Some(callable::python(py, function)),
            _ => None,
        })
    }

    /// Refuses a parameter that is not among `known`, then makes what is chosen.
    pub fn make<T>(
        &self,
        what: &str,
        known: Option<&[Parameter]>,
        make: impl FnOnce(&str, &dyn Values) -> Result<T, Error>,
    ) -> PyResult<T> {
        self.check_names(what, known)?;
        make(&self.name, self).map_err(|error| match error {
            Error::Unknown { .. } => invalid(format!("{what} = {:?} is not known", self.name)),
            error => raise(error),
        })
    }

    /// Refuses a parameter that is not among `known`, here and in a rule that is a parameter.
    fn check_names(&self, what: &str, known: Option<&[Parameter]>) -> PyResult<()> {
        for (name, value) in &self.parameters {
            if let Some(known) = known.filter(|known| !known.iter().any(|k| k.name == name)) {
                let names: Vec<_> = known.iter().map(|k| k.name).collect();
                return Err(invalid(format!(
                    "{what} {} has no parameter {name}; it has: {}",
                    self.name,
                    if names.is_empty() { "none".into() } else { names.join(", ") }
                )));
            }
            if let Given::Choice(inner) = value {
                let about = RULES.iter().find(|about| about.name == inner.name);
                inner.check_names(name, about.map(|about| about.parameters))?;
            }
        }
        Ok(())
    }
}

impl Values for Choice {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        self.parameters.iter().find(|(known, _)| known == name).map(|(_, value)| match value {
            Given::Real(x) => Value::Real(*x),
            Given::Word(word) => Value::Word(word),
            Given::Matrix { rows, columns, elements } => {
                Value::Matrix { rows: *rows, columns: *columns, elements }
            }
            Given::Function(function) => Value::Function(function),
            Given::Choice(inner) => Value::Choice { name: &inner.name, values: inner },
        })
    }
}

fn read_value(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Given> {
    if let Ok(word) = value.cast::<PyString>() {
        return Ok(Given::Word(word.to_string()));
    }
    if value.is_instance_of::<PyFloat>() || value.is_instance_of::<PyInt>() {
        return value.extract().map(Given::Real);
    }
    if value.hasattr("name")? && value.hasattr("parameters")? {
        return Choice::read(name, value).map(Given::Choice);
    }
    if value.is_callable() {
        return Ok(Given::Function(Arc::new(Callable::new(name, value))));
    }
    let shape = shape_of(name, value)?;
    let elements = with_slice::<f64, _>(name, value, |elements| Ok(elements.to_vec()))?;
    let at = move |elements: Vec<f64>| {
        Box::new(move |k: usize| elements.get(k).copied().unwrap_or(f64::NAN)) as Box<_>
    };
    match shape.as_slice() {
        [] => Ok(Given::Real(elements[0])),
        [columns] => Ok(Given::Matrix { rows: 1, columns: *columns, elements: at(elements) }),
        [rows, columns] => {
            // one row that is a matrix, not a list, is 1 x 1
            Ok(Given::Matrix { rows: *rows, columns: *columns, elements: at(elements) })
        }
        _ => Err(invalid(format!("{name} has {} dimensions, allowed: 0, 1 or 2", shape.len()))),
    }
}

/// The shape of anything that NumPy can make an array of.
pub fn shape_of(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    let shape = value.py().import("numpy")?.call_method1("shape", (value,));
    shape
        .and_then(|shape| shape.extract())
        .map_err(|error| invalid(format!("{name} must hold numbers ({error})")))
}

/// A parameter's value for Python.
pub fn write_value<'py>(py: Python<'py>, value: Value<'_>) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::Real(x) => Ok(PyFloat::new(py, x).into_any()),
        Value::Word(word) => Ok(PyString::new(py, word).into_any()),
        Value::Matrix { rows, columns, elements } => {
            let elements: Vec<f64> = (0..rows * columns).map(elements).collect();
            let shape: &[usize] = if rows == 1 { &[columns] } else { &[rows, columns] };
            // a list compares and prints as it was given
            crate::arrays::shaped(py, elements, shape)?.call_method0("tolist")
        }
        Value::Function(function) => Ok(callable::python(py, function)),
        Value::Choice { name, values } => {
            write_choice(py, name, |each| values.each(each)).map(Bound::into_any)
        }
    }
}

/// A choice for Python: a dictionary of its name and its parameters.
pub fn write_choice<'py>(
    py: Python<'py>,
    name: &str,
    each: impl FnOnce(&mut dyn FnMut(&str, Value<'_>)),
) -> PyResult<Bound<'py, PyDict>> {
    let (choice, parameters) = (PyDict::new(py), PyDict::new(py));
    let mut outcome = Ok(());
    each(&mut |name, value| {
        let written = write_value(py, value).and_then(|value| parameters.set_item(name, value));
        if written.is_err() {
            outcome = written;
        }
    });
    outcome?;
    choice.set_item("name", name)?;
    choice.set_item("parameters", parameters)?;
    Ok(choice)
}
