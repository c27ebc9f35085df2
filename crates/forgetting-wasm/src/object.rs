//! JavaScript's objects, in and out.

use crate::error::invalid;
use js_sys::{Array, Object, Reflect};
use wasm_bindgen::{JsCast, JsValue};

/// An object of these fields.
pub fn object<const N: usize>(fields: [(&str, JsValue); N]) -> JsValue {
    let object = Object::new();
    for (name, value) in fields {
        set(&object, name, &value);
    }
    object.into()
}

/// Sets a field of an object that was made here.
pub fn set(object: &Object, name: &str, value: &JsValue) {
    let set = Reflect::set(object, &name.into(), value);
    debug_assert!(set.is_ok(), "a new object takes any field");
}

/// The fields of the value of `parameter` with their names, those that are undefined left out; none
/// if it is undefined or null itself.
pub fn fields(parameter: &str, value: &JsValue) -> Result<Vec<(String, JsValue)>, JsValue> {
    if value.is_undefined() || value.is_null() {
        return Ok(Vec::new());
    }
    let plain =
        value.dyn_ref::<Object>().filter(|_| !value.is_function() && !Array::is_array(value));
    let Some(object) = plain else {
        return Err(invalid(&format!("{parameter} = {}, allowed: an object", shown(value))));
    };
    let entries = Object::entries(object).into_iter().map(|entry| {
        let entry = Array::from(&entry);
        (entry.get(0).as_string().unwrap_or_default(), entry.get(1))
    });
    Ok(entries.filter(|(_, value)| !value.is_undefined()).collect())
}

/// Refuses a field of `parameter` that it does not have.
pub fn unknown(parameter: &str, name: &str, allowed: &str) -> JsValue {
    invalid(&format!("{parameter} has no {name}; it has: {allowed}"))
}

/// A whole number.
pub fn whole(parameter: &str, value: &JsValue) -> Result<i64, JsValue> {
    match value.as_f64().filter(|x| x.fract() == 0.0 && x.abs() < 9e15) {
        Some(number) => Ok(number as i64),
        None => Err(invalid(&format!("{parameter} = {}, allowed: a whole number", shown(value)))),
    }
}

/// A word.
pub fn word(parameter: &str, value: &JsValue) -> Result<String, JsValue> {
    value
        .as_string()
        .ok_or_else(|| invalid(&format!("{parameter} = {}, allowed: a word", shown(value))))
}

/// A value as errors show it.
pub fn shown(value: &JsValue) -> String {
    match (value.as_string(), value.as_f64(), value.as_bool()) {
        (Some(word), ..) => format!("{word:?}"),
        (_, Some(number), _) if number.abs() >= 1e15 => format!("{number:e}"),
        (_, Some(number), _) => number.to_string(),
        (.., Some(yes)) => yes.to_string(),
        _ if value.is_undefined() => "undefined".into(),
        _ if value.is_null() => "null".into(),
        _ if value.is_function() => "a function".into(),
        _ if Array::is_array(value) => "an array".into(),
        _ if value.is_object() => "an object".into(),
        _ => "something else".into(),
    }
}
