//! Many independent streams of the same size and rule, updated together.

mod kind;

pub use kind::check_kind;
