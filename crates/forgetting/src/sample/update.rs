//! What an update reports of its sample.

use super::{Answer, Skip};
use crate::error::Error;
use forgetting_kernels::Real;

/// What an update reports of its sample.
#[derive(Clone, Copy, Debug)]
pub struct Update<'a, T> {
    /// y − φθ with the θ of before: p x m numbers, row by row, in units of y
    pub error: &'a [T],
    /// tr φ̄P̄φ̄ᵀ, φ̄ whitened by Γ over the weight of the weighting: the variance of the prediction in
    /// units of the noise's
    pub leverage: T,
    /// Γ was divided by this: by the weight of the weighting, and by what the rule made of the
    /// sample
    pub weight: T,
    /// the λ used; 1 if the gate froze or held the sample
    pub forgetting_factor: T,
    /// the number of directions that lost information
    pub rank: usize,
    /// why the sample was left out, if it was
    pub skipped: Option<Skip>,
    /// what the gate said
    pub gate: Answer,
    /// whether P has wound up: as the monitor says ([`Health::windup`](crate::Health)) if there is
    /// one, else whether P has grown beyond [`Estimator::WINDUP`](crate::Estimator::WINDUP) times
    /// its first value
    pub windup: bool,
    pub(crate) whitened: Whitened<'a, T>,
}

/// What L⁻¹e is computed from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Whitened<'a, T> {
    /// one row: ē as the rule left it, and the variance of its noise
    Row { errors: &'a [T], noise: T },
    /// several rows: L⁻¹e itself
    Rows(&'a [T]),
    /// several rows, and it was not asked for
    Unknown,
}

impl<T: Real> Update<'_, T> {
    /// L⁻¹(y − φθ) with L Lᵀ = Γ + φP̄φᵀ, L lower triangular, written to p x m numbers `whitened`,
    /// row by row.
    ///
    /// Of independent numbers with the mean 0 and the variance σ² if the model is right, P̄ is the
    /// covariance of θ and the noise has the covariance σ²Γ. Γ is divided by the weight of the
    /// sample; P̄ is P after forgetting. For one row it is (y − φθ)/√(Γ(1 + leverage)).
    ///
    /// # Errors
    /// [`Error::Length`], or [`Error::Unsupported`] for several rows unless they were asked for
    /// with [`Estimator::keep_innovations`](crate::Estimator::keep_innovations).
    pub fn whiten(&self, whitened: &mut [T]) -> Result<(), Error> {
        Error::check_length("whitened", whitened.len(), self.error.len())?;
        match self.whitened {
            Whitened::Row { errors, noise } => {
                let deviation = (noise + noise * self.leverage).sqrt();
                for (whitened, &error) in whitened.iter_mut().zip(errors) {
                    *whitened = error / deviation;
                }
                Ok(())
            }
            Whitened::Rows(kept) => {
                whitened.copy_from_slice(kept);
                Ok(())
            }
            Whitened::Unknown => {
                let reason = "whitened innovations of several rows are not kept unless asked for";
                Err(Error::Unsupported { reason })
            }
        }
    }
}
