//! A choice as bytes: what a saved state holds of it, and what two choices are compared by.

use super::Value;
use crate::error::Error;
use alloc::vec::Vec;

/// A name, then its parameters: their number, and each one's name and value.
pub(crate) fn write(
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
            write(bytes, name, |each| values.each(each))?;
        }
        Value::Function(_) => {
            let reason = "an estimator that uses a function of yours cannot be saved: a function \
                          is not data";
            return Err(Error::Unsupported { reason });
        }
    }
    Ok(())
}
