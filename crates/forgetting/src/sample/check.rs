//! Checks a sample as it comes in: whatever is wrong with it is found here, before anything changes.

use super::SampleBuffers;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::functions::{arrive, dot};
use forgetting_kernels::Real;

impl<M: Memory> SampleBuffers<M> {
    /// Checks the sample and stores y − φθ and φ, not yet whitened; returns ‖φ‖².
    ///
    /// # Errors
    /// [`Error`] names what does not fit, is not finite or is too large.
    #[inline]
    pub fn load(
        &mut self,
        memory: M,
        theta: &[M::Real],
        phi: &[M::Real],
        y: &[M::Real],
    ) -> Result<M::Real, Error> {
        let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
        Error::check_length("phi", phi.len(), p * n)?;
        Error::check_length("y", y.len(), p * m)?;
        let (regressors, innovations) = (self.regressors.as_mut(), self.innovations.as_mut());
        let errors = self.errors.as_mut();
        let (mut largest, mut squares) = (M::Real::ZERO, M::Real::ZERO);
        for i in 0..p {
            let phi = &phi[i * n..(i + 1) * n];
            let (first, square) = arrive(phi, &theta[..n], &mut regressors[i * n..(i + 1) * n]);
            squares += square;
            for t in 0..m {
                let product = if t == 0 { first } else { dot(phi, &theta[t * n..(t + 1) * n]) };
                let error = y[i * m + t] - product;
                innovations[i * m + t] = error;
                errors[i * m + t] = error;
                // written so that a NaN stays
                largest = if error.abs() <= largest { largest } else { error.abs() };
            }
        }
        if !(largest <= M::Real::CEILING) {
            return Err(blame(phi, y, largest));
        }
        Ok(squares)
    }
}

/// Refuses parameters that are not finite, or too large to compute with.
///
/// # Errors
/// [`Error::Value`] names `theta`.
pub(crate) fn check_theta<T: Real>(theta: &[T]) -> Result<(), Error> {
    for (i, x) in theta.iter().enumerate() {
        if !(x.abs() < T::CEILING) {
            let allowed = "finite, and less than the root of the largest number";
            return Err(Error::value("theta", x.to_f64(), allowed).at(i));
        }
    }
    Ok(())
}

/// Which part of a sample with an innovation that is too large is to blame.
#[cold]
pub(crate) fn blame<T: Real>(phi: &[T], y: &[T], largest: T) -> Error {
    for (parameter, values) in [("phi", phi), ("y", y)] {
        if let Some(index) = values.iter().position(|x| !x.is_finite()) {
            return not_finite(parameter, index, values[index]);
        }
    }
    out_of_range("error (y - phi theta)", largest)
}

#[cold]
pub(crate) fn not_finite<T: Real>(parameter: &'static str, index: usize, value: T) -> Error {
    let allowed = "finite numbers";
    Error::Value { parameter, index: Some(index), value: value.to_f64(), allowed }
}

#[cold]
pub(crate) fn out_of_range<T: Real>(parameter: &'static str, value: T) -> Error {
    Error::Range { parameter, value: value.to_f64(), limit: T::CEILING.to_f64() }
}
