//! What the next sample needs, as numbers that can be saved and restored.

use core::fmt::Debug;
use forgetting_kernels::Real;

/// Reads or writes the numbers of a state, one after the other, in a fixed order.
pub trait Visitor<T: Real> {
    /// These numbers.
    fn reals(&mut self, values: &mut [T]);
    /// This count.
    fn whole(&mut self, value: &mut u64);
}

/// The most samples that a count can be of.
pub(crate) const MOST_SAMPLES: u64 = u64::MAX / 2;

/// A state: it names its numbers once, for saving and restoring both.
pub trait State<T: Real>: Clone + Debug + Send + Sync {
    /// Shows every number to `visitor`.
    fn visit(&mut self, visitor: &mut dyn Visitor<T>);

    /// Whether these are numbers that samples can have led to, as far as the next sample relies on
    /// it: a saved state may have been tampered with. Unless said otherwise, if they are finite.
    fn is_sound(&self) -> bool {
        is_finite(self)
    }
}

/// Whether every number is finite, and no count near its end.
pub(crate) fn is_finite<T: Real, S: State<T>>(state: &S) -> bool {
    let mut state = state.clone();
    shows_finite(|visitor| state.visit(visitor))
}

/// Whether all numbers that `visit` shows are finite, and no count near its end.
pub(crate) fn shows_finite<T: Real>(visit: impl FnOnce(&mut dyn Visitor<T>)) -> bool {
    let mut finite = Finite(true);
    visit(&mut finite);
    finite.0
}

/// Whether all numbers seen were finite.
struct Finite(bool);

impl<T: Real> Visitor<T> for Finite {
    fn reals(&mut self, values: &mut [T]) {
        self.0 &= values.iter().all(|x| x.is_finite());
    }

    fn whole(&mut self, value: &mut u64) {
        self.0 &= *value <= MOST_SAMPLES;
    }
}

impl<T: Real> State<T> for () {
    fn visit(&mut self, _: &mut dyn Visitor<T>) {}
}

/// One that there may not be.
impl<T: Real, S: State<T>> State<T> for Option<S> {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        if let Some(state) = self {
            state.visit(visitor);
        }
    }

    fn is_sound(&self) -> bool {
        self.as_ref().is_none_or(State::is_sound)
    }
}

/// Whether this can be a forgetting factor.
pub(crate) fn is_factor<T: Real>(lambda: T) -> bool {
    lambda > T::ZERO && lambda <= T::ONE
}
