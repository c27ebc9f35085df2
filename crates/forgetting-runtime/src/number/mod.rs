//! Number types, and numbers as an interface passes and receives them.

mod array;
#[cfg_attr(target_arch = "wasm32", path = "only_f64.rs")]
mod by_type;
mod real;

pub use array::{Array, Elements, Numbers, View};
pub(crate) use by_type::{both, each, make, map, ByType, Family};
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use by_type::{has_fused, Plain};
pub(crate) use real::Number;

use crate::error::Error;

/// The type of an estimator's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    /// 64 bits
    F64,
    /// 32 bits
    F32,
}

impl NumberType {
    /// The name: `float64` or `float32`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => "float64",
            Self::F32 => "float32",
        }
    }

    /// The type of this name.
    ///
    /// # Errors
    /// [`Error::Word`] names `dtype`.
    pub fn named(name: &str) -> Result<Self, Error> {
        match name {
            "float64" => Ok(Self::F64),
            "float32" => Ok(Self::F32),
            _ => Err(Error::word("dtype", name, &[Self::F64.name(), Self::F32.name()])),
        }
    }
}
