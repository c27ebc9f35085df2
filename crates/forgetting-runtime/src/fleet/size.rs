//! More streams: new ones, and copies of others.

use super::pieces::{each_stream, extend};
use super::streams::Streams;
use crate::configure::check_copies;
use crate::estimator::GoOn;
use crate::number::Number;
use forgetting::fleet::{check_kind, Fleet};
use forgetting::{AnyEstimator, Error};

impl<T: Number> Streams<T> {
    /// Adds `count` new streams.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none, and that of `go_on`; nothing has changed.
    pub fn grow(&mut self, count: usize, go_on: GoOn<'_>) -> Result<(), Error> {
        match self {
            Self::Blocks(fleet) => {
                make_room(fleet, count, go_on)?;
                extend(fleet, None, count, go_on)
            }
            Self::Estimators { fresh, each } => {
                check_copies(fresh, count)?;
                add(each, count, go_on, |_| Ok(fresh.as_ref().clone()))
            }
        }
    }

    /// Adds copies of the streams of `others`.
    ///
    /// # Errors
    /// Those of [`check_kind`], [`Error::Memory`], and that of `go_on`; nothing has changed.
    pub fn append(&mut self, others: &Self, go_on: GoOn<'_>) -> Result<(), Error> {
        check_kind(self.fresh(), others.fresh())?;
        match (&mut *self, others) {
            (Self::Blocks(own), Self::Blocks(others)) => {
                make_room(own, others.count(), go_on)?;
                extend(own, Some(others), 0, go_on)
            }
            (Self::Blocks(own), Self::Estimators { each, .. }) => {
                let before = own.count();
                make_room(own, each.len(), go_on)?;
                extend(own, None, each.len(), go_on)?;
                let n = own.parameters();
                let put = |i: usize| own.put(before + i, each[i].clone());
                let added = each_stream(each.len(), n, go_on, put);
                if added.is_err() {
                    own.truncate(before);
                }
                added
            }
            (Self::Estimators { fresh, each }, others) => {
                check_copies(fresh, others.count())?;
                add(each, others.count(), go_on, |i| Ok(others.get(i)))
            }
        }
    }

    /// A copy of all.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for it, and that of `go_on`.
    pub fn copy(&self, go_on: GoOn<'_>) -> Result<Self, Error> {
        let mut copy = Self::of(self.fresh().clone());
        copy.append(self, go_on)?;
        Ok(copy)
    }
}

/// Adds `count` streams to `each`.
fn add<T: Number>(
    each: &mut Vec<AnyEstimator<T>>,
    count: usize,
    go_on: GoOn<'_>,
    mut make: impl FnMut(usize) -> Result<AnyEstimator<T>, Error>,
) -> Result<(), Error> {
    each.try_reserve(count).map_err(|_| Error::Memory)?;
    let before = each.len();
    // to make a stream costs as much as to pass over many numbers
    let added = each_stream(count, 64, go_on, |i| {
        each.push(make(i)?);
        Ok(())
    });
    if added.is_err() {
        each.truncate(before);
    }
    added
}

/// Makes room for `count` more streams. Where the streams need another place for it, which takes long
/// where they are many, they are copied there one after the other.
fn make_room<T: Number>(fleet: &mut Fleet<T>, count: usize, go_on: GoOn<'_>) -> Result<(), Error> {
    if fleet.count() == 0 || fleet.has_room(count) {
        return fleet.reserve(count);
    }
    let mut roomy = Fleet::of(fleet.fresh().clone())?;
    let all = fleet.count().checked_add(count).ok_or(Error::Memory)?;
    // twice as many, so that many small additions together cost no more than a few copies
    roomy.reserve(all.max(2 * fleet.count())).or_else(|_| roomy.reserve(all))?;
    extend(&mut roomy, Some(&*fleet), 0, go_on)?;
    *fleet = roomy;
    Ok(())
}
