//! The noise covariance Γ of a sample, and whitening by it.

use super::Sample;
use crate::covariance::dense::check_symmetric;
use crate::{Error, Memory, Real};

/// The noise covariance Γ of one sample.
#[derive(Clone, Copy, Debug)]
pub enum Noise<'a, T> {
    /// Γ = I
    Unit,
    /// Γ = c·I
    Scalar(T),
    /// p x p numbers, symmetric and positive definite
    Full(&'a [T]),
}

/// Applies Γ = `noise`; a full one is left factored in `root`.
#[inline]
pub fn whiten<M: Memory>(
    sample: &mut Sample<'_, M>,
    noise: Noise<'_, M::Real>,
    root: &mut [M::Real],
) -> Result<(), Error> {
    match noise {
        Noise::Unit => Ok(()),
        Noise::Scalar(gamma) => {
            if !(gamma > M::Real::ZERO && gamma.is_finite()) {
                return Err(Error::value("gamma", gamma.to_f64(), "positive and finite"));
            }
            sample.scale(M::Real::ONE / gamma.sqrt());
            Ok(())
        }
        Noise::Full(gamma) => {
            Error::check_length("gamma", gamma.len(), root.len())?;
            check_symmetric("gamma", gamma, sample.rows())?;
            root.copy_from_slice(gamma);
            sample.whiten(root)
        }
    }
}
