//! What a choice is: its name, its parameters with their values, what it guarantees, and the
//! registry that lists it.

pub(crate) mod about;
pub(crate) mod bytes;
#[cfg(feature = "alloc")]
pub mod function;
pub mod guarantee;
pub mod parameter;
mod range;
pub(crate) mod registry;
mod value;

pub use about::{About, Axis};
pub use guarantee::{Bounds, Claim, Constants, Guarantee, Guarantees, Input, Setting};
pub use parameter::{Kind, Parameter};
pub use range::Range;
pub use value::{Defaults, Value, Values};
