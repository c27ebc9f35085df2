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
use crate::estimator::{Estimator, Named};
use crate::gates::{AnyGate, Gate, Open};
use crate::memory::state::Visitor;
use crate::memory::Memory;
use crate::rates::{AnyRate, Rate};
use crate::rules::{Forgetting, Rule};
use crate::weightings::{AnyWeighting, Weighting};
use forgetting_kernels::Real;
#[cfg(feature = "alloc")]
use {alloc::vec::Vec, forgetting_kernels::Kernels};

mod bank;
#[cfg(feature = "alloc")]
mod model;
mod read;
#[cfg(feature = "serde")]
mod serde;
mod write;

pub(crate) use read::Reader;
pub(crate) use write::Output;

#[cfg(feature = "alloc")]
pub use crate::estimator::AnyEstimator;
pub(crate) use bank::SavedMember;
pub use bank::{bank_number_type, is_bank};

/// The version of the format that is written, and the latest that is read.
pub const VERSION: u8 = 2;
pub(crate) const MARK: &[u8; 5] = b"FGRLS";
const MARK_OF_BANK: &[u8; 5] = b"FGBNK";
const MONITORED: u8 = 1;
const NOISE_ESTIMATED: u8 = 2;

impl<M: Memory> Named<M> {
    /// Gives the estimator, configuration and state, as bytes to `put`, piece by piece; returns how
    /// many they are. Nothing of the estimator changes.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when a part of it is a function of the user's, [`Error::State`] for so
    /// many rows that the bytes could not tell of the memory they take (about 2000).
    pub fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<usize, Error> {
        let mut count = 0;
        let mut counted = |bytes: &[u8]| {
            count += bytes.len();
            put(bytes);
        };
        let mut output = write::Output::new(&mut counted);
        let (mut prior, mut length) = (self.prior().clone(), write::Length(0));
        prior.visit(&mut length);
        self.visit(&mut length);
        read::check_rows(self.prior().memory(), length.0)?;
        write::header(&mut output, self)?;
        prior.visit(&mut output);
        self.visit(&mut output);
        output.finish();
        Ok(count)
    }

    /// The estimator that was saved as these bytes.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes: another format, a later version,
    /// another number type, a length that does not fit or a check that fails; others what does not
    /// fit the memory.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let body = checked(bytes)?;
        let mut reader = read::Reader::new(&body[MARK.len() + 1..]);
        let (mut estimator, old_monitor) = read::header::<M>(&mut reader, body[MARK.len()])?;
        estimator.visit(&mut reader);
        if old_monitor {
            reader.skip_old_monitor::<M::Real>(estimator.prior().memory().parameters())?;
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

#[cfg(feature = "alloc")]
impl<T: Kernels> AnyEstimator<T> {
    /// The estimator, configuration and state, as bytes.
    ///
    /// # Errors
    /// Those of [`AnyEstimator::save`], and [`Error::Memory`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let mut estimator = self.clone();
        let length = estimator.save(&mut |_| {})?;
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(length).map_err(|_| Error::Memory)?;
        estimator.save(&mut |piece| bytes.extend_from_slice(piece))?;
        Ok(bytes)
    }
}

/// The bytes that the state of an estimator of the sizes of this one takes at least.
pub fn least_length<M: Memory>(estimator: &Named<M>) -> usize {
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
pub(crate) fn checked(bytes: &[u8]) -> Result<&[u8], Error> {
    let refuse = |reason| Err(Error::State { reason });
    if bytes.starts_with(MARK_OF_BANK) {
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
    !crc32_of(u32::MAX, bytes)
}

/// The same before its last step, from where it was before these bytes.
#[cfg(feature = "alloc")]
fn crc32_of(check: u32, bytes: &[u8]) -> u32 {
    let step = |crc: u32, &byte: &u8| (crc >> 8) ^ OF_BYTE[usize::from(crc as u8 ^ byte)];
    bytes.iter().fold(check, step)
}

/// The same without a table, which would be the larger part of what saving takes in firmware.
#[cfg(not(feature = "alloc"))]
fn crc32_of(check: u32, bytes: &[u8]) -> u32 {
    bytes.iter().fold(check, |crc, &byte| eight_steps(crc ^ u32::from(byte)))
}

/// What the check makes of a byte, bit by bit.
const fn eight_steps(mut crc: u32) -> u32 {
    let mut bit = 0;
    while bit < 8 {
        crc = (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg());
        bit += 1;
    }
    crc
}

/// The same of all bytes.
#[cfg(feature = "alloc")]
static OF_BYTE: [u32; 256] = {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        table[byte] = eight_steps(byte as u32);
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
