//! Two windows over the last samples, a short one inside a long one.

use crate::choice::{Parameter, Range, Value, Values};
use crate::error::Error;
use crate::memory::Memory;

const SHORT: Parameter = Parameter::whole(
    "short_window",
    10.0,
    Range::AT_LEAST_ONE,
    "samples of the recent past, this one included",
);
const LONG: Parameter = Parameter::whole(
    "long_window",
    100.0,
    Range::AT_LEAST_ONE,
    "samples of the past to compare with, more than the short window",
);

/// τ_n < τ_d samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Windows {
    short: usize,
    long: usize,
}

impl Windows {
    pub(super) const PARAMETERS: [Parameter; 2] = [SHORT, LONG];

    /// With 1 ≤ `short` < `long`.
    ///
    /// # Errors
    /// [`Error::Value`] names the one that is out of range.
    pub fn new(short: usize, long: usize) -> Result<Self, Error> {
        SHORT.check(short as f64)?;
        if long > short {
            Ok(Self { short, long })
        } else {
            Err(Error::value("long_window", long as f64, "more than short_window"))
        }
    }

    /// From the values of the parameters.
    pub(super) fn configure(values: &dyn Values) -> Result<Self, Error> {
        let (short, long): (f64, f64) = (SHORT.number(values)?, LONG.number(values)?);
        Self::new(short as usize, long as usize)
    }

    /// Names both.
    pub(super) fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(SHORT.name, Value::Real(self.short as f64));
        each(LONG.name, Value::Real(self.long as f64));
    }

    /// Refuses a long window that a list, with `width` numbers a sample and `more` beside, has
    /// no room for.
    pub(super) fn fit<M: Memory>(&self, memory: M, width: usize, more: usize) -> Result<(), Error> {
        let needed = self.long.saturating_mul(width).saturating_add(more);
        if needed <= memory.longest_list() {
            Ok(())
        } else {
            let allowed = "what the lists of the memory have room for";
            Err(Error::value("long_window", self.long as f64, allowed))
        }
    }

    /// τ_n
    #[inline]
    pub fn short(&self) -> usize {
        self.short
    }

    /// τ_d
    #[inline]
    pub fn long(&self) -> usize {
        self.long
    }

    /// Where sample number `samples` is kept in a ring of τ_d places: over the oldest.
    #[inline]
    pub(super) fn place(&self, samples: u64) -> usize {
        (samples % self.long as u64) as usize
    }

    /// Whether the long window is full with sample number `samples`.
    #[inline]
    pub(super) fn full(&self, samples: u64) -> bool {
        samples + 1 >= self.long as u64
    }

    /// The places of the τ_n − 1 samples before the one at `place`.
    #[inline]
    pub(super) fn recent(&self, place: usize) -> impl Iterator<Item = usize> {
        let long = self.long;
        (1..self.short).map(move |age| (place + long - age) % long)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Error, Windows};
    use std::vec::Vec;

    #[test]
    fn the_ring_holds_the_last_samples() {
        let windows = Windows::new(3, 5).unwrap();
        assert_eq!(windows.place(12), 2);
        assert_eq!(windows.recent(0).collect::<Vec<_>>(), [4, 3]);
        assert_eq!([3, 4].map(|k| windows.full(k)), [false, true]);
    }

    #[test]
    fn refuses_windows_that_are_not_one_inside_the_other() {
        for (short, long) in [(5, 5), (6, 5)] {
            let refused = Windows::new(short, long);
            assert!(matches!(refused, Err(Error::Value { parameter: "long_window", .. })));
        }
        assert!(matches!(Windows::new(0, 5), Err(Error::Value { parameter: "short_window", .. })));
    }
}
