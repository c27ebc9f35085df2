//! What the monitor has found.

use crate::array::write;
use crate::object::object;
use forgetting_runtime::{Health, NumberType};
use wasm_bindgen::JsValue;

/// Growth of P beyond which information ends the alarm, but not the doubt.
const LASTING: f64 = 1000.0;

/// The health of an estimator whose D has these extremes; its status is that of Python.
pub fn write_health(health: &Health, extremes: (f64, f64), number_type: NumberType) -> JsValue {
    let (largest, smallest) = extremes;
    object([
        ("status", status(health, extremes, number_type).into()),
        ("largest_eigenvalue", largest.into()),
        ("smallest_eigenvalue", smallest.into()),
        ("windup", health.windup.into()),
        ("informed", health.informed.into()),
        ("direction", write(&health.direction)),
        ("least_variances", write(&health.least_variances)),
        ("variance", health.variance.into()),
        ("growth", health.growth.into()),
        ("since_informed", (health.since_informed as f64).into()),
        ("since_excited", write(&health.since_excited)),
        ("noise_variance", health.noise_variance.into()),
        ("correlation", health.correlation.into()),
        ("samples", (health.samples as f64).into()),
        ("weight", health.weight.into()),
    ])
}

fn status(health: &Health, (largest, smallest): (f64, f64), number_type: NumberType) -> &str {
    let edge = edge(number_type);
    let silence = health.since_excited.elements.to_f64().into_iter().fold(0.0, f64::max);
    if largest > edge || smallest < 1.0 / edge {
        "saturated"
    } else if health.windup {
        "windup"
    } else if silence >= 2.0 * health.block || !health.informed {
        "unexcited"
    } else if health.growth > LASTING {
        "recovering"
    } else {
        "ok"
    }
}

/// Beyond these bounds on D the covariance is at the edge of its number type.
fn edge(number_type: NumberType) -> f64 {
    match number_type {
        NumberType::F64 => 490f64.exp2(),
        NumberType::F32 => 55f64.exp2(),
    }
}
