//! Past values of a signal.

use crate::memory::state::Visitor;
use alloc::vec;
use alloc::vec::Vec;

/// The last values of a signal, the newest first.
#[derive(Clone, Debug)]
pub(super) struct History(Vec<f64>);

impl History {
    /// So many zeros.
    pub fn of(length: usize) -> Self {
        Self(vec![0.0; length])
    }

    /// Adds the newest value, drops the oldest.
    pub fn push(&mut self, value: f64) {
        if let Some(kept) = self.0.len().checked_sub(1) {
            self.0.copy_within(..kept, 1);
            self.0[0] = value;
        }
    }

    /// The newest value; 0 if none is kept.
    pub fn newest(&self) -> f64 {
        self.0.first().copied().unwrap_or(0.0)
    }

    /// The values from `lag` samples before the newest on, so many.
    pub fn from(&self, lag: usize, count: usize) -> &[f64] {
        &self.0[lag..lag + count]
    }

    /// Σ cᵢ x(k − lag − i)
    pub fn filtered(&self, coefficients: &[f64], lag: usize) -> f64 {
        let values = self.from(lag, coefficients.len());
        coefficients.iter().zip(values).map(|(c, x)| c * x).sum()
    }

    /// All zeros again.
    pub fn clear(&mut self) {
        self.0.fill(0.0);
    }

    /// Shows all values to `visitor`.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<f64>) {
        visitor.reals(&mut self.0);
    }
}
