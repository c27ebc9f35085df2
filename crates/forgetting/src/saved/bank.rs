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
use super::write::Output;
use super::{unaltered, Error, Named, MARK_OF_BANK as MARK};
use crate::bank::{Member, Members, Mixed};
use crate::choice::Values;
use crate::memory::Memory;
use crate::mixers::Mixer;
use forgetting_kernels::Kernels;
#[cfg(feature = "alloc")]
use {super::write::header, crate::bank::Bank, crate::mixers::AnyMixer, alloc::vec::Vec};

const VERSION: u8 = 1;

/// A member that is saved as an estimator.
pub trait SavedMember<M: Memory>: Member<M> {
    /// Gives its bytes to `put`, piece by piece; returns how many they are. Nothing of it changes.
    ///
    /// # Errors
    /// Those of [`Named::save`].
    fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<usize, Error>;

    /// The member that was saved as these bytes.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with them.
    fn from_bytes(bytes: &[u8]) -> Result<Self, Error>;
}

impl<M: Memory> SavedMember<M> for Named<M> {
    fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<usize, Error> {
        self.save(put)
    }

    fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        Self::from_bytes(bytes)
    }
}

impl<T, G, X> Mixed<G, X>
where
    T: Kernels,
    G: Members<Real = T, Member: SavedMember<G::Memory>>,
    X: Mixer<G::Weighed>,
{
    /// Gives the bank, of which the mixer is the one `called` so, as bytes to `put`, piece by piece;
    /// returns how many they are. Nothing of the bank changes, but for where its members are.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when a part of it is a function of the user's.
    pub(crate) fn save_as(
        &mut self,
        called: &str,
        put: &mut dyn FnMut(&[u8]),
    ) -> Result<usize, Error> {
        let mut count = 0;
        let mut counted = |bytes: &[u8]| {
            count += bytes.len();
            put(bytes);
        };
        let mut output = Output::new(&mut counted);
        output.bytes(MARK);
        output.bytes(&[VERSION, T::BYTES as u8, u8::from(self.follows_data())]);
        let members = self.each();
        output.bytes(&(members.len() as u16).to_le_bytes());
        for member in members {
            let length = member.save(&mut |_| {})?;
            output.bytes(&(length as u32).to_le_bytes());
            member.save(&mut |piece| output.bytes(piece))?;
        }
        write_mixer(self.mixer(), called, &mut output)?;
        self.visit_own(&mut output);
        output.finish();
        Ok(count)
    }

    /// The bank that was saved as these bytes; `mix` makes the mixer of this name.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes, others what cannot be a bank of this kind.
    pub(crate) fn read(
        bytes: &[u8],
        mix: impl FnOnce(&str, &dyn Values, G::Weighed) -> Result<X, Error>,
    ) -> Result<Self, Error> {
        let mut reader = Reader::new(checked(bytes)?.get(MARK.len() + 1..).unwrap_or_default());
        if usize::from(reader.byte()?) != T::BYTES {
            return Err(Error::State { reason: "it holds numbers of another type" });
        }
        let follows_data = reader.byte()? == 1;
        let count = reader.count()?;
        let members = G::gather(count, || {
            let length = reader.size()?;
            G::Member::from_bytes(reader.take(length)?)
        })?;
        let (name, parameters) = reader.choice()?;
        let mixer = mix(name, &parameters, members.weighed())?;
        let mut bank = Self::of_members(members, mixer, follows_data);
        bank.visit_own(&mut reader);
        reader.finish()?;
        if bank.is_sound() {
            Ok(bank)
        } else {
            Err(Error::State { reason: "its numbers are not those of a bank" })
        }
    }
}

fn write_mixer<M: Memory, X: Mixer<M>>(
    mixer: &X,
    called: &str,
    output: &mut Output<'_>,
) -> Result<(), Error> {
    output.choice(called, &|each| mixer.describe(&mut |name, value| each(name, value)))
}

#[cfg(feature = "alloc")]
impl<T: Kernels> Bank<T> {
    /// The bank, configuration and state, as bytes.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when a part of it is a function of the user's.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        let called = self.mixer().called();
        self.clone().save_as(called, &mut |piece| bytes.extend_from_slice(piece))?;
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
        write_mixer(self.mixer(), self.mixer().called(), &mut output)?;
        Ok(bytes)
    }

    /// The bank that [`Bank::to_bytes`] saved.
    ///
    /// # Errors
    /// [`Error::State`] says what is wrong with the bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        Self::read(bytes, AnyMixer::named)
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
