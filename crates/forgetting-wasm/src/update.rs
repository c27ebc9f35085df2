//! What one sample did.

use crate::array::write;
use crate::object::object;
use forgetting::Skip;
use forgetting_runtime::{BankUpdate, Innovation, Update};
use wasm_bindgen::JsValue;

/// What an estimator reports.
pub fn write_update(update: &Update) -> JsValue {
    object([
        ("error", write_innovation(&update.error)),
        ("whitened_innovation", write_innovation(&update.whitened_innovation)),
        ("leverage", update.leverage.into()),
        ("weight", update.weight.into()),
        ("forgetting_factor", update.forgetting_factor.into()),
        ("rank", (update.rank as f64).into()),
        ("skipped", write_skip(update.skipped)),
        ("gate", update.gate.word().into()),
        ("windup", update.windup.into()),
    ])
}

/// What a bank reports.
pub fn write_bank_update(update: &BankUpdate) -> JsValue {
    object([
        ("error", write_innovation(&update.error)),
        ("leverage", update.leverage.into()),
        ("forgetting_factor", update.forgetting_factor.into()),
        ("skipped", write_skip(update.skipped)),
        ("windup", update.windup.into()),
        ("asleep", (update.asleep as f64).into()),
    ])
}

fn write_skip(skipped: Option<Skip>) -> JsValue {
    skipped.map_or(JsValue::NULL, |reason| reason.word().into())
}

/// One number a row and target: a number if there is one.
fn write_innovation(innovation: &Innovation) -> JsValue {
    match innovation {
        Innovation::Scalar(number) => (*number).into(),
        several => write(&several.array()),
    }
}
