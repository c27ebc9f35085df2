//! Writing a state.

use super::{AnyEstimator, Error, Forgetting, Gate, Memory, Rate, Real, Vec, Visitor, Weighting};
use super::{MARK, MONITORED, NOISE_ESTIMATED, VERSION};
use crate::choice::bytes::write as choice;
use forgetting_kernels::Kernels;

/// Everything before the numbers.
///
/// # Errors
/// [`Error::Unsupported`] for a function, which is not data.
pub fn header<T: Kernels>(estimator: &AnyEstimator<T>) -> Result<Vec<u8>, Error> {
    let memory = estimator.prior().memory();
    let mut bytes = Vec::from(MARK.as_slice());
    bytes.extend_from_slice(&[VERSION, T::BYTES as u8]);
    for size in [memory.parameters(), memory.rows(), memory.targets()] {
        bytes.extend_from_slice(&(size as u32).to_le_bytes());
    }
    bytes.push(estimator.prior().form());
    let (monitored, noise) = (estimator.health().is_some(), estimator.estimates_noise());
    bytes.push(u8::from(monitored) * MONITORED + u8::from(noise) * NOISE_ESTIMATED);
    let (rule, rate, weighting) = (estimator.rule(), estimator.rate(), estimator.weighting());
    let (of_rule, of_rate) = (rule.about().name, rate.about().name);
    choice(&mut bytes, of_rule, |each| rule.describe(&mut |name, value| each(name, value)))?;
    choice(&mut bytes, of_rate, |each| rate.describe(&mut |name, value| each(name, value)))?;
    choice(&mut bytes, weighting.about().name, |each| {
        weighting.describe(&mut |name, value| each(name, value));
    })?;
    let gate = estimator.gate();
    choice(&mut bytes, gate.about().name, |each| {
        gate.describe(&mut |name, value| each(name, value))
    })?;
    Ok(bytes)
}

/// Counts the bytes of the numbers of a state.
pub struct Length(pub usize);

impl<T: Real> Visitor<T> for Length {
    fn reals(&mut self, values: &mut [T]) {
        self.0 += values.len() * T::BYTES;
    }

    fn whole(&mut self, _: &mut u64) {
        self.0 += 8;
    }
}

/// Appends the numbers of a state. `f32` numbers go through `f64` exactly.
pub struct Numbers<'a>(pub &'a mut Vec<u8>);

impl<T: Real> Visitor<T> for Numbers<'_> {
    fn reals(&mut self, values: &mut [T]) {
        for value in values {
            match T::BYTES {
                4 => self.0.extend_from_slice(&(value.to_f64() as f32).to_le_bytes()),
                _ => self.0.extend_from_slice(&value.to_f64().to_le_bytes()),
            }
        }
    }

    fn whole(&mut self, value: &mut u64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }
}
