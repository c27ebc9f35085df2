//! The point from which a model with a constant measures.
//!
//! It says the same of u − u₀ and y − y₀ with another constant. Measured from their first values,
//! signals that are far from zero start at rest where they are, and filters need not forget a jump.

use super::orders::Layout;
use crate::memory::state::Visitor;
use alloc::vec;
use alloc::vec::Vec;

/// The first value of each input and of y; NaN while there was none.
#[derive(Clone, Debug)]
pub(super) struct Origin {
    /// nothing where zero is the origin
    first: Option<Vec<f64>>,
}

impl Origin {
    /// Of so many inputs, if the model has a constant.
    pub fn new(inputs: usize, constant: bool) -> Self {
        Self { first: constant.then(|| vec![f64::NAN; inputs + 1]) }
    }

    /// The value of this input, measured from its first.
    pub fn input(&mut self, i: usize, value: f64) -> f64 {
        let first = self.first.as_mut().and_then(|first| first.get_mut(i));
        from_first(first, value)
    }

    /// The value of y, measured from its first.
    pub fn output(&mut self, value: f64) -> f64 {
        from_first(self.first.as_mut().and_then(|first| first.last_mut()), value)
    }

    /// Whether there was a value of y, if that matters.
    pub fn is_known(&self) -> bool {
        let first = self.first.as_ref().and_then(|first| first.last());
        first.is_none_or(|y| !y.is_nan())
    }

    /// y₀, 0 while it is not known.
    pub fn of_output(&self) -> f64 {
        let first = self.first.as_ref().and_then(|first| first.last()).copied();
        first.filter(|y| !y.is_nan()).unwrap_or(0.0)
    }

    /// Makes the constant of θ that of signals measured from zero.
    pub fn express(&self, theta: &mut [f64], layout: &Layout) {
        let Some(first) = &self.first else { return };
        let sum = |place: &core::ops::Range<usize>| theta[place.clone()].iter().sum::<f64>();
        let mut moved = self.of_output() * (1.0 - sum(&layout.a));
        for ((b, f), &u) in layout.b.iter().zip(&layout.f).zip(first) {
            if !u.is_nan() {
                moved -= u * sum(b) / (1.0 - sum(f));
            }
        }
        theta[layout.constant.clone()].iter_mut().for_each(|own| *own += moved);
    }

    pub fn visit(&mut self, visitor: &mut dyn Visitor<f64>) {
        if let Some(first) = &mut self.first {
            visitor.reals(first);
        }
    }
}

/// A value measured from the first one, which it is if there was none.
fn from_first(first: Option<&mut f64>, value: f64) -> f64 {
    let Some(first) = first else { return value };
    if first.is_nan() {
        *first = value;
    }
    value - *first
}
