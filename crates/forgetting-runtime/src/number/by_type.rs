//! One value for each number type: the only place that lists the types that are compiled.

use super::real::Number;
use super::NumberType;
use forgetting_cpu::Fused;

/// Plain arithmetic, for a machine without fused multiply-add. Every aarch64 has it: nothing but
/// the fused types is compiled there.
#[cfg(not(target_arch = "aarch64"))]
pub(crate) type Plain<F> = F;
#[cfg(target_arch = "aarch64")]
pub(crate) type Plain<F> = Fused<F>;

/// A type with the number type left open, such as that of estimators.
pub(crate) trait Family {
    /// The type for numbers `T`.
    type Of<T: Number>: Clone;
}

/// What a family makes of one of the number types.
pub(crate) enum ByType<F: Family> {
    F64(Box<F::Of<Plain<f64>>>),
    F32(Box<F::Of<Plain<f32>>>),
    FusedF64(Box<F::Of<Fused<f64>>>),
    FusedF32(Box<F::Of<Fused<f32>>>),
}

/// Evaluates an expression for the value of whichever number type it is.
macro_rules! each {
    ($by_type:expr, $value:ident => $expression:expr) => {{
        use $crate::number::ByType;
        match $by_type {
            ByType::F64($value) => $expression,
            ByType::F32($value) => $expression,
            ByType::FusedF64($value) => $expression,
            ByType::FusedF32($value) => $expression,
        }
    }};
}

/// Evaluates an expression for two values of the same number type; nothing if their types differ.
macro_rules! both {
    ($one:expr, $other:expr; $x:ident, $y:ident => $expression:expr) => {{
        use $crate::number::ByType;
        match ($one, $other) {
            (ByType::F64($x), ByType::F64($y)) => Some($expression),
            (ByType::F32($x), ByType::F32($y)) => Some($expression),
            (ByType::FusedF64($x), ByType::FusedF64($y)) => Some($expression),
            (ByType::FusedF32($x), ByType::FusedF32($y)) => Some($expression),
            _ => None,
        }
    }};
}

/// The value that an expression makes for the number type `$T`, in the arithmetic that is fast on
/// this machine.
macro_rules! make {
    ($number_type:expr, $T:ident => $expression:expr) => {{
        use forgetting_cpu::Fused;
        use $crate::number::NumberType;
        use $crate::number::{has_fused, ByType, Plain};
        match ($number_type, has_fused()) {
            (NumberType::F64, false) => {
                type $T = Plain<f64>;
                ByType::F64(Box::new($expression))
            }
            (NumberType::F32, false) => {
                type $T = Plain<f32>;
                ByType::F32(Box::new($expression))
            }
            (NumberType::F64, true) => {
                type $T = Fused<f64>;
                ByType::FusedF64(Box::new($expression))
            }
            (NumberType::F32, true) => {
                type $T = Fused<f32>;
                ByType::FusedF32(Box::new($expression))
            }
        }
    }};
}

/// The values of one family as those of another.
macro_rules! map {
    ($by_type:expr, $value:ident => $expression:expr) => {{
        use $crate::number::ByType;
        match $by_type {
            ByType::F64($value) => ByType::F64(Box::new($expression)),
            ByType::F32($value) => ByType::F32(Box::new($expression)),
            ByType::FusedF64($value) => ByType::FusedF64(Box::new($expression)),
            ByType::FusedF32($value) => ByType::FusedF32(Box::new($expression)),
        }
    }};
}

pub(crate) use {both, each, make, map};

/// Whether this machine has fused multiply-add.
pub(crate) fn has_fused() -> bool {
    forgetting_cpu::level() >= forgetting_cpu::Level::Fused
}

impl<F: Family> Clone for ByType<F> {
    fn clone(&self) -> Self {
        map!(self, value => F::Of::clone(value))
    }
}

impl<F: Family> ByType<F> {
    /// The number type.
    pub fn number_type(&self) -> NumberType {
        match self {
            Self::F64(_) | Self::FusedF64(_) => NumberType::F64,
            Self::F32(_) | Self::FusedF32(_) => NumberType::F32,
        }
    }
}
