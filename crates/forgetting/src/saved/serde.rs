//! Saved states in the formats of serde: as the bytes of `to_bytes`, which know their version and check
//! themselves, in whatever a format has for bytes.

use super::{Error, Named};
use crate::bank::Bank;
use crate::memory::Memory;
use crate::models::Polynomial;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use forgetting_kernels::Kernels;
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What is saved as bytes.
trait Saved: Sized {
    /// What the bytes are.
    const WHAT: &'static str;

    fn write(&self) -> Result<Vec<u8>, Error>;
    fn read(bytes: &[u8]) -> Result<Self, Error>;
}

impl<M: Memory> Saved for Named<M> {
    const WHAT: &'static str = "the bytes of a saved estimator";

    fn write(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        self.clone().save(&mut |piece| bytes.extend_from_slice(piece))?;
        Ok(bytes)
    }

    fn read(bytes: &[u8]) -> Result<Self, Error> {
        Self::from_bytes(bytes)
    }
}

impl<T: Kernels> Saved for Bank<T> {
    const WHAT: &'static str = "the bytes of a saved bank of estimators";

    fn write(&self) -> Result<Vec<u8>, Error> {
        self.to_bytes()
    }

    fn read(bytes: &[u8]) -> Result<Self, Error> {
        Self::from_bytes(bytes)
    }
}

impl Saved for Polynomial {
    const WHAT: &'static str = "the bytes of a saved model";

    fn write(&self) -> Result<Vec<u8>, Error> {
        Ok(self.to_bytes())
    }

    fn read(bytes: &[u8]) -> Result<Self, Error> {
        Self::from_bytes(bytes)
    }
}

/// Reads bytes, or a list of their numbers, as formats that are text have them.
struct Bytes<S>(PhantomData<S>);

impl<'de, S: Saved> Visitor<'de> for Bytes<S> {
    type Value = S;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(S::WHAT)
    }

    fn visit_bytes<E: serde::de::Error>(self, bytes: &[u8]) -> Result<S, E> {
        S::read(bytes).map_err(E::custom)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<S, A::Error> {
        let mut bytes = Vec::new();
        while let Some(byte) = list.next_element()? {
            bytes.push(byte);
        }
        S::read(&bytes).map_err(A::Error::custom)
    }
}

macro_rules! as_bytes {
    ($([$($generic:tt)*] $Type:ty;)*) => {$(
        impl<$($generic)*> Serialize for $Type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let bytes = self.write().map_err(S::Error::custom)?;
                serializer.serialize_bytes(&bytes)
            }
        }

        impl<'de, $($generic)*> Deserialize<'de> for $Type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_bytes(Bytes(PhantomData))
            }
        }
    )*};
}

as_bytes! {
    [M: Memory] Named<M>;
    [T: Kernels] Bank<T>;
    [] Polynomial;
}
