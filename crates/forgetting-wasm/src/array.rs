//! Numbers and arrays, in and out.

use crate::error::invalid;
use crate::object::shown;
use forgetting_runtime::{Array, Elements};
use js_sys::{Float32Array, Float64Array, Int32Array, Uint8Array};
use wasm_bindgen::{JsCast, JsValue};

/// Numbers, the last dimension next to each other, and their shape.
pub type Numbers = (Vec<f64>, Vec<usize>);

/// The numbers of `parameter`, rows of nested arrays one after the other, and their shape: () of a
/// number, else one dimension, or two where arrays are nested.
pub fn read(parameter: &str, value: &JsValue) -> Result<Numbers, JsValue> {
    if let Some(number) = value.as_f64() {
        return Ok((vec![number], vec![]));
    }
    if let Some(numbers) = flat(value) {
        let shape = vec![numbers.len()];
        return Ok((numbers, shape));
    }
    match js_sys::Array::is_array(value) {
        true => nested(parameter, &js_sys::Array::from(value)),
        false => Err(refused(parameter, value)),
    }
}

/// The numbers of a typed array, or of an array of nothing but numbers.
fn flat(value: &JsValue) -> Option<Vec<f64>> {
    if let Some(array) = value.dyn_ref::<Float64Array>() {
        return Some(array.to_vec());
    }
    if let Some(array) = value.dyn_ref::<Float32Array>() {
        return Some(array.to_vec().into_iter().map(f64::from).collect());
    }
    let array = js_sys::Array::is_array(value).then(|| js_sys::Array::from(value))?;
    array.iter().map(|element| element.as_f64()).collect()
}

/// Rows of equal length.
fn nested(parameter: &str, rows: &js_sys::Array) -> Result<Numbers, JsValue> {
    let (mut numbers, mut columns) = (Vec::new(), None);
    for row in rows.iter() {
        let row = flat(&row).ok_or_else(|| refused(parameter, &row))?;
        if *columns.get_or_insert(row.len()) != row.len() {
            return Err(invalid(&format!("{parameter} has rows of different lengths")));
        }
        numbers.extend(row);
    }
    Ok((numbers, vec![rows.length() as usize, columns.unwrap_or(0)]))
}

fn refused(parameter: &str, value: &JsValue) -> JsValue {
    let allowed = "a number, a Float64Array, a Float32Array or an array of numbers";
    invalid(&format!("{parameter} has {}, allowed: {allowed}", shown(value)))
}

/// The same if it is given.
pub fn read_given(parameter: &str, value: &JsValue) -> Result<Option<Numbers>, JsValue> {
    match value.is_undefined() || value.is_null() {
        true => Ok(None),
        false => read(parameter, value).map(Some),
    }
}

/// An array as a typed array: of codes and of yes or no a `Uint8Array`, of counts an `Int32Array`,
/// else a `Float64Array`, into which numbers of 32 bits go without a change.
pub fn write(array: &Array) -> JsValue {
    match &array.elements {
        Elements::F64(numbers) => Float64Array::from(numbers.as_slice()).into(),
        Elements::U8(codes) => Uint8Array::from(codes.as_slice()).into(),
        Elements::I64(counts) => {
            let counts: Vec<_> = counts.iter().map(|&count| clipped(count)).collect();
            Int32Array::from(counts.as_slice()).into()
        }
        Elements::Bool(marks) => {
            let marks: Vec<_> = marks.iter().map(|&yes| u8::from(yes)).collect();
            Uint8Array::from(marks.as_slice()).into()
        }
        elements @ Elements::F32(_) => Float64Array::from(elements.to_f64().as_slice()).into(),
    }
}

fn clipped(count: i64) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}
