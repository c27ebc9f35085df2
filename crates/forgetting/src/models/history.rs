//! Past values of a signal.

use crate::memory::state::Visitor;
use alloc::vec;
use alloc::vec::Vec;

/// Values that are pushed between two moves of those that are kept.
const ROOM: usize = 64;

/// The last values of a signal, the newest first, next to each other.
#[derive(Clone, Debug)]
pub(super) struct History {
    /// the kept values stand from `newest` on; before it there is room for more
    values: Vec<f64>,
    newest: usize,
    length: usize,
}

impl History {
    /// So many zeros.
    pub fn of(length: usize) -> Self {
        let room = if length == 0 { 0 } else { ROOM };
        Self { values: vec![0.0; length + room], newest: room, length }
    }

    /// Adds the newest value, drops the oldest.
    #[inline]
    pub fn push(&mut self, value: f64) {
        if self.length == 0 {
            return;
        }
        if self.newest == 0 {
            self.values.copy_within(..self.length, ROOM);
            self.newest = ROOM;
        }
        self.newest -= 1;
        self.values[self.newest] = value;
    }

    /// The newest value; 0 if none is kept.
    #[inline]
    pub fn newest(&self) -> f64 {
        self.values.get(self.newest).copied().unwrap_or(0.0)
    }

    /// The values from `lag` samples before the newest on, so many.
    #[inline]
    pub fn from(&self, lag: usize, count: usize) -> &[f64] {
        &self.values[self.newest..self.newest + self.length][lag..lag + count]
    }

    /// Σ cᵢ x(k − lag − i)
    #[inline]
    pub fn filtered(&self, coefficients: &[f64], lag: usize) -> f64 {
        let mut sum = 0.0;
        if !coefficients.is_empty() {
            for (c, x) in coefficients.iter().zip(self.from(lag, coefficients.len())) {
                sum += c * x;
            }
        }
        sum
    }

    /// All zeros again.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Shows all values to `visitor`.
    pub fn visit(&mut self, visitor: &mut dyn Visitor<f64>) {
        visitor.reals(&mut self.values[self.newest..self.newest + self.length]);
    }
}
