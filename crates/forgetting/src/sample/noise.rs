//! The noise covariance Γ of a sample, and whitening by it.

use super::{cholesky, Sample};
use crate::covariance::dense::check_symmetric;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::add_scaled;
use forgetting_kernels::Real;

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

impl<T: Real> Noise<'_, T> {
    /// The standard deviation of the noise, a typical one of several rows; 1 where Γ is not one.
    #[inline]
    pub(crate) fn deviation(&self) -> T {
        let variance = match *self {
            Self::Unit => return T::ONE,
            Self::Scalar(gamma) => gamma,
            Self::Full(gamma) => mean_variance(gamma),
        };
        let deviation = variance.sqrt();
        if deviation > T::ZERO && deviation.is_finite() {
            deviation
        } else {
            T::ONE
        }
    }
}

/// The mean of the diagonal of Γ.
fn mean_variance<T: Real>(gamma: &[T]) -> T {
    let rows = gamma.len().isqrt();
    let diagonal = gamma.iter().step_by(rows + 1);
    diagonal.fold(T::ZERO, |sum, &x| sum + x) / T::from_f64(rows as f64)
}

/// Refuses what is not a variance.
///
/// # Errors
/// [`Error::Value`] names `gamma`.
#[inline]
pub(crate) fn check_gamma<T: Real>(gamma: T) -> Result<(), Error> {
    if gamma > T::ZERO && gamma.is_finite() {
        return Ok(());
    }
    Err(Error::value("gamma", gamma.to_f64(), "positive and finite"))
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
            check_gamma(gamma)?;
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

impl<M: Memory> Sample<'_, M> {
    /// Whitens the sample by the p x p matrix `gamma` = L Lᵀ: φ̄ = L⁻¹φ, ē = L⁻¹e.
    ///
    /// `gamma` becomes L. The sample is untouched if that fails.
    ///
    /// # Errors
    /// [`Error::Indefinite`] unless `gamma` is positive definite.
    pub fn whiten(&mut self, gamma: &mut [M::Real]) -> Result<(), Error> {
        let p = self.rows;
        cholesky(gamma, p, "gamma")?;
        for i in 0..p {
            for k in 0..i {
                self.subtract_row(i, gamma[i * p + k], k);
            }
            self.scale_row(i, M::Real::ONE / gamma[i * p + i]);
        }
        Ok(())
    }

    /// Row i −= c·row k, k < i, in φ̄ and ē.
    fn subtract_row(&mut self, i: usize, c: M::Real, k: usize) {
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        for (block, width) in [(&mut *self.regressors, n), (&mut *self.errors, m)] {
            let (above, from) = block.split_at_mut(i * width);
            add_scaled(&mut from[..width], -c, &above[k * width..(k + 1) * width]);
        }
    }

    fn scale_row(&mut self, i: usize, c: M::Real) {
        let (n, m) = (self.memory.parameters(), self.memory.targets());
        for (block, width) in [(&mut *self.regressors, n), (&mut *self.errors, m)] {
            block[i * width..(i + 1) * width].iter_mut().for_each(|x| *x *= c);
        }
    }
}
