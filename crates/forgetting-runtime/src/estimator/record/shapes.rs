//! The shapes of a record.

use crate::error::Error;
use crate::number::View;
use crate::shape;
use forgetting::Memory;

/// Sizes of a record.
#[derive(Clone, Copy)]
pub(crate) struct Sizes {
    pub samples: usize,
    pub parameters: usize,
    pub rows: usize,
    pub targets: usize,
}

impl Sizes {
    /// Those of the record `phi`, `y` for an estimator of these sizes.
    ///
    /// # Errors
    /// [`Error::Shape`] names what does not fit.
    pub fn of<M: Memory>(memory: M, phi: &View<'_>, y: &View<'_>) -> Result<Self, Error> {
        let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
        let samples = phi.shape().first().copied().unwrap_or(0);
        shape::check("phi", phi.shape(), &[samples], &[p, n])?;
        shape::check("y", y.shape(), &[samples], &[p, m])?;
        Ok(Self { samples, parameters: n, rows: p, targets: m })
    }
}
