//! One stream of a fleet, apart from it.

use crate::bank::Bank;
use crate::error::Error;
use crate::estimator::Estimator;

/// What a stream is.
#[derive(Clone)]
pub enum Stream {
    /// one estimator
    Estimator(Estimator),
    /// several, and their mixture
    Bank(Bank),
}

impl Stream {
    /// Its configuration and state as bytes.
    ///
    /// # Errors
    /// Those of [`Estimator::to_bytes`] and [`Bank::to_bytes`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        match self {
            Self::Estimator(estimator) => estimator.to_bytes(),
            Self::Bank(bank) => bank.to_bytes(),
        }
    }
}

impl From<Estimator> for Stream {
    fn from(estimator: Estimator) -> Self {
        Self::Estimator(estimator)
    }
}

impl From<Bank> for Stream {
    fn from(bank: Bank) -> Self {
        Self::Bank(bank)
    }
}
