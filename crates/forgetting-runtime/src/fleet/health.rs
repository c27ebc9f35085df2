//! How far the estimates of a fleet can be trusted.

use crate::number::Array;

/// Numbers that bound P of each stream, and what else its health is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct StreamHealth {
    /// the largest element of D of each stream, (count,)
    pub largest: Array,
    /// the smallest element of D of each stream, (count,)
    pub smallest: Array,
    /// whether D has grown to more than ten times its first largest element, (count,) yes or no
    pub windup: Array,
    /// samples used since the start, (count,) counts
    pub samples: Array,
}
