//! The number types of C.

/// The type of all numbers of an estimator.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// `float`
    F32 = 4,
    /// `double`
    F64 = 8,
}
