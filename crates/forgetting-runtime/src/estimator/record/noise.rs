//! The noise covariance of a record.

use super::shapes::Sizes;
use crate::error::Error;
use crate::number::Number;
use crate::shape::either;
use forgetting::Noise;

/// Γ of a record: the same for all samples, or one a sample.
#[derive(Clone, Copy)]
pub(crate) enum RecordNoise<'a, T> {
    Unit,
    Scalar(T),
    Full(&'a [T]),
    Scalars(&'a [T]),
    Fulls(&'a [T]),
}

impl<'a, T: Number> RecordNoise<'a, T> {
    /// Γ by its shape.
    ///
    /// # Errors
    /// [`Error::Shape`] names `gamma`.
    pub fn read(shape: &[usize], gamma: &'a [T], sizes: Sizes) -> Result<Self, Error> {
        let Sizes { samples, rows: p, .. } = sizes;
        match *shape {
            [] => Ok(Self::Scalar(gamma[0])),
            [t] if t == samples => Ok(Self::Scalars(gamma)),
            [a, b] if (a, b) == (p, p) => Ok(Self::Full(gamma)),
            [t, a, b] if (t, a, b) == (samples, p, p) => Ok(Self::Fulls(gamma)),
            _ => {
                let allowed = [vec![], vec![p, p], vec![samples], vec![samples, p, p]];
                Err(Error::shape("gamma", shape, either(&allowed)))
            }
        }
    }

    /// Γ of one sample of `rows` rows.
    pub fn at(&self, sample: usize, rows: usize) -> Noise<'a, T> {
        match *self {
            Self::Unit => Noise::Unit,
            Self::Scalar(gamma) => Noise::Scalar(gamma),
            Self::Full(gamma) => Noise::Full(gamma),
            Self::Scalars(gammas) => Noise::Scalar(gammas[sample]),
            Self::Fulls(gammas) => {
                Noise::Full(&gammas[sample * rows * rows..(sample + 1) * rows * rows])
            }
        }
    }
}
