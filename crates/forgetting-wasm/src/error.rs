//! Refusals as JavaScript's errors.

use forgetting_runtime::{Error, Kind};
use wasm_bindgen::JsValue;

/// What was refused, with the name that Python's exception has.
pub fn raise(error: impl Into<Error>) -> JsValue {
    let error = error.into();
    let name = match error.kind() {
        Kind::Range => "NumericalRange",
        Kind::Memory => "MemoryError",
        _ => "InvalidInput",
    };
    named(name, &error.to_string())
}

/// A refusal of an argument, in these words.
pub fn invalid(words: &str) -> JsValue {
    named("InvalidInput", words)
}

fn named(name: &str, words: &str) -> JsValue {
    let error = js_sys::Error::new(words);
    error.set_name(name);
    error.into()
}
