//! Writing a state.

use super::{AnyEstimator, Error, Forgetting, Memory, Rate, Real, Value, Vec, Visitor, Weighting};
use super::{MARK, VERSION};

/// Everything before the numbers.
pub fn header<T: Real>(estimator: &AnyEstimator<T>) -> Result<Vec<u8>, Error> {
    let memory = estimator.prior().memory();
    let mut bytes = Vec::from(MARK.as_slice());
    bytes.extend_from_slice(&[VERSION, T::BYTES as u8]);
    for size in [memory.parameters(), memory.rows(), memory.targets()] {
        bytes.extend_from_slice(&(size as u32).to_le_bytes());
    }
    bytes.push(estimator.prior().form());
    choice(&mut bytes, estimator.rule().about().name, |each| estimator.rule().describe(each))?;
    choice(&mut bytes, estimator.rate().about().name, |each| estimator.rate().describe(each))?;
    choice(&mut bytes, estimator.weighting().about().name, |each| {
        estimator.weighting().describe(each);
    })?;
    Ok(bytes)
}

/// A name, then its parameters: their number, and each one's name and value.
fn choice(
    bytes: &mut Vec<u8>,
    name: &str,
    describe: impl Fn(&mut dyn FnMut(&'static str, Value<'_>)),
) -> Result<(), Error> {
    word(bytes, name);
    let (mut count, mut outcome) = (0u8, Ok(()));
    let position = bytes.len();
    bytes.push(count);
    describe(&mut |name, given| {
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

/// Refuses a function: it is not a number.
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
        Value::Function(_) => {
            let reason = "an estimator with a function of yours in it cannot be saved: save the \
                          function's source and the estimator's theta and covariance instead";
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
