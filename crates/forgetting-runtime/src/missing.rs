//! Samples of which a number is missing.

use crate::error::Error;
use forgetting::Real;

/// What is done with a sample that has a NaN.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// the record is refused
    Error,
    /// the sample is left out
    Skip,
}

impl Missing {
    /// The one that `error` or `skip` names.
    ///
    /// # Errors
    /// [`Error::Word`] names `missing`.
    pub fn named(word: &str) -> Result<Self, Error> {
        match word {
            "error" => Ok(Self::Error),
            "skip" => Ok(Self::Skip),
            _ => Err(Error::word("missing", word, &["error", "skip"])),
        }
    }
}

/// Whether a number of a sample is missing, which a NaN says.
pub(crate) fn is_missing<T: Real>(phi: &[T], y: &[T]) -> bool {
    phi.iter().chain(y).any(|x| x.to_f64().is_nan())
}
