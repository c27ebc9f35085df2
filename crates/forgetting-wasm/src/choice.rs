//! A rule, a rate, a weighting, a gate or a mixer as JavaScript says it: a name, or an object of the
//! name and the parameters.

use crate::array::{read, write};
use crate::error::{invalid, raise};
use crate::object::{fields, object, set, shown, word};
use forgetting_runtime::{Array, Choice, Description, Elements, ForgettingFactor, Value};
use js_sys::Object;
use wasm_bindgen::JsValue;

/// The name of the field that a rule has besides its own parameters.
const FACTOR: &str = "forgetting_factor";

/// The choice that `value` says, and the forgetting factor in it, if it has one: of a rule in a rule
/// it is that of both.
fn read_with_factor(what: &str, value: &JsValue) -> Result<(Choice, Option<JsValue>), JsValue> {
    read_at(what, value, true)
}

/// The same; a rule that is in another holds none itself.
fn read_at(
    what: &str,
    value: &JsValue,
    holds_another: bool,
) -> Result<(Choice, Option<JsValue>), JsValue> {
    if let Some(name) = value.as_string() {
        return Ok((Choice::named(name), None));
    }
    let (mut choice, mut factor) = (Choice::named(""), None);
    for (name, value) in fields(what, value)? {
        match name.as_str() {
            "name" => choice.name = word(&format!("{what}.name"), &value)?,
            FACTOR if what == "rule" => factor = Some(value),
            _ if holds_another && value.is_object() && !is_array(&value) => {
                let (inner, its_factor) = read_at("rule", &value, false)?;
                factor = factor.or(its_factor);
                choice.parameters.push((name, inner.into()));
            }
            _ => {
                let value = read_value(&name, &value)?;
                choice.parameters.push((name, value));
            }
        }
    }
    if choice.name.is_empty() {
        let shown = shown(value);
        return Err(invalid(&format!(
            "{what} = {shown}, allowed: a name, or an object with a name"
        )));
    }
    Ok((choice, factor))
}

fn is_array(value: &JsValue) -> bool {
    js_sys::Array::is_array(value) || js_sys::ArrayBuffer::is_view(value)
}

/// The value of a parameter that is no choice.
fn read_value(name: &str, value: &JsValue) -> Result<Value, JsValue> {
    if let Some(word) = value.as_string() {
        return Ok(Value::Word(word));
    }
    let (numbers, shape) = read(name, value)?;
    Value::array(name, numbers, &shape).map_err(raise)
}

/// The choice that `value` says, none if it is not given.
pub fn read_choice(what: &str, value: &JsValue) -> Result<Option<Choice>, JsValue> {
    match value.is_undefined() || value.is_null() {
        true => Ok(None),
        false => read_with_factor(what, value).map(|(choice, _)| Some(choice)),
    }
}

/// A rule and the forgetting factor in it; none if it is not given.
pub fn read_rule(value: &JsValue) -> Result<Option<(Choice, Option<ForgettingFactor>)>, JsValue> {
    if value.is_undefined() || value.is_null() {
        return Ok(None);
    }
    let (choice, factor) = read_with_factor("rule", value)?;
    let factor = factor.map(|factor| read_factor(&factor)).transpose()?;
    Ok(Some((choice, factor)))
}

/// How much to forget: a number, null for nothing by a factor, or a rate.
pub fn read_factor(value: &JsValue) -> Result<ForgettingFactor, JsValue> {
    if value.is_null() {
        return Ok(ForgettingFactor::None);
    }
    match value.as_f64() {
        Some(number) => Ok(ForgettingFactor::constant(number)),
        None => Ok(ForgettingFactor::Rate(read_with_factor(FACTOR, value)?.0)),
    }
}

/// A choice as an object of its name and its parameters.
pub fn write_choice(choice: &Choice) -> JsValue {
    let written = Object::new();
    set(&written, "name", &choice.name.as_str().into());
    for (name, value) in &choice.parameters {
        set(&written, name, &write_value(value));
    }
    written.into()
}

/// The value of a parameter: a number, a word, a list, rows of a matrix, or a choice.
pub fn write_value(value: &Value) -> JsValue {
    match value {
        Value::Number(number) => (*number).into(),
        Value::Word(word) => word.as_str().into(),
        Value::Matrix { rows: 1, elements, .. } => row(elements),
        Value::Matrix { columns, elements, .. } => {
            elements.chunks(*columns).map(row).collect::<js_sys::Array>().into()
        }
        Value::Choice(choice) => write_choice(choice),
        Value::Function(_) => JsValue::NULL,
    }
}

fn row(numbers: &[f64]) -> JsValue {
    write(&Array { shape: vec![numbers.len()], elements: Elements::F64(numbers.to_vec()) })
}

/// Rule, rate, weighting and gate.
pub fn write_description(description: &Description) -> JsValue {
    object([
        ("rule", write_choice(&description.rule)),
        ("rate", write_choice(&description.rate)),
        ("weighting", write_choice(&description.weighting)),
        ("gate", write_choice(&description.gate)),
    ])
}
