//! Writing a state.

use super::{AnyEstimator, Error, Forgetting, Memory, Rate, Real, Value, Vec, Visitor, Weighting};
use super::{MARK, VERSION};

/// Everything before the numbers.
///
/// # Errors
/// [`Error::Unsupported`] for a function, which is not data.
pub fn header<T: Real>(estimator: &AnyEstimator<T>) -> Result<Vec<u8>, Error> {
    let memory = estimator.prior().memory();
    let mut bytes = Vec::from(MARK.as_slice());
    bytes.extend_from_slice(&[VERSION, T::BYTES as u8]);
    for size in [memory.parameters(), memory.rows(), memory.targets()] {
        bytes.extend_from_slice(&(size as u32).to_le_bytes());
    }
    bytes.push(estimator.prior().form());
    bytes.push(u8::from(estimator.health().is_some()));
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
    let (mut count, position) = begin(bytes, name);
    let mut outcome = Ok(());
    describe(&mut |name, given| {
        outcome = outcome.and(parameter(bytes, &mut count, name, given));
    });
    bytes[position] = count;
    outcome
}

/// A name, and room for a number of parameters: that number (none yet) and where it goes.
fn begin(bytes: &mut Vec<u8>, name: &str) -> (u8, usize) {
    word(bytes, name);
    bytes.push(0);
    (0, bytes.len() - 1)
}

fn parameter(
    bytes: &mut Vec<u8>,
    count: &mut u8,
    name: &str,
    given: Value<'_>,
) -> Result<(), Error> {
    *count += 1;
    word(bytes, name);
    value(bytes, given)
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
        Value::Function(_) => {
            let reason = "an estimator that uses a function of yours cannot be saved: a function \
                          is not data";
            return Err(Error::Unsupported { reason });
        }
        Value::Choice { name, values } => {
            bytes.push(3);
            let (mut count, position) = begin(bytes, name);
            let mut outcome = Ok(());
            values.each(&mut |name, given| {
                outcome = outcome.and(parameter(bytes, &mut count, name, given));
            });
            bytes[position] = count;
            outcome?;
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
