//! One value for each number type: the only place that lists the types that are compiled.

use crate::number::Number;
use crate::NumberType;
use forgetting_cpu::Fused;

/// A type with the number type left open, such as that of estimators.
pub(crate) trait Family {
    /// The type for numbers `T`.
    type Of<T: Number>: Clone;
}

/// What a family makes of one of the number types.
pub(crate) enum ByType<F: Family> {
    F64(Box<F::Of<f64>>),
    F32(Box<F::Of<f32>>),
    // on a machine with fused multiply-add
    FusedF64(Box<F::Of<Fused<f64>>>),
    FusedF32(Box<F::Of<Fused<f32>>>),
}

/// Evaluates an expression for the value of whichever number type it is.
macro_rules! each {
    ($by_type:expr, $value:ident => $expression:expr) => {
        match $by_type {
            $crate::by_type::ByType::F64($value) => $expression,
            $crate::by_type::ByType::F32($value) => $expression,
            $crate::by_type::ByType::FusedF64($value) => $expression,
            $crate::by_type::ByType::FusedF32($value) => $expression,
        }
    };
}

/// Evaluates an expression for two values of the same number type; nothing if their types differ.
macro_rules! both {
    ($one:expr, $other:expr; $x:ident, $y:ident => $expression:expr) => {{
        use $crate::by_type::ByType;
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
    ($number_type:expr, $T:ident => $expression:expr) => {
        $crate::by_type::make!(@ $number_type, $T => $expression;
            (F64, false) F64 f64,
            (F32, false) F32 f32,
            (F64, true) FusedF64 ::forgetting_cpu::Fused<f64>,
            (F32, true) FusedF32 ::forgetting_cpu::Fused<f32>)
    };
    (@ $number_type:expr, $T:ident => $expression:expr;
        $(($Type:ident, $fused:literal) $Variant:ident $type:ty),*) => {
        match ($number_type, $crate::by_type::is_fused()) {
            $(($crate::NumberType::$Type, $fused) => {
                type $T = $type;
                $crate::by_type::ByType::$Variant(Box::new($expression))
            })*
        }
    };
}

/// The values of one family as those of another.
macro_rules! map {
    ($by_type:expr, $value:ident => $expression:expr) => {
        match $by_type {
            $crate::by_type::ByType::F64($value) => {
                $crate::by_type::ByType::F64(Box::new($expression))
            }
            $crate::by_type::ByType::F32($value) => {
                $crate::by_type::ByType::F32(Box::new($expression))
            }
            $crate::by_type::ByType::FusedF64($value) => {
                $crate::by_type::ByType::FusedF64(Box::new($expression))
            }
            $crate::by_type::ByType::FusedF32($value) => {
                $crate::by_type::ByType::FusedF32(Box::new($expression))
            }
        }
    };
}

pub(crate) use {both, each, make, map};

/// Whether this machine has fused multiply-add.
pub(crate) fn is_fused() -> bool {
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
