//! Saved states: one portable, versioned and checked block of bytes for every language.
//!
//! | part | content |
//! |---|---|
//! | mark | `FGRLS` |
//! | version | one byte, [`VERSION`] |
//! | number type | one byte, 4 or 8: the bytes of a number |
//! | sizes | n, p, m as 32-bit numbers |
//! | form of P₀ | one byte |
//! | also kept | one byte, the sum of 1 if monitored and 2 if the noise variance is estimated |
//! | rule, rate, weighting, gate | each a name and its parameters by name; a rule may be a parameter |
//! | numbers | the prior, then the state, in the order of `visit` |
//! | check | CRC-32 of all before it |
//!
//! All numbers are little-endian. Numbers of the state are kept bit for bit.
//!
//! Version 1 had no gate: it is read as open. Its monitor held other numbers: a new one starts.

use crate::choice::{Value, Values};
use crate::covariance::Prior;
use crate::error::Error;
use crate::estimator::Estimator;
use crate::gates::{AnyGate, Gate, Open};
use crate::memory::state::Visitor;
use crate::memory::{Dynamic, Memory};
use crate::rates::{AnyRate, Rate};
use crate::rules::{Forgetting, Rule};
use crate::weightings::{AnyWeighting, Weighting};
use alloc::{boxed::Box, string::String, vec::Vec};
use forgetting_kernels::Kernels;
use forgetting_kernels::Real;

mod bank;
mod model;
mod read;
mod write;

pub use crate::estimator::AnyEstimator;
pub use bank::{bank_number_type, is_bank};

/// The version of the format that is written, and the latest that is read.
pub const VERSION: u8 = 2;
const MARK: &[u8; 5] = b"FGRLS";
const MONITORED: u8 = 1;
const NOISE_ESTIMATED: u8 = 2;

impl<T: Kernels> AnyEstimator<T> {
    /// The estimator, configuration and state, as bytes.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when a part of it is a function of the user's, [`Error::State`] for so
    /// many rows that the bytes could not tell of the memory they take (about 2000), and
    /// [`Error::Memory`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = write::header(self)?;
        let (mut prior, mut all) = (self.prior().clone(), self.clone());
        let mut length = write::Length(0);
        prior.visit(&mut length);
        all.visit(&mut length);
        read::check_rows(self.prior().memory(), length.0)?;
        bytes.try_reserve(length.0 + 4).map_err(|_| Error::Memory)?;
        let mut numbers = write::Numbers(&mut bytes);
        prior.visit(&mut numbers);
        all.visit(&mut numbers);
        let check = crc32(&bytes);
        bytes.extend_from_slice(&check.to_le_bytes());
        Ok(bytes)
    }

    /// The estimator that [`Estimator::to_bytes`] saved.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes: another format, a later version,
    /// another number type, a length that does not fit or a check that fails.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let body = checked(bytes)?;
        let mut reader = read::Reader::new(&body[MARK.len() + 1..]);
        let (mut estimator, old_monitor) = read::header::<T>(&mut reader, body[MARK.len()])?;
        estimator.visit(&mut reader);
        if old_monitor {
            reader.skip_old_monitor::<T>(estimator.prior().memory().parameters())?;
        }
        reader.finish()?;
        if old_monitor {
            estimator.enable_monitor();
        }
        if estimator.check_read() {
            Ok(estimator)
        } else {
            Err(Error::State { reason: "its numbers are not those of an estimator" })
        }
    }
}

/// The bytes that the state of an estimator of the sizes of this one takes at least.
pub fn least_length<T: Kernels>(estimator: &AnyEstimator<T>) -> usize {
    read::least_length(estimator.prior().memory(), u8::MAX)
}

/// The bytes of a number in a saved state: 4 or 8.
///
/// # Errors
/// [`Error::State`] as for reading the state.
pub fn number_type(bytes: &[u8]) -> Result<usize, Error> {
    let body = checked(bytes)?;
    body.get(MARK.len() + 1)
        .map(|&width| usize::from(width))
        .ok_or(Error::State { reason: "it is truncated" })
}

/// The bytes without their check, if they are of this format and unaltered.
fn checked(bytes: &[u8]) -> Result<&[u8], Error> {
    let refuse = |reason| Err(Error::State { reason });
    if is_bank(bytes) {
        return refuse("it is a saved bank of estimators, not one estimator");
    }
    if !bytes.starts_with(MARK) {
        return refuse("it is not a saved estimator");
    }
    unaltered(bytes, VERSION)
}

/// The bytes without their check, if they are of no later version than this and unaltered. The version
/// comes after a mark.
fn unaltered(bytes: &[u8], latest: u8) -> Result<&[u8], Error> {
    let refuse = |reason| Err(Error::State { reason });
    match bytes.get(MARK.len()) {
        None => return refuse("it is truncated"),
        Some(&version) if version == 0 || version > latest => {
            return refuse("it was written by a later version");
        }
        Some(_) => {}
    }
    if bytes.len() < MARK.len() + 5 {
        return refuse("it is truncated");
    }
    let (body, check) = bytes.split_at(bytes.len() - 4);
    if crc32(body).to_le_bytes() == check {
        Ok(body)
    } else {
        refuse("it is truncated or altered: the check fails")
    }
}

/// The cyclic redundancy check of IEEE 802.3.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, &byte: &u8| (crc >> 8) ^ OF_BYTE[usize::from(crc as u8 ^ byte)];
    !bytes.iter().fold(u32::MAX, step)
}

/// What the check makes of each byte, bit by bit.
static OF_BYTE: [u32; 256] = {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut crc, mut bit) = (byte as u32, 0);
        while bit < 8 {
            crc = (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg());
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::crc32;

    #[test]
    fn the_check_is_the_standard_one() {
        assert_eq!(crc32(b"123456789"), 0xCBF4_3926);
    }
}
