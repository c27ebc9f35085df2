//! The parameters of choices: their names, ranges and defaults as data, so that every face (Rust,
//! Python, command line, documentation) reads the same table.

pub use super::range::Range;
pub use super::value::{Defaults, Value, Values};
use crate::error::Error;
use forgetting_kernels::Real;

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
    /// a rule: its name, alone or with values for its parameters
    Rule,
    /// a function of the user's
    Function,
}

impl Kind {
    /// Its name, in every language.
    pub fn name(self) -> &'static str {
        match self {
            Self::Real => "real",
            Self::Whole => "whole",
            Self::Word(_) => "word",
            Self::Matrix => "matrix",
            Self::List => "list",
            Self::Rule => "rule",
            Self::Function => "function",
        }
    }
}

/// One parameter of a rule, a rate, a weighting or a gate.
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
    /// the value when none is given; without it, one must be, unless `optional`
    pub default: Option<Value<'static>>,
    /// whether it may be left out although it has no default
    pub optional: bool,
}

impl Parameter {
    /// A number in `range`, `default` when not given.
    pub const fn real(name: &'static str, default: f64, range: Range, about: &'static str) -> Self {
        Self {
            name,
            about,
            kind: Kind::Real,
            range,
            default: Some(Value::Real(default)),
            optional: false,
        }
    }

    /// A whole number in `range`, `default` when not given.
    pub const fn whole(
        name: &'static str,
        default: f64,
        range: Range,
        about: &'static str,
    ) -> Self {
        Self {
            name,
            about,
            kind: Kind::Whole,
            range,
            default: Some(Value::Real(default)),
            optional: false,
        }
    }

    /// One of `words`, the first when not given.
    pub const fn word(
        name: &'static str,
        words: &'static [&'static str],
        about: &'static str,
    ) -> Self {
        let default = Some(Value::Word(words[0]));
        Self {
            name,
            about,
            kind: Kind::Word(words),
            range: Range::FINITE,
            default,
            optional: false,
        }
    }

    /// A value of `kind` with elements in `range`, the number `default` when not given.
    pub const fn elements(
        name: &'static str,
        kind: Kind,
        default: f64,
        range: Range,
        about: &'static str,
    ) -> Self {
        Self { name, about, kind, range, default: Some(Value::Real(default)), optional: false }
    }

    /// The same parameter without a default.
    pub const fn required(self) -> Self {
        Self { default: None, ..self }
    }

    /// The same parameter without a default; the rule does without when it is not given.
    pub const fn optional(self) -> Self {
        Self { default: None, optional: true, ..self }
    }

    /// A rule, by its name alone or with values; `default` when not given.
    pub const fn rule(name: &'static str, default: &'static str, about: &'static str) -> Self {
        let default = Some(Value::Word(default));
        Self { name, about, kind: Kind::Rule, range: Range::FINITE, default, optional: false }
    }

    /// Whether a value must be given.
    pub fn is_required(&self) -> bool {
        self.default.is_none() && !self.optional
    }

    /// What is allowed, in words.
    pub fn allowed(&self) -> Allowed<'_> {
        Allowed(self)
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
            Value::Real(x) => self.convert(x),
            _ => Err(Error::value(self.name, f64::NAN, "one number")),
        }
    }

    /// `x` as a number of the type computed with, in which it must be in range too: 1e-60 is
    /// positive, but the `f32` nearest to it is 0.
    ///
    /// # Errors
    /// Those of [`Parameter::check`], and [`Error::Value`] for what the type has no number for.
    pub fn convert<T: Real>(&self, x: f64) -> Result<T, Error> {
        let converted = T::from_f64(self.check(x)?);
        let allowed = "within the number type's range";
        self.check(converted).map_err(|_| Error::value(self.name, x, allowed))
    }

    /// The elements of the list given in `values`, or of the default: a number stands for a
    /// list of `length` times that number.
    ///
    /// # Errors
    /// Those of [`Parameter::look_up`], [`Parameter::check`] for each element given to `take`
    /// with its position, [`Error::Length`] for another length.
    pub fn list<T: Real>(
        &self,
        values: &dyn Values,
        length: usize,
        mut take: impl FnMut(usize, T),
    ) -> Result<(), Error> {
        match self.look_up(values)? {
            Value::Real(x) => {
                let x = self.convert(x)?;
                (0..length).for_each(|i| take(i, x));
            }
            Value::Matrix { rows, columns, elements } => {
                Error::check_length(self.name, rows * columns, length)?;
                for i in 0..length {
                    take(i, self.convert(elements(i)).map_err(|error| error.at(i))?);
                }
            }
            _ => return Err(Error::value(self.name, f64::NAN, "numbers")),
        }
        Ok(())
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

/// What a parameter allows; prints as words.
#[derive(Clone, Copy, Debug)]
pub struct Allowed<'a>(&'a Parameter);

impl core::fmt::Display for Allowed<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self.0.kind {
            Kind::Word(words) => words.iter().enumerate().try_for_each(|(i, word)| {
                f.write_str(if i == 0 { "" } else { ", " })?;
                f.write_str(word)
            }),
            Kind::Rule => f.write_str("any rule"),
            Kind::Function => f.write_str("a function"),
            _ => f.write_str(self.0.range.words),
        }
    }
}
