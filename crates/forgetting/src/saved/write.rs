//! Writing a state.

use super::{
    AnyEstimator, Error, Forgetting, Gate, Memory, Rate, Real, Value, Vec, Visitor, Weighting,
};
use super::{MARK, VERSION};
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
    bytes.push(u8::from(estimator.health().is_some()));
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

/// A name, then its parameters: their number, and each one's name and value.
pub fn choice(
    bytes: &mut Vec<u8>,
    name: &str,
    each: impl FnOnce(&mut dyn FnMut(&str, Value<'_>)),
) -> Result<(), Error> {
    word(bytes, name);
    bytes.push(0);
    let (position, mut count, mut outcome) = (bytes.len() - 1, 0, Ok(()));
    each(&mut |name, given| {
        count += 1;
        word(bytes, name);
        outcome = outcome.and(value(bytes, given));
    });
    bytes[position] = count;
    outcome
}

fn word(bytes: &mut Vec<u8>, word: &str) {
    bytes.extend_from_slice(&(word.len() as u16).to_le_bytes());
    bytes.extend_from_slice(word.as_bytes());
}

fn value(bytes: &mut Vec<u8>, value: Value<'_>) -> Result<(), Error> {
    match value {
        Value::Real(x) => {
            bytes.push(0);
            bytes.extend_from_slice(&x.to_le_bytes());
        }
        Value::Word(text) => {
            bytes.push(1);
            word(bytes, text);
        }
        Value::Matrix { rows, columns, elements } => {
            bytes.push(2);
            for size in [rows, columns] {
                bytes.extend_from_slice(&(size as u32).to_le_bytes());
            }
            for k in 0..rows * columns {
                bytes.extend_from_slice(&elements(k).to_le_bytes());
            }
        }
        Value::Choice { name, values } => {
            bytes.push(3);
            choice(bytes, name, |each| values.each(each))?;
        }
        Value::Function(_) => {
            let reason = "an estimator that uses a function of yours cannot be saved: a function \
                          is not data";
            return Err(Error::Unsupported { reason });
        }
    }
    Ok(())
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
