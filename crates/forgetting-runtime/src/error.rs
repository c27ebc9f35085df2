//! What is refused, and how it is said in every language.

use std::fmt;

/// Why something was refused. Whatever was refused has changed nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// What the estimator itself refuses.
    Core(forgetting::Error),
    /// The same at one sample of a record.
    Sample {
        /// position in the record
        sample: usize,
        /// what is wrong with it
        error: forgetting::Error,
    },
    /// The same at one stream of a fleet.
    Stream {
        /// position in the fleet
        stream: usize,
        /// what is wrong with it
        error: forgetting::Error,
    },
    /// A stream that a fleet does not have.
    NoStream {
        /// the position given
        stream: i64,
        /// how many streams there are
        count: usize,
    },
    /// An array of a shape that does not fit.
    Shape {
        /// name of the parameter
        parameter: String,
        /// its shape
        shape: Vec<usize>,
        /// the shapes allowed
        expected: String,
    },
    /// An array of too many dimensions.
    Dimensions {
        /// name of the parameter
        parameter: String,
        /// how many it has
        dimensions: usize,
    },
    /// A word that a parameter does not take.
    Word {
        /// name of the parameter
        parameter: &'static str,
        /// the word given
        word: String,
        /// the words allowed, each in quotes
        allowed: String,
    },
    /// An output that there is none of.
    Output {
        /// the name given
        name: String,
        /// the outputs there are
        allowed: String,
    },
    /// A name that the registry does not have.
    Name {
        /// what was looked up: "rule", "rate", "weighting" or "gate"
        what: String,
        /// the name given
        name: String,
        /// the names that there are
        known: String,
    },
    /// A parameter that a rule, a rate, a weighting or a gate does not have.
    Parameter {
        /// what it is and its name: "rule subspace"
        of: String,
        /// the parameter given
        parameter: String,
        /// the parameters that it has
        allowed: String,
    },
    /// A combination that has no meaning.
    Unsupported {
        /// what does not go together
        reason: String,
    },
}

/// What an error means for the caller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// a value, a shape, a name or a state that is not allowed
    Invalid,
    /// a result would leave the range of the number type
    Range,
    /// there is not enough memory
    Memory,
    /// a function of the user's failed
    Function,
    /// there is no such stream
    Index,
}

impl Error {
    /// A word other than those allowed.
    pub(crate) fn word(parameter: &'static str, word: &str, allowed: &[&str]) -> Self {
        let allowed: Vec<_> = allowed.iter().map(|word| format!("{word:?}")).collect();
        Self::Word { parameter, word: word.into(), allowed: allowed.join(", ") }
    }

    /// A shape other than those allowed.
    pub(crate) fn shape(parameter: &str, shape: &[usize], expected: String) -> Self {
        Self::Shape { parameter: parameter.into(), shape: shape.to_vec(), expected }
    }

    /// A combination that has no meaning, for this reason.
    pub(crate) fn unsupported(reason: impl Into<String>) -> Self {
        Self::Unsupported { reason: reason.into() }
    }

    /// What it means for the caller.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self {
            Self::Core(error) | Self::Sample { error, .. } => kind(error),
            Self::NoStream { .. } => Kind::Index,
            _ => Kind::Invalid,
        }
    }
}

fn kind(error: &forgetting::Error) -> Kind {
    match error {
        forgetting::Error::Function { .. } => Kind::Function,
        forgetting::Error::Range { .. } => Kind::Range,
        forgetting::Error::Memory => Kind::Memory,
        _ => Kind::Invalid,
    }
}

impl From<forgetting::Error> for Error {
    fn from(error: forgetting::Error) -> Self {
        Self::Core(error)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => write!(f, "{error}"),
            Self::Sample { sample, error } => write!(f, "sample {sample}: {error}"),
            Self::Stream { stream, error } => write!(f, "stream {stream}: {error}"),
            Self::NoStream { stream, count } => write!(f, "stream {stream} of a fleet of {count}"),
            Self::Shape { parameter, shape, expected } => {
                write!(f, "{parameter} has shape {}, expected {expected}", tuple(shape))
            }
            Self::Dimensions { parameter, dimensions } => {
                write!(f, "{parameter} has {dimensions} dimensions, allowed: 0, 1 or 2")
            }
            Self::Word { parameter, word, allowed } => {
                write!(f, "{parameter} = {word:?}, allowed: {allowed}")
            }
            Self::Output { name, allowed } => write!(f, "outputs has {name:?}, allowed: {allowed}"),
            Self::Name { what, name, known } => {
                write!(f, "{what} = {name:?} is not known; there are: {known}")
            }
            Self::Parameter { of, parameter, allowed } => {
                write!(f, "{of} has no parameter {parameter}; it has: {allowed}")
            }
            Self::Unsupported { reason } => f.write_str(reason),
        }
    }
}

impl std::error::Error for Error {}

/// Refuses a shape other than the one expected.
///
/// # Errors
/// [`Error::Shape`] names the parameter.
pub fn check_shape(parameter: &str, shape: &[usize], expected: &[usize]) -> Result<(), Error> {
    if shape == expected {
        return Ok(());
    }
    Err(Error::shape(parameter, shape, tuple(expected)))
}

/// A shape as it is written: "(2, 3)".
pub(crate) fn tuple(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        more => format!("({})", more.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}
