//! What streams were before their samples, so that they can be that again.

use super::part::Part;
use super::size::reserve;
use super::Line;
use crate::error::Error;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// A copy of all that a sample changes of a [`Part`].
#[derive(Clone, Debug)]
pub struct Before<T: Kernels> {
    lines: Vec<Line<T>>,
    offered: Vec<u64>,
    unused: Vec<u64>,
    units: Option<(Vec<Line<T>>, Vec<u64>)>,
    following: Option<Following>,
}

/// When streams that follow the data will be on their own.
#[derive(Clone, Debug)]
struct Following {
    renewed: Vec<u64>,
    settled: Vec<bool>,
    due: Vec<u64>,
}

impl<T: Kernels> Part<'_, T> {
    /// What the streams are now.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none for a copy.
    pub fn before(&self) -> Result<Before<T>, Error> {
        let Self { streams, following } = self;
        let units = streams.units.as_ref();
        let units = units.map(|units| Ok((copy(units.lines)?, copy(units.unmeasured)?)));
        let following = following.as_ref().map(|following| {
            let (renewed, settled) = (copy(following.renewed)?, copy(following.settled)?);
            Ok(Following { renewed, settled, due: copy(following.due)? })
        });
        Ok(Before {
            lines: copy(streams.lines)?,
            offered: copy(streams.offered)?,
            unused: copy(streams.unused)?,
            units: units.transpose()?,
            following: following.transpose()?,
        })
    }

    /// Makes the streams what they were, bit for bit.
    ///
    /// # Panics
    /// Unless they are the streams that `before` was taken of.
    pub fn put_back(&mut self, before: &Before<T>) {
        let Self { streams, following } = self;
        streams.lines.copy_from_slice(&before.lines);
        streams.offered.copy_from_slice(&before.offered);
        streams.unused.copy_from_slice(&before.unused);
        if let (Some(units), Some((lines, unmeasured))) = (&mut streams.units, &before.units) {
            units.lines.copy_from_slice(lines);
            units.unmeasured.copy_from_slice(unmeasured);
        }
        if let (Some(following), Some(before)) = (following, &before.following) {
            following.renewed.copy_from_slice(&before.renewed);
            following.settled.copy_from_slice(&before.settled);
            following.due.copy_from_slice(&before.due);
        }
    }
}

fn copy<X: Copy>(numbers: &[X]) -> Result<Vec<X>, Error> {
    let mut copy = Vec::new();
    reserve(&mut copy, numbers.len())?;
    copy.extend_from_slice(numbers);
    Ok(copy)
}
