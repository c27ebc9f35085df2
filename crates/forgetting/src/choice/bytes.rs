//! A choice as bytes: what a saved state holds of it, and what two choices are compared by.

use super::Value;
use crate::error::Error;

/// Takes bytes, one piece after the other.
pub(crate) type Put<'a> = dyn FnMut(&[u8]) + 'a;

/// Shows every parameter of a choice with its name and its value; asked twice.
pub(crate) type Each<'a> = dyn Fn(&mut dyn FnMut(&str, Value<'_>)) + 'a;

/// A name, then its parameters: their number, and each one's name and value.
///
/// # Errors
/// [`Error::Unsupported`] for a function, which is not data.
pub(crate) fn write(put: &mut Put<'_>, name: &str, each: &Each<'_>) -> Result<(), Error> {
    word(put, name);
    let (mut count, mut outcome) = (0, Ok(()));
    each(&mut |_, _| count += 1);
    put(&[count]);
    each(&mut |name, given| {
        word(put, name);
        outcome = outcome.and(value(put, given));
    });
    outcome
}

fn word(put: &mut Put<'_>, word: &str) {
    put(&(word.len() as u16).to_le_bytes());
    put(word.as_bytes());
}

fn value(put: &mut Put<'_>, value: Value<'_>) -> Result<(), Error> {
    match value {
        Value::Real(x) => {
            put(&[0]);
            put(&x.to_le_bytes());
        }
        Value::Word(text) => {
            put(&[1]);
            word(put, text);
        }
        Value::Matrix { rows, columns, elements } => {
            put(&[2]);
            for size in [rows, columns] {
                put(&(size as u32).to_le_bytes());
            }
            for k in 0..rows * columns {
                put(&elements(k).to_le_bytes());
            }
        }
        Value::Choice { name, values } => {
            put(&[3]);
            write(put, name, &|each| values.each(each))?;
        }
        Value::Function(_) => {
            let reason = "an estimator that uses a function of yours cannot be saved: a function \
                          is not data";
            return Err(Error::Unsupported { reason });
        }
    }
    Ok(())
}
