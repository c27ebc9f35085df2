//! The default bank of one size.

use super::{Float, Model, Saves};
use crate::code::{Code, Why};
use crate::number::Number;
use crate::report::{Health, Report};
use crate::settings::Settings;
use forgetting::bank::BankUpdate;
use forgetting::compact::{self, Given};
use forgetting::{Error, Packed, Size};

/// Random walks of eight speeds, mixed by `mlpol`.
pub struct Bank<T: Float, const N: usize>(compact::Bank<T, N>)
where
    Size<N>: Packed<T>;

/// Refuses what the members of the default bank do not have.
fn check(settings: &Settings) -> Result<(), Why> {
    settings.check_compact()?;
    if settings.rule.name().is_some() || settings.forgetting_factor != 0.0 {
        let reason =
            "the members of this bank are given: it takes no rule and no forgetting factor";
        return Err(Error::Unsupported { reason }.into());
    }
    Ok(())
}

impl<T: Float, const N: usize> Model for Bank<T, N>
where
    Size<N>: Packed<T>,
{
    type Real = T;
    const NUMBER: Number = T::NUMBER;
    const PARAMETERS: (usize, usize) = (N, N);

    fn make(settings: &Settings) -> Result<Self, Why> {
        check(settings)?;
        let variance = match settings.initial_covariance {
            0.0 => None,
            given => Some(T::from_f64(given)),
        };
        let theta = settings.theta_of::<T, N>();
        Ok(Self(compact::Bank::of_walks(variance, &theta)?))
    }

    fn parameters(&self) -> usize {
        N
    }

    fn reset(&mut self) {
        self.0.reset();
    }

    fn samples(&self) -> u64 {
        self.0.samples()
    }

    fn health(&self) -> Option<Health> {
        None
    }

    fn update(&mut self, phi: &[T], y: T, _: Option<&Given<T>>) -> Result<Report<T>, Why> {
        let phi = phi.first_chunk::<N>().ok_or(Code::Length)?;
        Ok(self.0.update(phi, y)?.into())
    }

    fn predict(&self, phi: &[T]) -> T {
        let mut prediction = [T::ZERO];
        // the lengths fit
        let _ = self.0.predict(phi, &mut prediction);
        prediction[0]
    }

    fn theta(&self) -> &[T] {
        self.0.theta()
    }

    fn set_theta(&mut self, _: &[T]) -> Result<(), Why> {
        let reason = "the members of a bank have a theta each: that of their mixture cannot be set";
        Err(Error::Unsupported { reason }.into())
    }

    fn covariance(&mut self, covariance: &mut [T]) {
        self.0.covariance(covariance);
    }

    fn weights(&self) -> &[T] {
        self.0.weights()
    }
}

impl<T: Float, const N: usize> Saves for Bank<T, N>
where
    Size<N>: Packed<T>,
{
    fn update_after(
        &mut self,
        elapsed: T,
        phi: &[T],
        y: T,
        gamma: Option<T>,
    ) -> Result<Report<T>, Why> {
        let phi = phi.first_chunk::<N>().ok_or(Code::Length)?;
        Ok(self.0.update_after(elapsed, phi, y, gamma)?.into())
    }

    fn load(bytes: &[u8]) -> Result<Self, Why> {
        Ok(Self(compact::Bank::from_bytes(bytes)?))
    }

    fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<(), Why> {
        self.0.save(put)?;
        Ok(())
    }
}

impl<T: Float> From<BankUpdate<'_, T>> for Report<T> {
    fn from(update: BankUpdate<'_, T>) -> Self {
        Self {
            error: update.error.first().copied().unwrap_or(T::ZERO),
            leverage: update.leverage,
            forgetting_factor: update.forgetting_factor,
            weight: T::ONE,
            used: u8::from(update.skipped.is_none()),
            windup: u8::from(update.windup),
            gate: update.gate.code(),
            reserved: 0,
        }
    }
}
