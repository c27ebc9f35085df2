//! The values of parameters, and where they are looked up by name.

/// A value of a parameter.
#[derive(Clone, Copy)]
pub enum Value<'a> {
    /// a number
    Real(f64),
    /// a word
    Word(&'a str),
    /// rows x columns numbers, row by row; a list is one row
    Matrix {
        /// number of rows
        rows: usize,
        /// number of columns
        columns: usize,
        /// the number at a position, row by row
        elements: &'a dyn Fn(usize) -> f64,
    },
    /// an entry of a registry with values for its own parameters
    Choice {
        /// the registry name
        name: &'a str,
        /// the values of its parameters
        values: &'a dyn Values,
    },
    /// a function of the user's, as the type that the parameter is described by
    Function(&'a (dyn core::any::Any + Send + Sync)),
}

impl core::fmt::Debug for Value<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Real(x) => write!(f, "{x}"),
            Self::Word(word) => write!(f, "{word}"),
            Self::Matrix { rows, columns, .. } => write!(f, "{rows} x {columns} numbers"),
            Self::Choice { name, .. } => write!(f, "{name}(...)"),
            Self::Function(_) => write!(f, "a function"),
        }
    }
}

/// Where the values of parameters are looked up by name.
pub trait Values {
    /// The value of the parameter `name`, if one was given.
    fn get(&self, name: &str) -> Option<Value<'_>>;

    /// Shows every value with its name, to save it. Values that are only looked up show none.
    fn each(&self, show: &mut dyn FnMut(&str, Value<'_>)) {
        let _ = show;
    }
}

/// No values: every parameter takes its default.
#[derive(Clone, Copy, Debug)]
pub struct Defaults;

impl Values for Defaults {
    fn get(&self, _: &str) -> Option<Value<'_>> {
        None
    }
}
