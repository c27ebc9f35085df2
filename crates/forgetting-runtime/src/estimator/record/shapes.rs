//! The shapes of a record.

use crate::error::Error;
use crate::number::View;
use forgetting::Memory;

/// Sizes of a record.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
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
        check("phi", phi.shape(), samples, [p, n])?;
        check("y", y.shape(), samples, [p, m])?;
        Ok(Self { samples, parameters: n, rows: p, targets: m })
    }
}

/// Refuses a shape other than `samples` times `sample`, dimensions of 1 left out or not.
fn check(name: &str, shape: &[usize], samples: usize, sample: [usize; 2]) -> Result<(), Error> {
    let longer = |sizes: &[usize]| sizes.iter().copied().filter(|&d| d != 1).collect::<Vec<_>>();
    let fits = shape.first() == Some(&samples)
        && longer(&shape[1..]) == longer(&sample)
        && shape.len() <= 3;
    if fits {
        return Ok(());
    }
    let [p, n] = sample;
    Err(Error::shape(name, shape, format!("({samples}, {p}, {n}) or less ones")))
}
