//! A sample of which the time since the last one, or the variance of its noise, is known.
//!
//! What this takes (an exponential, a logarithm, a square root) is linked only into programs that have
//! such samples: it happens outside of the estimator, on slices, and once for a number type.

use super::Compact;
use crate::error::Error;
use crate::memory::{Fixed, Packed, Size};
use crate::rules::random_walk::steps_after;
use crate::rules::Forgetting;
use crate::sample::{blame, check_elapsed, check_gamma, factor_after};
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::Kernels;

/// How fast an estimator forgets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace<T> {
    /// λ of one unit of time
    pub factor: T,
    /// the process noise of one unit of time over its bound; 0 where there is none
    pub share: T,
}

/// What is known of a sample that was whitened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given<T> {
    /// (y − φθ)/√Γ
    pub error: T,
    /// λ of the time that has passed
    pub factor: T,
    /// the process noise of that time, in that of one unit of time
    pub steps: T,
}

impl<T: Kernels> Pace<T> {
    /// What is known of the sample (`phi`, `y`), `elapsed` after the last one, of which θ says `product`
    /// and noise of the variance `gamma`; 1 if none is given. Writes φ/√Γ to `whitened`, as many numbers
    /// as `phi`.
    ///
    /// # Errors
    /// [`Error`] names what is not finite, too large or out of its range.
    pub fn given(
        self,
        elapsed: T,
        (phi, y, product): (&[T], T, T),
        gamma: Option<T>,
        whitened: &mut [T],
    ) -> Result<Given<T>, Error> {
        check_elapsed(elapsed)?;
        let error = y - product;
        if !(error.abs() <= T::CEILING) {
            return Err(blame(phi, &[y], error.abs()));
        }
        let scale = match gamma {
            None => T::ONE,
            Some(gamma) => {
                check_gamma(gamma)?;
                T::ONE / gamma.sqrt()
            }
        };
        for (whitened, &phi) in whitened.iter_mut().zip(phi) {
            *whitened = phi * scale;
        }
        Ok(Given {
            error: error * scale,
            factor: factor_after(self.factor.max(T::EPSILON), elapsed),
            steps: steps_after(self.share.to_f64(), elapsed),
        })
    }
}

impl<F, T, const N: usize> Compact<F, T, N>
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    /// Takes a sample `elapsed` after the last one, the variance of its noise being `gamma`, or 1: as
    /// [`Estimator::update_after`](crate::Estimator::update_after).
    ///
    /// # Errors
    /// [`Error`] names what was wrong; the estimator is as it was, bit for bit.
    pub fn update_after(
        &mut self,
        elapsed: T,
        phi: &[T; N],
        y: T,
        gamma: Option<T>,
    ) -> Result<Outcome<T>, Error> {
        let (mut whitened, product) = ([T::ZERO; N], self.predict(phi));
        let given = self.pace().given(elapsed, (phi, y, product), gamma, &mut whitened)?;
        let outcome = self.take(&whitened, y, Some(&given))?;
        Ok(Outcome { error: y - product, ..outcome })
    }
}
