//! What the next sample needs, as numbers that can be saved and restored.

use crate::Real;
use core::fmt::Debug;

/// Reads or writes the numbers of a state, one after the other, in a fixed order.
pub trait Visitor<T: Real> {
    /// These numbers.
    fn reals(&mut self, values: &mut [T]);
    /// This count.
    fn whole(&mut self, value: &mut u64);
}

/// A state: it names its numbers once, for saving and restoring both.
pub trait State<T: Real>: Clone + Debug + Send + Sync {
    /// Shows every number to `visitor`.
    fn visit(&mut self, visitor: &mut dyn Visitor<T>);
}

impl<T: Real> State<T> for () {
    fn visit(&mut self, _: &mut dyn Visitor<T>) {}
}
