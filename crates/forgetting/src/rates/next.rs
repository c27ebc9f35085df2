//! The state of a design that finds λ for the next sample and remembers nothing else.

use crate::memory::state::{is_factor, State, Visitor};
use forgetting_kernels::Real;

/// The next λ.
#[derive(Clone, Copy, Debug)]
pub struct Next<T>(pub T);

impl<T: Real> State<T> for Next<T> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.reals(core::slice::from_mut(&mut self.0));
    }

    fn is_sound(&self) -> bool {
        is_factor(self.0)
    }
}
