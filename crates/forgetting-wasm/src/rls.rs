//! The class `RLS`.

use crate::array::write;
use crate::choice::write_description;
use crate::error::raise;
use crate::health::write_health;
use crate::record::{regressors, view, write_prediction, write_run, Given as Record, Sizes};
use crate::settings::Given;
use crate::update::write_update;
use forgetting_runtime::Estimator;
use js_sys::Array;
use wasm_bindgen::prelude::*;

/// Recursive least squares with generalized forgetting: follows θ of y = φθ + noise, sample by
/// sample.
///
/// Arrays go in as `Float64Array`, `Float32Array` or arrays of numbers, nested or one row after the
/// other, and come out as `Float64Array`, one row after the other. Whatever is refused is an `Error` whose name is
/// "InvalidInput", "NumericalRange" or "MemoryError", and has changed nothing.
#[wasm_bindgen]
#[allow(clippy::upper_case_acronyms, reason = "the name in every language")]
pub struct RLS {
    estimator: Estimator,
}

#[wasm_bindgen]
impl RLS {
    /// An estimator of n = `parameters` parameters, 1 to 32768.
    #[wasm_bindgen(constructor)]
    pub fn new(
        parameters: f64,
        #[wasm_bindgen(unchecked_optional_param_type = "Settings")] settings: &JsValue,
    ) -> Result<RLS, JsValue> {
        let given = Given::of_estimator(parameters, settings)?;
        Ok(Self { estimator: given.with(Estimator::new)? })
    }

    /// The estimator that `to_bytes` saved, in any language, bit for bit.
    pub fn from_bytes(state: &[u8]) -> Result<RLS, JsValue> {
        Ok(Self { estimator: Estimator::from_bytes(state).map_err(raise)? })
    }

    /// The estimator, configuration and state: portable, versioned and checked.
    pub fn to_bytes(&self) -> Result<Vec<u8>, JsValue> {
        self.estimator.to_bytes().map_err(raise)
    }

    /// Takes one sample: `phi` (n,) or (rows, n), `y` a number, (rows,), (targets,) or (rows,
    /// targets).
    #[wasm_bindgen(unchecked_return_type = "Update")]
    pub fn update(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] phi: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] y: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "UpdateOptions")] options: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let sample = Record::sample((phi, y, options), self.sizes())?;
        let (views, options) = (sample.views()?, sample.update_options());
        let update = self.estimator.update_with(views, options).map_err(raise)?;
        Ok(write_update(&update))
    }

    /// Takes a record of T samples, all or nothing: `phi` (T, n) or (T, rows, n), `y` (T,), (T,
    /// rows), (T, targets) or (T, rows, targets).
    #[wasm_bindgen(unchecked_return_type = "Run")]
    pub fn run(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] phi: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] y: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "RunOptions")] options: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let record = Record::record((phi, y, options), self.sizes())?;
        let views = record.views()?;
        let estimator = &mut self.estimator;
        let run = record.run(|options| estimator.run_while(views, options, &mut || Ok(())))?;
        Ok(write_run(&run))
    }

    /// φθ of one regressor (n,), or of many (T, n).
    #[wasm_bindgen(unchecked_return_type = "number | Float64Array")]
    pub fn predict(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] phi: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let phi = regressors(phi, self.estimator.parameters())?;
        let prediction = self.estimator.predict(view("phi", &phi)?).map_err(raise)?;
        Ok(write_prediction(&prediction))
    }

    /// Back to the initial estimate and covariance, as if there had been no sample.
    pub fn reset(&mut self) {
        self.estimator.reset();
    }

    /// n
    #[wasm_bindgen(getter)]
    pub fn parameters(&self) -> usize {
        self.estimator.parameters()
    }

    /// Samples used since the start.
    #[wasm_bindgen(getter)]
    pub fn samples(&self) -> f64 {
        self.estimator.samples() as f64
    }

    /// θ, (n,) or (n, targets).
    #[wasm_bindgen(getter, unchecked_return_type = "Float64Array")]
    pub fn theta(&self) -> JsValue {
        write(&self.estimator.theta())
    }

    /// P, (n, n), in units of 1/φ²: times the noise variance, it is the covariance of θ.
    #[wasm_bindgen(getter, unchecked_return_type = "Float64Array")]
    pub fn covariance(&self) -> Result<JsValue, JsValue> {
        Ok(write(&self.estimator.covariance().map_err(raise)?))
    }

    /// U (n, n), unit upper triangular, and the diagonal of D (n,), with P = U D Uᵀ.
    #[wasm_bindgen(unchecked_return_type = "[Float64Array, Float64Array]")]
    pub fn factor(&self) -> Result<Array, JsValue> {
        let (unit, diagonal) = self.estimator.factor().map_err(raise)?;
        Ok(Array::of2(&write(&unit), &write(&diagonal)))
    }

    /// The units (n,) in which regressors are measured, where no initial covariance was given.
    #[wasm_bindgen(getter, unchecked_return_type = "Float64Array | undefined")]
    pub fn units(&self) -> JsValue {
        self.estimator.units().map_or(JsValue::UNDEFINED, |units| write(&units))
    }

    /// What the monitor has found; undefined without one.
    #[wasm_bindgen(unchecked_return_type = "Health | undefined")]
    pub fn health(&self) -> JsValue {
        let (extremes, number_type) = (self.estimator.extremes(), self.estimator.number_type());
        let health = self.estimator.health();
        health.map_or(JsValue::UNDEFINED, |health| write_health(&health, extremes, number_type))
    }

    /// The rule, rate, weighting and gate by name, each with its parameters.
    #[wasm_bindgen(unchecked_return_type = "Description")]
    pub fn describe(&self) -> JsValue {
        write_description(&self.estimator.describe())
    }

    fn sizes(&self) -> Sizes {
        let estimator = &self.estimator;
        Sizes {
            parameters: estimator.parameters(),
            rows: estimator.rows(),
            targets: estimator.targets(),
        }
    }
}
