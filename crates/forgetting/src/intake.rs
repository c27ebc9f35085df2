//! The sample as it comes in: checked, then whitened. Whatever is wrong with it is found here,
//! before anything changes.

use crate::covariance::dense::check_symmetric;
use crate::{Error, Memory, Real, Sample};
use forgetting_kernels::kernel::functions::{arrive, dot};

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

/// The sample's buffers.
#[derive(Clone, Debug)]
pub(crate) struct Intake<M: Memory> {
    /// p x n: the whitened regressor
    pub regressors: M::Rows,
    /// p x m: the innovation y − φθ, in units of y
    pub innovations: M::Errors,
    /// p x m: the whitened innovation
    pub errors: M::Errors,
    /// p x m: the whitened innovation as rates and weightings see it
    pub seen: M::Errors,
    /// p x m: what is left of it as the rows of a sample are used one after the other
    pub remaining: M::Errors,
    /// p x p: Γ, then its root
    pub noise: M::Noise,
}

impl<M: Memory> Intake<M> {
    /// Buffers of these sizes.
    pub fn new(memory: M) -> Self {
        Self {
            regressors: memory.regressors(),
            innovations: memory.errors(),
            errors: memory.errors(),
            seen: memory.errors(),
            remaining: memory.errors(),
            noise: memory.noise(),
        }
    }

    /// Checks the sample and keeps y − φθ and φ, not yet whitened; returns ‖φ‖².
    ///
    /// # Errors
    /// [`Error`] names what does not fit, is not finite or is too large.
    #[inline]
    pub fn take(
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
