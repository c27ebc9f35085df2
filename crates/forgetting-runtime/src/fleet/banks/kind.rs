//! Which banks can be streams of one fleet.

use super::Banks;
use crate::number::Number;
use forgetting::bank::Bank;
use forgetting::{Error, Memory};

impl<T: Number> Banks<T> {
    /// Refuses a `bank` that differs from a new stream in more than the state.
    ///
    /// # Errors
    /// [`Error::Unsupported`] says what differs.
    pub fn check_kind(&self, bank: &Bank<T>) -> Result<(), Error> {
        check_stream(bank)?;
        let reason = if bank.memory().parameters() != self.parameters() {
            "a stream has as many parameters as its fleet"
        } else if bank.configuration()? != self.configuration {
            "a stream of this fleet is a bank of the same members, mixer and prior"
        } else {
            return Ok(());
        };
        Err(Error::Unsupported { reason })
    }
}

/// Refuses a `bank` that can be a stream of no fleet.
///
/// # Errors
/// [`Error::Unsupported`] says what it has that a stream has not.
pub fn check_stream<T: Number>(bank: &Bank<T>) -> Result<(), Error> {
    let memory = bank.memory();
    match (memory.rows(), memory.targets()) {
        (1, 1) => Ok(()),
        _ => Err(Error::Unsupported { reason: "a stream has one row and one target" }),
    }
}
