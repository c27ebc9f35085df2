//! What an estimator or a bank is made from.

use crate::array::{read_given, Numbers};
use crate::choice::{read_choice, read_factor, read_rule};
use crate::error::{invalid, raise};
use crate::object::{fields, shown, unknown, whole, word};
use forgetting_runtime::{
    size, BankSettings, Choice, ForgettingFactor, Member, NumberType, Settings, View,
};
use wasm_bindgen::JsValue;

const OF_AN_ESTIMATOR: &str = "rule, forgetting_factor, weighting, gate, initial_covariance, \
                               initial_theta, rows, targets, dtype, monitor";
const OF_A_BANK: &str =
    "members, mixer, weighting, gate, initial_covariance, initial_theta, rows, targets, dtype";

/// The settings of an estimator and the arrays that they look at.
pub struct Given {
    settings: Settings<'static>,
    covariance: Option<Numbers>,
    theta: Option<Numbers>,
}

impl Given {
    /// With `parameters` and the fields of `value`; what is left out takes its default.
    pub fn of_estimator(parameters: f64, value: &JsValue) -> Result<Self, JsValue> {
        let mut given = Self::new(parameters)?;
        let (mut factor, mut of_rule) = (None, None);
        for (name, value) in fields("settings", value)? {
            match name.as_str() {
                "rule" => {
                    let read = read_rule(&value)?;
                    of_rule = read.as_ref().and_then(|(_, factor)| factor.clone());
                    given.settings.rule = read.map(|(rule, _)| rule);
                }
                "forgetting_factor" => factor = Some(read_factor(&value)?),
                "monitor" => given.settings.monitor = yes("monitor", &value)?,
                name if given.take(name, &value)? => {}
                name => return Err(unknown("settings", name, OF_AN_ESTIMATOR)),
            }
        }
        if factor.is_some() && of_rule.is_some() {
            return Err(invalid("forgetting_factor is given twice: in the rule and beside it"));
        }
        if let Some(factor) = factor.or(of_rule) {
            given.settings = with_factor(given.settings, factor)?;
        }
        Ok(given)
    }

    fn new(parameters: f64) -> Result<Self, JsValue> {
        let parameters =
            size("parameters", whole("parameters", &parameters.into())?).map_err(raise)?;
        Ok(Self { settings: Settings::new(parameters), covariance: None, theta: None })
    }

    /// Takes a field that estimators and banks share; no if there is none of this name.
    fn take(&mut self, name: &str, value: &JsValue) -> Result<bool, JsValue> {
        let settings = &mut self.settings;
        match name {
            "weighting" => settings.weighting = read_choice("weighting", value)?,
            "gate" => settings.gate = read_choice("gate", value)?,
            "initial_covariance" => self.covariance = read_given(name, value)?,
            "initial_theta" => self.theta = read_given(name, value)?,
            "rows" => settings.rows = size("rows", whole(name, value)?).map_err(raise)?,
            "targets" => settings.targets = size("targets", whole(name, value)?).map_err(raise)?,
            "dtype" => {
                settings.number_type = NumberType::named(&word(name, value)?).map_err(raise)?
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What `use_them` makes of the settings.
    pub fn with<T>(
        &self,
        use_them: impl FnOnce(&Settings<'_>) -> Result<T, forgetting_runtime::Error>,
    ) -> Result<T, JsValue> {
        let settings = Settings {
            initial_covariance: view("initial_covariance", &self.covariance)?,
            initial_theta: view("initial_theta", &self.theta)?,
            ..self.settings.clone()
        };
        use_them(&settings).map_err(raise)
    }
}

/// The settings of a bank.
pub struct GivenBank {
    common: Given,
    members: Option<Vec<Member>>,
    mixer: Option<Choice>,
}

impl GivenBank {
    /// As [`Given::of_estimator`].
    pub fn new(parameters: f64, value: &JsValue) -> Result<Self, JsValue> {
        let mut given = Self { common: Given::new(parameters)?, members: None, mixer: None };
        for (name, value) in fields("settings", value)? {
            match name.as_str() {
                "mixer" => given.mixer = read_choice("mixer", &value)?,
                "members" => given.members = Some(read_members(&value)?),
                name if given.common.take(name, &value)? => {}
                name => return Err(unknown("settings", name, OF_A_BANK)),
            }
        }
        Ok(given)
    }

    /// As [`Given::with`].
    pub fn with<T>(
        self,
        use_them: impl FnOnce(&BankSettings<'_>) -> Result<T, forgetting_runtime::Error>,
    ) -> Result<T, JsValue> {
        let Self { common, members, mixer } = self;
        common.with(|settings| use_them(&BankSettings { common: settings.clone(), members, mixer }))
    }
}

fn read_members(value: &JsValue) -> Result<Vec<Member>, JsValue> {
    if !js_sys::Array::is_array(value) {
        let shown = shown(value);
        return Err(invalid(&format!("members = {shown}, allowed: an array of rules")));
    }
    let members = js_sys::Array::from(value);
    members
        .iter()
        .map(|member| {
            let rule = read_rule(&member)?;
            let (rule, factor) = rule.ok_or_else(|| invalid("members has no rule in a place"))?;
            Ok(Member { rule, forgetting_factor: factor.unwrap_or_default() })
        })
        .collect()
}

/// The settings with this factor, refused if the rule uses none.
fn with_factor(
    settings: Settings<'static>,
    factor: ForgettingFactor,
) -> Result<Settings<'static>, JsValue> {
    match factor {
        ForgettingFactor::None => Ok(Settings { forgetting_factor: factor, ..settings }),
        // without a rule the factor chooses one
        factor if settings.rule.is_none() => Ok(Settings { forgetting_factor: factor, ..settings }),
        factor => settings.with_forgetting_factor(factor).map_err(raise),
    }
}

fn yes(parameter: &str, value: &JsValue) -> Result<bool, JsValue> {
    let shown = || invalid(&format!("{parameter} = {}, allowed: true, false", shown(value)));
    value.as_bool().ok_or_else(shown)
}

fn view<'a>(
    parameter: &'static str,
    numbers: &'a Option<Numbers>,
) -> Result<Option<View<'a>>, JsValue> {
    let made = numbers
        .as_ref()
        .map(|(numbers, shape)| View::new(parameter, numbers.as_slice(), shape).map_err(raise));
    made.transpose()
}
