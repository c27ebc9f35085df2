//! What went wrong, as numbers and as text.

use forgetting::Error;

/// What a function of the library returns.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// done
    Ok = 0,
    /// a pointer is null that must not be
    Null = 1,
    /// the memory is shorter than the estimator
    Memory = 2,
    /// the memory does not begin at a multiple of the alignment
    Alignment = 3,
    /// the memory holds no estimator
    NotAnEstimator = 4,
    /// the estimator computes with the other type of number
    NumberType = 5,
    /// a value is out of its range
    Value = 6,
    /// a number of elements is not the one needed
    Length = 7,
    /// a matrix is not positive definite
    Indefinite = 8,
    /// a parameter must be given
    Missing = 9,
    /// a name is not known
    Unknown = 10,
    /// a quantity would leave the range of the number type
    Range = 11,
    /// choices do not go together
    Unsupported = 12,
    /// bytes are not those of an estimator of this kind
    State = 13,
}

impl Code {
    /// In words, ended by a zero.
    pub fn words(code: i32) -> &'static core::ffi::CStr {
        match code {
            0 => c"no error",
            1 => c"a pointer is null",
            2 => c"the memory is too short",
            3 => c"the memory is not aligned",
            4 => c"the memory holds no estimator",
            5 => c"the estimator computes with the other type of number",
            6 => c"a value is out of its range",
            7 => c"a number of elements is not the one needed",
            8 => c"a matrix is not positive definite",
            9 => c"a parameter is missing",
            10 => c"a name is not known",
            11 => c"a quantity would leave the range of the number type",
            12 => c"this combination is not supported",
            13 => c"the bytes are not a saved estimator of this kind",
            _ => c"an unknown code",
        }
    }
}

/// Text that is not ended by a zero.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Text {
    /// its first byte, in UTF-8
    pub text: *const u8,
    /// how many bytes
    pub length: usize,
}

impl From<&'static str> for Text {
    fn from(text: &'static str) -> Self {
        Self { text: text.as_ptr(), length: text.len() }
    }
}

/// What was refused.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Why {
    /// what is returned, too
    pub code: i32,
    /// the position in the parameter, or −1
    pub index: i32,
    /// the value given, or NaN
    pub value: f64,
    /// the name of the parameter, or nothing
    pub parameter: Text,
    /// what is allowed or what is wrong, in words, or nothing
    pub allowed: Text,
}

impl From<Code> for Why {
    fn from(code: Code) -> Self {
        let nothing = Text::from("");
        let code = code as i32;
        Self { code, index: -1, value: f64::NAN, parameter: nothing, allowed: nothing }
    }
}

impl From<Error> for Why {
    fn from(error: Error) -> Self {
        let of = |code: Code, parameter: &'static str, value: f64, allowed: &'static str| Self {
            parameter: parameter.into(),
            value,
            allowed: allowed.into(),
            ..Self::from(code)
        };
        let none = f64::NAN;
        match error {
            Error::Value { parameter, index, value, allowed } => Self {
                index: index.and_then(|index| i32::try_from(index).ok()).unwrap_or(-1),
                ..of(Code::Value, parameter, value, allowed)
            },
            Error::Length { parameter, length, .. } => {
                of(Code::Length, parameter, length as f64, "another number of elements")
            }
            Error::Indefinite { parameter, pivot, allowed } => {
                of(Code::Indefinite, parameter, pivot, allowed)
            }
            Error::Missing { parameter } => of(Code::Missing, parameter, none, "is required"),
            Error::Unknown { parameter } => of(Code::Unknown, parameter, none, "a known name"),
            Error::Range { parameter, value, .. } => of(Code::Range, parameter, value, ""),
            Error::Function { parameter } => of(Code::Unsupported, parameter, none, ""),
            Error::Unsupported { reason } => of(Code::Unsupported, "", none, reason),
            Error::Memory => Self::from(Code::Memory),
            Error::State { reason } => of(Code::State, "", none, reason),
        }
    }
}
