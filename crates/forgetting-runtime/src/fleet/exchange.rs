//! Streams that are added to a fleet, taken out and put in.

use super::{kept, make, Fleet, Kept, Stream};
use crate::bank::Bank;
use crate::error::Error;
use crate::estimator::{Estimator, GoOn};
use crate::number::{both, each, map};

impl Fleet {
    /// Adds `count` new streams after the last. They start from what was given for all streams, and
    /// from the default where one was given for each.
    ///
    /// # Errors
    /// [`Error::Core`] names `count`, or that there is not enough memory; nothing has changed.
    pub fn grow(&mut self, count: i64) -> Result<(), Error> {
        self.grow_while(count, &mut || Ok(()))
    }

    /// The same, as long as `go_on` says so, which is asked a few times a second.
    ///
    /// # Errors
    /// Those of [`Fleet::grow`], and that of `go_on`; nothing has changed.
    pub fn grow_while(&mut self, count: i64, go_on: GoOn<'_>) -> Result<(), Error> {
        if count < 1 {
            let allowed = "whole numbers from 1";
            return Err(forgetting::Error::value("count", count as f64, allowed).into());
        }
        let count = make::read_count(count)?;
        Ok(kept!(&mut self.kept, streams => streams.grow(count, go_on))?)
    }

    /// Adds copies of the streams of another fleet of the same parameters, rule, weighting, gate
    /// and number type.
    ///
    /// # Errors
    /// [`Error`] says what differs; nothing has changed.
    pub fn append(&mut self, other: &Self) -> Result<(), Error> {
        self.append_while(other, &mut || Ok(()))
    }

    /// The same, as long as `go_on` says so, which is asked a few times a second.
    ///
    /// # Errors
    /// Those of [`Fleet::append`], and that of `go_on`; nothing has changed.
    pub fn append_while(&mut self, other: &Self, go_on: GoOn<'_>) -> Result<(), Error> {
        let appended = match (&mut self.kept, &other.kept) {
            (Kept::Estimators(own), Kept::Estimators(others)) => {
                both!(own, others; streams, others => streams.append(others, go_on))
            }
            (Kept::Banks(own), Kept::Banks(others)) => {
                both!(own, others; streams, others => streams.append(others, go_on))
            }
            _ => return Err(self.other_kind()),
        };
        Ok(appended.ok_or_else(other_type)??)
    }

    /// A copy of a stream, as an estimator or a bank that goes on from there.
    ///
    /// # Errors
    /// [`Error::NoStream`].
    pub fn get(&self, stream: i64) -> Result<Stream, Error> {
        let stream = self.position(stream)?;
        Ok(match &self.kept {
            Kept::Estimators(typed) => {
                Stream::Estimator(Estimator::of(map!(typed, streams => streams.get(stream))))
            }
            Kept::Banks(typed) => {
                Stream::Bank(Bank { typed: map!(typed, streams => streams.get(stream)) })
            }
        })
    }

    /// Puts `new` in the place of a stream.
    ///
    /// # Errors
    /// [`Error::NoStream`], or [`Error`] says what differs; nothing has changed.
    pub fn put(&mut self, stream: i64, new: impl Into<Stream>) -> Result<(), Error> {
        let stream = self.position(stream)?;
        let put = match (&mut self.kept, new.into()) {
            (Kept::Estimators(own), Stream::Estimator(new)) => {
                both!(own, new.typed; streams, new => streams.put(stream, *new))
            }
            (Kept::Banks(own), Stream::Bank(new)) => {
                both!(own, new.typed; streams, new => streams.put(stream, *new))
            }
            _ => return Err(self.other_kind()),
        };
        Ok(put.ok_or_else(other_type)??)
    }

    fn other_kind(&self) -> Error {
        Error::unsupported(match self.kept {
            Kept::Estimators(_) => "a stream of this fleet is one estimator, not a bank of them",
            Kept::Banks(_) => "a stream of this fleet is a bank, not one estimator",
        })
    }
}

fn other_type() -> Error {
    Error::unsupported("a stream has the dtype of its fleet")
}
