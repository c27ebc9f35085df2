//! Samples and records, in and out.

use crate::array::{read, read_given, write, Numbers};
use crate::error::raise;
use crate::object::{fields, object, set, unknown, word};
use forgetting_runtime::{Missing, Run, RunOptions, UpdateOptions, View};
use js_sys::Object;
use wasm_bindgen::{JsCast, JsValue};

/// n, p and m of an estimator or a bank.
#[derive(Clone, Copy)]
pub struct Sizes {
    pub parameters: usize,
    pub rows: usize,
    pub targets: usize,
}

/// A sample or a record, and how it is taken.
pub struct Given {
    phi: Numbers,
    y: Numbers,
    gamma: Option<Numbers>,
    missing: Missing,
    elapsed: f64,
    time: Option<Numbers>,
    outputs: Option<Vec<String>>,
}

impl Given {
    fn new(
        (phi, y, options): (&JsValue, &JsValue, &JsValue),
        allowed: &[&str],
    ) -> Result<Self, JsValue> {
        let mut given = Self {
            phi: read("phi", phi)?,
            y: read("y", y)?,
            gamma: None,
            missing: Missing::Error,
            elapsed: 1.0,
            time: None,
            outputs: None,
        };
        for (name, value) in fields("options", options)? {
            match name.as_str() {
                name if !allowed.contains(&name) => {
                    return Err(unknown("options", name, &allowed.join(", ")));
                }
                "gamma" => given.gamma = read_given("gamma", &value)?,
                "missing" => {
                    given.missing = Missing::named(&word("missing", &value)?).map_err(raise)?;
                }
                "time" => given.time = read_given("time", &value)?,
                "outputs" => given.outputs = Some(words("outputs", &value)?),
                _ => given.elapsed = value.as_f64().unwrap_or(f64::NAN),
            }
        }
        Ok(given)
    }

    /// One sample.
    pub fn sample(given: (&JsValue, &JsValue, &JsValue), sizes: Sizes) -> Result<Self, JsValue> {
        let Sizes { parameters: n, rows: p, targets: m } = sizes;
        let mut sample = Self::new(given, &["gamma", "missing", "elapsed"])?;
        fold(&mut sample.phi, &[p, n]);
        fold(&mut sample.y, &[p, m]);
        if let Some(gamma) = &mut sample.gamma {
            fold(gamma, &[p, p]);
        }
        Ok(sample)
    }

    /// A record.
    pub fn record(given: (&JsValue, &JsValue, &JsValue), sizes: Sizes) -> Result<Self, JsValue> {
        let Sizes { parameters: n, rows: p, targets: m } = sizes;
        let mut record = Self::new(given, &["gamma", "missing", "time", "outputs"])?;
        let samples = record.phi.0.len() / (p * n);
        fold(&mut record.phi, &[samples, p, n]);
        fold(&mut record.y, &[samples, p, m]);
        if let Some(gamma) = record.gamma.as_mut().filter(|_| p > 1) {
            fold(gamma, &[samples, p, p]);
        }
        Ok(record)
    }

    /// φ, y and Γ.
    pub fn views(&self) -> Result<(View<'_>, View<'_>, Option<View<'_>>), JsValue> {
        let gamma = self.gamma.as_ref().map(|gamma| view("gamma", gamma)).transpose()?;
        Ok((view("phi", &self.phi)?, view("y", &self.y)?, gamma))
    }

    /// How the sample is taken.
    pub fn update_options(&self) -> UpdateOptions {
        UpdateOptions { elapsed: self.elapsed, missing: self.missing }
    }

    /// What `run` makes of the options of a record.
    pub fn run(
        &self,
        run: impl FnOnce(&RunOptions<'_>) -> Result<Run, forgetting_runtime::Error>,
    ) -> Result<Run, JsValue> {
        let names: Option<Vec<&str>> =
            self.outputs.as_ref().map(|names| names.iter().map(String::as_str).collect());
        let time = self.time.as_ref().map(|time| view("time", time)).transpose()?;
        let options = RunOptions { time, ..RunOptions::new(self.missing, names.as_deref()) };
        run(&options).map_err(raise)
    }
}

/// Numbers in one dimension as those of this shape, where there are as many.
fn fold((numbers, shape): &mut Numbers, full: &[usize]) {
    if shape.len() == 1 && numbers.len() == full.iter().product::<usize>() {
        *shape = full.to_vec();
    }
}

/// The view of an argument.
pub fn view<'a>(
    parameter: &'static str,
    (numbers, shape): &'a Numbers,
) -> Result<View<'a>, JsValue> {
    View::new(parameter, numbers.as_slice(), shape).map_err(raise)
}

/// One word or several.
fn words(parameter: &str, value: &JsValue) -> Result<Vec<String>, JsValue> {
    if !js_sys::Array::is_array(value) {
        return Ok(vec![word(parameter, value)?]);
    }
    js_sys::Array::from(value).iter().map(|each| word(parameter, &each)).collect()
}

/// Regressors to predict from: one, or many in two dimensions or one after the other.
pub fn regressors(phi: &JsValue, parameters: usize) -> Result<Numbers, JsValue> {
    let mut phi = read("phi", phi)?;
    let several = phi.0.len() / parameters;
    if several > 1 {
        fold(&mut phi, &[several, parameters]);
    }
    Ok(phi)
}

/// The results of a record.
pub fn write_run(run: &Run) -> JsValue {
    let written =
        object([("samples", (run.samples as f64).into()), ("used", (run.used as f64).into())]);
    for (name, array) in &run.outputs {
        set(written.unchecked_ref::<Object>(), name, &write(array));
    }
    written
}

/// A prediction: a number if there is one.
pub fn write_prediction(prediction: &forgetting_runtime::Array) -> JsValue {
    match *prediction.elements.to_f64() {
        [number] if prediction.shape.is_empty() => number.into(),
        _ => write(prediction),
    }
}
