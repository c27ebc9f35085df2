//! A bank as bytes.
//!
//! | part | content |
//! |---|---|
//! | mark | `FGBNK` |
//! | version | one byte |
//! | number type | one byte, 4 or 8: the bytes of a number |
//! | units | one byte: 1 where the units of φ are those of the data |
//! | members | their number, 16 bits; each its length, 32 bits, and its bytes as an estimator |
//! | mixer | its name and its parameters by name |
//! | numbers | of mixer, weights and units, in the order of `visit` |
//! | check | CRC-32 of all before it |

use super::read::Reader;
use super::write::{header, Output};
use super::{unaltered, AnyEstimator, Error, Vec, MARK_OF_BANK as MARK};
use crate::bank::Bank;
use crate::memory::Dynamic;
use crate::mixers::{AnyMixer, Mixer};
use forgetting_kernels::Kernels;

const VERSION: u8 = 1;

impl<T: Kernels> Bank<T> {
    /// The bank, configuration and state, as bytes.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when a part of it is a function of the user's.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        let mut keep = |piece: &[u8]| bytes.extend_from_slice(piece);
        let mut output = Output::new(&mut keep);
        output.bytes(MARK);
        output.bytes(&[VERSION, T::BYTES as u8, u8::from(self.follows_data())]);
        let members = self.members();
        output.bytes(&(members.len() as u16).to_le_bytes());
        for member in members.iter() {
            let member = member.to_bytes()?;
            output.bytes(&(member.len() as u32).to_le_bytes());
            output.bytes(&member);
        }
        self.write_mixer(&mut output)?;
        self.clone().visit_own(&mut output);
        output.finish();
        Ok(bytes)
    }

    /// What it is made of, all but the state: banks of which it is the same have states of the same kind.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when a part of it is a function of the user's.
    pub fn configuration(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        let mut keep = |piece: &[u8]| bytes.extend_from_slice(piece);
        let mut output = Output::new(&mut keep);
        output.bytes(&[T::BYTES as u8, u8::from(self.follows_data())]);
        for member in self.made() {
            header(&mut output, member)?;
            member.prior().clone().visit(&mut output);
        }
        self.write_mixer(&mut output)?;
        Ok(bytes)
    }

    fn write_mixer(&self, output: &mut Output<'_>) -> Result<(), Error> {
        let mixer = self.mixer();
        output.choice(mixer.called(), &|each| {
            mixer.describe(&mut |name, value| each(name, value));
        })
    }

    /// The bank that [`Bank::to_bytes`] saved.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let mut reader = Reader::new(&checked(bytes)?[MARK.len() + 1..]);
        if usize::from(reader.byte()?) != T::BYTES {
            return Err(Error::State { reason: "it holds numbers of another type" });
        }
        let follows_data = reader.byte()? == 1;
        let count = reader.count()?;
        let mut members = Vec::new();
        for _ in 0..count {
            let length = reader.size()?;
            members.push(AnyEstimator::<T>::from_bytes(reader.take(length)?)?);
        }
        let (name, parameters) = reader.choice()?;
        let mixer = AnyMixer::named(name, &parameters, Dynamic::new(count, 1, 1)?)?;
        // a new bank starts its members: they are put back
        let mut bank = Self::with_units(members.clone(), mixer, follows_data)?;
        bank.put_members(members);
        bank.visit_own(&mut reader);
        reader.finish()?;
        if bank.is_sound() {
            Ok(bank)
        } else {
            Err(Error::State { reason: "its numbers are not those of a bank" })
        }
    }
}

/// Whether these are the bytes of a bank, and not of one estimator.
pub fn is_bank(bytes: &[u8]) -> bool {
    bytes.starts_with(MARK)
}

/// The bytes of a number in a saved bank: 4 or 8.
///
/// # Errors
/// [`Error::State`] as for reading the bank.
pub fn bank_number_type(bytes: &[u8]) -> Result<usize, Error> {
    let body = checked(bytes)?;
    body.get(MARK.len() + 1)
        .map(|&width| usize::from(width))
        .ok_or(Error::State { reason: "it is truncated" })
}

/// The bytes without their check, if they are those of a bank and unaltered.
fn checked(bytes: &[u8]) -> Result<&[u8], Error> {
    if !is_bank(bytes) {
        return Err(Error::State { reason: "it is not a saved bank of estimators" });
    }
    unaltered(bytes, VERSION)
}
