//! What an estimator is made from, as C gives it.

use crate::code::Why;
use core::ffi::{c_char, CStr};
use forgetting::choice::{About, Value, Values};
use forgetting::defaults::FORGETTING_FACTOR;
use forgetting::{Error, Real};

/// A parameter of a choice: a number or a word.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// its name
    pub name: *const c_char,
    /// its value, where there is no word
    pub number: f64,
    /// its value as a word, or null
    pub word: *const c_char,
}

/// A rule, a rate, a weighting or a gate: its name and its parameters.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    /// its name; null for the default
    pub name: *const c_char,
    /// `count` parameters; those not given have their defaults
    pub parameters: *const Parameter,
    /// how many
    pub count: usize,
}

/// What an estimator is made from.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// n
    pub parameters: usize,
    /// where to forget
    pub rule: Choice,
    /// how much to forget, in the place of `forgetting_factor`
    pub rate: Choice,
    /// how far to trust a sample
    pub weighting: Choice,
    /// whether a sample is used
    pub gate: Choice,
    /// λ; 0 for the default
    pub forgetting_factor: f64,
    /// c of P₀ = c·I; 0 where it follows the data
    pub initial_covariance: f64,
    /// θ₀, n numbers, or null for 0
    pub initial_theta: *const f64,
    /// other than 0 for a monitor
    pub monitor: i32,
}

/// The text at `text`, if there is one.
///
/// # Safety
/// It is null, or ended by a zero and not changed while it is read.
unsafe fn text<'a>(text: *const c_char) -> Option<&'a str> {
    if text.is_null() {
        return None;
    }
    // SAFETY: as above.
    unsafe { CStr::from_ptr(text) }.to_str().ok()
}

/// The parameters of a choice.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a>(&'a [Parameter]);

impl Values for Given<'_> {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        // SAFETY: whoever calls the library gives text that is ended by a zero.
        let is_it = |given: &&Parameter| unsafe { text(given.name) } == Some(name);
        let given = self.0.iter().find(is_it)?;
        // SAFETY: the same.
        Some(match unsafe { text(given.word) } {
            Some(word) => Value::Word(word),
            None => Value::Real(given.number),
        })
    }
}

impl Choice {
    /// Its name, if it has one.
    pub fn name(&self) -> Option<&str> {
        // SAFETY: whoever calls the library gives text that is ended by a zero.
        unsafe { text(self.name) }
    }

    /// Its parameters.
    pub fn values(&self) -> Given<'_> {
        if self.parameters.is_null() || self.count == 0 {
            return Given(&[]);
        }
        // SAFETY: whoever calls the library says how many there are.
        Given(unsafe { core::slice::from_raw_parts(self.parameters, self.count) })
    }

    /// Refuses a parameter that the choice does not have.
    ///
    /// # Errors
    /// [`Error::Unknown`].
    pub fn check(&self, about: Option<&'static About>) -> Result<(), Error> {
        let Some(about) = about else { return Ok(()) };
        let is_known = |given: &Parameter| {
            // SAFETY: whoever calls the library gives text that is ended by a zero.
            let name = unsafe { text(given.name) };
            about.parameters.iter().any(|known| Some(known.name) == name)
        };
        if self.values().0.iter().all(is_known) {
            return Ok(());
        }
        Err(Error::Unknown { parameter: "parameter" })
    }
}

impl Settings {
    /// θ₀ as n = `N` numbers; 0 if it was not given.
    pub fn theta_of<T: Real, const N: usize>(&self) -> [T; N] {
        let mut theta = [T::ZERO; N];
        for (theta, &given) in theta.iter_mut().zip(self.initial_theta().unwrap_or_default()) {
            *theta = T::from_f64(given);
        }
        theta
    }

    /// θ₀ of an estimator of `parameters`, if it was given.
    pub fn initial_theta(&self) -> Option<&[f64]> {
        if self.initial_theta.is_null() {
            return None;
        }
        // SAFETY: whoever calls the library gives n numbers.
        Some(unsafe { core::slice::from_raw_parts(self.initial_theta, self.parameters) })
    }

    /// λ; that of a rule that uses none is 1.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where one is given to a rule that uses none.
    pub fn forgetting_factor(&self, is_used: bool) -> Result<f64, Error> {
        match self.forgetting_factor {
            0.0 if is_used => Ok(FORGETTING_FACTOR),
            0.0 => Ok(1.0),
            given if is_used => Ok(given),
            _ => {
                let reason = "forgetting_factor is given, but the rule uses none";
                Err(Error::Unsupported { reason })
            }
        }
    }

    /// Refuses what a compact estimator does not have.
    ///
    /// # Errors
    /// [`Error::Unsupported`].
    pub fn check_compact(&self) -> Result<(), Why> {
        let others = [self.rate, self.weighting, self.gate];
        if others.iter().any(|choice| !choice.name.is_null()) || self.monitor != 0 {
            let reason = "a compact estimator has no rate, weighting, gate or monitor";
            return Err(Error::Unsupported { reason }.into());
        }
        Ok(())
    }
}
