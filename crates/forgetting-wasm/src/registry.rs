//! The registries as JavaScript's objects.

use crate::choice::write_value;
use crate::object::{object, set};
use forgetting::choice::{About, Axis, Kind, Parameter};
use forgetting::{Answer, Skip, AXES};
use forgetting_runtime::Value;
use js_sys::{Array, Object};
use wasm_bindgen::prelude::*;

/// The choices that make an estimator (rules, rates, weightings, gates, mixers): of each axis its
/// name, what it is, and its entries with what each does and its parameters.
#[wasm_bindgen(unchecked_return_type = "Axis[]")]
pub fn axes() -> Array {
    AXES.iter().map(axis).collect()
}

/// The words of the codes in the output `skipped` of a record: 0 is a sample that was used.
#[wasm_bindgen(unchecked_return_type = "Record<number, string>")]
pub fn skip_codes() -> JsValue {
    codes(Skip::ALL.iter().map(|reason| (reason.code(), reason.word())))
}

/// The words of the codes in the output `gate` of a record.
#[wasm_bindgen(unchecked_return_type = "Record<number, string>")]
pub fn gate_codes() -> JsValue {
    codes(Answer::ALL.iter().map(|answer| (answer.code(), answer.word())))
}

/// The version of the library.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").into()
}

fn codes(words: impl Iterator<Item = (u8, &'static str)>) -> JsValue {
    let codes = Object::new();
    for (code, word) in words {
        set(&codes, &code.to_string(), &word.into());
    }
    codes.into()
}

fn axis(axis: &Axis) -> JsValue {
    object([
        ("name", axis.name.into()),
        ("plural", axis.plural.into()),
        ("summary", axis.summary().collect::<Vec<_>>().join(" ").into()),
        ("entries", axis.entries.iter().map(entry).collect::<Array>().into()),
    ])
}

fn entry(about: &About) -> JsValue {
    let entry = object([
        ("name", about.name.into()),
        ("summary", about.summary().into()),
        ("parameters", about.parameters.iter().map(parameter).collect::<Array>().into()),
    ]);
    if let Some(guarantees) = about.guarantees {
        let fields: &Object = entry.unchecked_ref();
        set(fields, "forgetting_factor", &about.forgetting_factor.into());
        set(fields, "cost", &about.cost.into());
        set(fields, "largest_rows", &about.largest_rows.map(|rows| rows as f64).into());
        for (name, guarantee) in guarantees.named() {
            set(fields, name, &guarantee.claim.to_string().into());
        }
    }
    entry
}

fn parameter(parameter: &Parameter) -> JsValue {
    let words = match parameter.kind {
        Kind::Word(words) => words.iter().map(|&word| JsValue::from(word)).collect(),
        _ => Array::new(),
    };
    let default = parameter.default.and_then(Value::of_core);
    object([
        ("name", parameter.name.into()),
        ("about", parameter.about.into()),
        ("kind", parameter.kind.name().into()),
        ("range", parameter.allowed().to_string().into()),
        ("words", words.into()),
        ("required", parameter.is_required().into()),
        ("default", default.map_or(JsValue::NULL, |value| write_value(&value))),
    ])
}
