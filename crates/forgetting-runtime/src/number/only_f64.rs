//! The same where programs are to be small: WebAssembly, which computes with `f64` alone. It has no
//! fused multiply-add, and JavaScript's own numbers are of this type.

use super::real::Number;
use super::NumberType;

/// A type with the number type left open, such as that of estimators.
pub(crate) trait Family {
    /// The type for numbers `T`.
    type Of<T: Number>: Clone;
}

/// What a family makes of `f64`.
pub(crate) struct ByType<F: Family>(pub Box<F::Of<f64>>);

/// Evaluates an expression for the value.
macro_rules! each {
    ($by_type:expr, $value:ident => $expression:expr) => {{
        let $crate::number::ByType($value) = $by_type;
        $expression
    }};
}

/// Evaluates an expression for two values.
macro_rules! both {
    ($one:expr, $other:expr; $x:ident, $y:ident => $expression:expr) => {{
        let ($crate::number::ByType($x), $crate::number::ByType($y)) = ($one, $other);
        Some($expression)
    }};
}

/// The value that an expression makes for `$T`, the type `f64`; returns an error for another.
macro_rules! make {
    ($number_type:expr, $T:ident => $expression:expr) => {{
        if $number_type != $crate::number::NumberType::F64 {
            return Err($crate::error::Error::word("dtype", $number_type.name(), &["float64"]));
        }
        type $T = f64;
        $crate::number::ByType(Box::new($expression))
    }};
}

/// The values of one family as those of another.
macro_rules! map {
    ($by_type:expr, $value:ident => $expression:expr) => {{
        let $crate::number::ByType($value) = $by_type;
        $crate::number::ByType(Box::new($expression))
    }};
}

pub(crate) use {both, each, make, map};

impl<F: Family> Clone for ByType<F> {
    fn clone(&self) -> Self {
        map!(self, value => F::Of::clone(value))
    }
}

impl<F: Family> ByType<F> {
    /// The number type.
    pub fn number_type(&self) -> NumberType {
        NumberType::F64
    }
}
