//! Estimators of one rule and one size, in as few numbers as there are.

use super::{Float, Model};
use crate::code::{Code, Why};
use crate::number::Number;
use crate::report::{Health, Report};
use crate::settings::Settings;
use forgetting::choice::{About, Values};
use forgetting::compact::{Given, Pace, Saved};
use forgetting::{Compact, Error, Fixed, Forgetting, Packed, Size};

/// A rule with its name.
pub trait Named: 'static {
    /// The rule.
    type Rule<T: Float, const N: usize>: Forgetting<Fixed<T, N>>
    where
        Size<N>: Packed<T>;
    /// Its name in the registry.
    const NAME: &'static str;
    /// What its file says of it.
    const ABOUT: About;
}

macro_rules! named {
    ($($Name:ident: $module:ident, $($Type:ident)::+;)*) => {$(
        #[doc = concat!("The rule `", stringify!($module), "`.")]
        pub struct $Name;

        impl Named for $Name {
            type Rule<T: Float, const N: usize>
                = forgetting::$($Type)::+<Fixed<T, N>>
            where
                Size<N>: Packed<T>;
            const NAME: &'static str = stringify!($module);
            const ABOUT: About = forgetting::rules::$module::ABOUT;
        }
    )*};
}
named! {
    NoForgetting: none, rules::NoForgetting;
    Exponential: exponential, rules::Exponential;
    Subspace: subspace, rules::Subspace;
    Directional: directional, rules::Directional;
    RandomWalk: random_walk, compact::Walk;
}

/// A compact estimator of the rule `R`.
pub struct Of<R: Named, T: Float, const N: usize>(Compact<R::Rule<T, N>, T, N>)
where
    Size<N>: Packed<T>;

impl<R: Named, T: Float, const N: usize> Model for Of<R, T, N>
where
    Size<N>: Packed<T>,
{
    type Real = T;
    const NUMBER: Number = T::NUMBER;
    const PARAMETERS: (usize, usize) = (N, N);

    fn make(settings: &Settings) -> Result<Self, Why> {
        settings.check_compact()?;
        let given = settings.rule;
        if given.name().is_some_and(|name| name != R::NAME) {
            return Err(Code::Unknown.into());
        }
        given.check(Some(const { &R::ABOUT }))?;
        let lambda = settings.forgetting_factor(R::ABOUT.forgetting_factor)?;
        let variance = settings.initial_covariance;
        if variance == 0.0 {
            return Err(Error::Missing { parameter: "initial_covariance" }.into());
        }
        let theta = settings.theta_of::<T, N>();
        let made =
            Compact::new(&given.values(), T::from_f64(lambda), T::from_f64(variance), &theta)?;
        Ok(Self(made))
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

    fn update(&mut self, phi: &[T], y: T, given: Option<&Given<T>>) -> Result<Report<T>, Why> {
        let phi = phi.first_chunk::<N>().ok_or(Code::Length)?;
        let outcome = self.0.take(phi, y, given)?;
        Ok(Report {
            error: outcome.error,
            leverage: outcome.leverage,
            forgetting_factor: self.0.forgetting_factor(),
            weight: T::ONE,
            used: u8::from(outcome.used),
            windup: u8::from(outcome.windup),
            gate: 0,
            reserved: 0,
        })
    }

    fn predict(&self, phi: &[T]) -> T {
        phi.first_chunk::<N>().map_or(T::ZERO, |phi| self.0.predict(phi))
    }

    fn theta(&self) -> &[T] {
        self.0.theta()
    }

    fn set_theta(&mut self, theta: &[T]) -> Result<(), Why> {
        let theta = theta.first_chunk::<N>().ok_or(Code::Length)?;
        Ok(self.0.set_theta(theta)?)
    }

    fn covariance(&mut self, covariance: &mut [T]) {
        let (rows, _) = covariance.as_chunks_mut::<N>();
        if let Some(dense) = rows.first_chunk_mut::<N>() {
            self.0.covariance(dense);
        }
    }
}

impl<R: Named, T: Float, const N: usize> super::Compact for Of<R, T, N>
where
    Size<N>: Packed<T>,
{
    const RULE: &'static str = R::NAME;

    fn of_values(values: &dyn Values, lambda: T) -> Result<Self, Error> {
        Compact::new(values, lambda, T::ONE, &[T::ZERO; N]).map(Self)
    }

    fn saved(&mut self) -> &mut dyn Saved<T> {
        &mut self.0
    }

    fn pace(&self) -> Pace<T> {
        self.0.pace()
    }
}
