//! The class `Bank`.

use crate::array::write;
use crate::choice::{write_choice, write_description};
use crate::error::raise;
use crate::record::{regressors, view, write_prediction, write_run, Given as Record, Sizes};
use crate::settings::GivenBank;
use crate::update::write_bank_update;
use js_sys::Array;
use wasm_bindgen::prelude::*;

/// Several estimators on the same samples, mixed by what they have predicted: nothing need be
/// chosen. Arguments and results are those of `RLS`.
#[wasm_bindgen]
pub struct Bank {
    bank: forgetting_runtime::Bank,
}

#[wasm_bindgen]
impl Bank {
    /// A bank of n = `parameters` parameters, 1 to 32768.
    #[wasm_bindgen(constructor)]
    pub fn new(
        parameters: f64,
        #[wasm_bindgen(unchecked_optional_param_type = "BankSettings")] settings: &JsValue,
    ) -> Result<Bank, JsValue> {
        let given = GivenBank::new(parameters, settings)?;
        Ok(Self { bank: given.with(forgetting_runtime::Bank::new)? })
    }

    /// The bank that `to_bytes` saved, in any language, bit for bit.
    pub fn from_bytes(state: &[u8]) -> Result<Bank, JsValue> {
        Ok(Self { bank: forgetting_runtime::Bank::from_bytes(state).map_err(raise)? })
    }

    /// The bank, configuration and state: portable, versioned and checked.
    pub fn to_bytes(&self) -> Result<Vec<u8>, JsValue> {
        self.bank.to_bytes().map_err(raise)
    }

    /// Takes one sample, as `RLS.update`.
    #[wasm_bindgen(unchecked_return_type = "BankUpdate")]
    pub fn update(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] phi: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] y: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "UpdateOptions")] options: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let sample = Record::sample((phi, y, options), self.sizes())?;
        let (views, options) = (sample.views()?, sample.update_options());
        Ok(write_bank_update(&self.bank.update_with(views, options).map_err(raise)?))
    }

    /// Takes a record, as `RLS.run`.
    #[wasm_bindgen(unchecked_return_type = "Run")]
    pub fn run(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] phi: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] y: &JsValue,
        #[wasm_bindgen(unchecked_optional_param_type = "RunOptions")] options: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let record = Record::record((phi, y, options), self.sizes())?;
        let views = record.views()?;
        let bank = &mut self.bank;
        let run = record.run(|options| bank.run_while(views, options, &mut || Ok(())))?;
        Ok(write_run(&run))
    }

    /// φθ of one regressor (n,), or of many (T, n).
    #[wasm_bindgen(unchecked_return_type = "number | Float64Array")]
    pub fn predict(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Numbers")] phi: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let phi = regressors(phi, self.bank.parameters())?;
        Ok(write_prediction(&self.bank.predict(view("phi", &phi)?).map_err(raise)?))
    }

    /// Back to the start, as if there had been no sample.
    pub fn reset(&mut self) {
        self.bank.reset();
    }

    /// n
    #[wasm_bindgen(getter)]
    pub fn parameters(&self) -> usize {
        self.bank.parameters()
    }

    /// Samples used since the start.
    #[wasm_bindgen(getter)]
    pub fn samples(&self) -> f64 {
        self.bank.samples() as f64
    }

    /// θ, (n,) or (n, targets).
    #[wasm_bindgen(getter, unchecked_return_type = "Float64Array")]
    pub fn theta(&self) -> JsValue {
        write(&self.bank.theta())
    }

    /// P, (n, n), with what the members disagree about.
    #[wasm_bindgen(getter, unchecked_return_type = "Float64Array")]
    pub fn covariance(&self) -> JsValue {
        write(&self.bank.covariance())
    }

    /// How far each member is believed for the next sample, (members,).
    #[wasm_bindgen(getter, unchecked_return_type = "Float64Array")]
    pub fn weights(&self) -> JsValue {
        write(&self.bank.weights())
    }

    /// Over how many samples the bank remembers; may be infinite.
    #[wasm_bindgen(getter)]
    pub fn memory(&self) -> f64 {
        self.bank.memory()
    }

    /// The variance of the whitened noise, over up to the last thousand samples.
    #[wasm_bindgen(getter)]
    pub fn noise_variance(&self) -> f64 {
        self.bank.noise_variance()
    }

    /// The units (n,) in which regressors are measured, where no initial covariance was given.
    #[wasm_bindgen(getter, unchecked_return_type = "Float64Array | undefined")]
    pub fn units(&self) -> JsValue {
        self.bank.units().map_or(JsValue::UNDEFINED, |units| write(&units))
    }

    /// Rule, rate, weighting and gate of each member.
    #[wasm_bindgen(unchecked_return_type = "Description[]")]
    pub fn members(&self) -> Array {
        self.bank.members().iter().map(write_description).collect()
    }

    /// What mixes them.
    #[wasm_bindgen(unchecked_return_type = "Choice")]
    pub fn mixer(&self) -> JsValue {
        write_choice(&self.bank.mixer())
    }

    fn sizes(&self) -> Sizes {
        let bank = &self.bank;
        Sizes { parameters: bank.parameters(), rows: bank.rows(), targets: bank.targets() }
    }
}
