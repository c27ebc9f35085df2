//! The parameters of rules, rates and weightings: their names, ranges and defaults as data, so
//! that every face (Rust, Python, command line, documentation) reads the same table.

#[cfg(feature = "alloc")]
use crate::function::Function;
use crate::{Error, Real};
#[cfg(feature = "alloc")]
use alloc::sync::Arc;

/// The values that a parameter may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    low: f64,
    high: f64,
    low_included: bool,
    high_included: bool,
    /// the interval as it is printed
    pub words: &'static str,
}

impl Range {
    /// (0, ∞)
    pub const POSITIVE: Self = Self::open(0.0, f64::INFINITY, "(0, inf)");
    /// (0, 1]
    pub const FRACTION: Self = Self { high_included: true, ..Self::open(0.0, 1.0, "(0, 1]") };
    /// (0, 1)
    pub const INNER_FRACTION: Self = Self::open(0.0, 1.0, "(0, 1)");
    /// [0, 1)
    pub const BELOW_ONE: Self = Self { low_included: true, ..Self::open(0.0, 1.0, "[0, 1)") };
    /// [0, ∞)
    pub const NON_NEGATIVE: Self =
        Self { low_included: true, ..Self::open(0.0, f64::INFINITY, "[0, inf)") };
    /// [1, ∞)
    pub const AT_LEAST_ONE: Self =
        Self { low_included: true, ..Self::open(1.0, f64::INFINITY, "[1, inf)") };
    /// (−∞, ∞)
    pub const FINITE: Self = Self::open(f64::NEG_INFINITY, f64::INFINITY, "finite numbers");

    /// (low, high), printed as `words`.
    pub const fn open(low: f64, high: f64, words: &'static str) -> Self {
        Self { low, high, low_included: false, high_included: false, words }
    }

    /// [low, high], printed as `words`.
    pub const fn closed(low: f64, high: f64, words: &'static str) -> Self {
        Self { low, high, low_included: true, high_included: true, words }
    }

    /// Whether the range has `x`; never for NaN.
    pub fn contains(&self, x: f64) -> bool {
        let above = x > self.low || (self.low_included && x == self.low);
        let below = x < self.high || (self.high_included && x == self.high);
        above && below
    }
}

/// What kind of value a parameter has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// a number
    Real,
    /// a whole number
    Whole,
    /// one of these words
    Word(&'static [&'static str]),
    /// a number c (c·I), n numbers (a diagonal) or n x n numbers
    Matrix,
    /// a number (the same for all) or a list of numbers
    List,
    /// a function of the user's
    Function,
}

/// One parameter of a rule, a rate or a weighting.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// the name, the same in every language
    pub name: &'static str,
    /// what it means, with its unit
    pub about: &'static str,
    /// what kind of value it has
    pub kind: Kind,
    /// the values allowed, element by element
    pub range: Range,
    /// the value when none is given; without it, one must be
    pub default: Option<Value<'static>>,
}

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
    /// a function of the user's
    #[cfg(feature = "alloc")]
    Function(&'a Arc<dyn Function>),
}

impl core::fmt::Debug for Value<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Real(x) => write!(f, "{x}"),
            Self::Word(word) => write!(f, "{word}"),
            Self::Matrix { rows, columns, .. } => write!(f, "{rows} x {columns} numbers"),
            #[cfg(feature = "alloc")]
            Self::Function(function) => write!(f, "{function:?}"),
        }
    }
}

/// Where the values of parameters are looked up by name.
pub trait Values {
    /// The value of the parameter `name`, if one was given.
    fn get(&self, name: &str) -> Option<Value<'_>>;
}

/// No values: every parameter takes its default.
#[derive(Clone, Copy, Debug)]
pub struct Defaults;

impl Values for Defaults {
    fn get(&self, _: &str) -> Option<Value<'_>> {
        None
    }
}

impl Parameter {
    /// A number in `range`, `default` when not given.
    pub const fn real(name: &'static str, default: f64, range: Range, about: &'static str) -> Self {
        Self { name, about, kind: Kind::Real, range, default: Some(Value::Real(default)) }
    }

    /// A whole number in `range`, `default` when not given.
    pub const fn whole(
        name: &'static str,
        default: f64,
        range: Range,
        about: &'static str,
    ) -> Self {
        Self { name, about, kind: Kind::Whole, range, default: Some(Value::Real(default)) }
    }

    /// One of `words`, the first when not given.
    pub const fn word(
        name: &'static str,
        words: &'static [&'static str],
        about: &'static str,
    ) -> Self {
        let default = Some(Value::Word(words[0]));
        Self { name, about, kind: Kind::Word(words), range: Range::FINITE, default }
    }

    /// A value of `kind` with elements in `range`, the number `default` when not given.
    pub const fn elements(
        name: &'static str,
        kind: Kind,
        default: f64,
        range: Range,
        about: &'static str,
    ) -> Self {
        Self { name, about, kind, range, default: Some(Value::Real(default)) }
    }

    /// The same parameter without a default.
    pub const fn required(self) -> Self {
        Self { default: None, ..self }
    }

    /// `value`, if it is in range.
    ///
    /// # Errors
    /// [`Error::Value`] names this parameter, the value and the range.
    pub fn check<T: Real>(&self, value: T) -> Result<T, Error> {
        let x = value.to_f64();
        let whole = self.kind != Kind::Whole || libm::trunc(x) == x;
        if self.range.contains(x) && x.is_finite() && whole {
            Ok(value)
        } else {
            Err(Error::value(self.name, x, self.range.words))
        }
    }

    /// The value given in `values`, or the default.
    ///
    /// # Errors
    /// [`Error::Missing`] when there is neither.
    pub fn look_up<'a>(&self, values: &'a dyn Values) -> Result<Value<'a>, Error> {
        values.get(self.name).or(self.default).ok_or(Error::Missing { parameter: self.name })
    }

    /// The number given in `values`, or the default, checked.
    ///
    /// # Errors
    /// Those of [`Parameter::check`] and [`Parameter::look_up`].
    pub fn number<T: Real>(&self, values: &dyn Values) -> Result<T, Error> {
        match self.look_up(values)? {
            Value::Real(x) => self.check(x).map(T::from_f64),
            _ => Err(Error::value(self.name, f64::NAN, "one number")),
        }
    }

    /// The position among its words of the word given in `values`, or of the default.
    ///
    /// # Errors
    /// [`Error::Value`] for any other word, [`Error::Missing`] when there is none.
    pub fn choice(&self, values: &dyn Values) -> Result<usize, Error> {
        let Kind::Word(words) = self.kind else {
            return Err(Error::value(self.name, f64::NAN, "a word"));
        };
        match self.look_up(values)? {
            Value::Word(word) => words.iter().position(|w| *w == word),
            _ => None,
        }
        .ok_or(Error::value(self.name, f64::NAN, "one of its words"))
    }
}
