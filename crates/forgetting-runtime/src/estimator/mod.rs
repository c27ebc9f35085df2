//! An estimator of any type.

mod accessors;
mod health;
pub(crate) mod record;

pub(crate) use accessors::{covariance, extremes, units};
pub use health::Health;
pub use record::{Bounds, GoOn, Run, RunOptions};

use crate::choice::{has_function, Description};
use crate::configure::{self, check_copies};
use crate::error::Error;
use crate::missing::Missing;
use crate::number::{each, make, ByType, Family, Number};
use crate::number::{Array, NumberType, View};
use crate::settings::{uses_factor, Settings};
use crate::shape;
use crate::update::{update, Update, UpdateOptions};
use accessors::{factor, predict, theta};
use forgetting::saved::number_type;
use forgetting::{AnyEstimator, Memory, Rate, Real};

/// Estimators, with the number type left open.
pub(crate) struct Estimators;

impl Family for Estimators {
    type Of<T: Number> = AnyEstimator<T>;
}

/// Recursive least squares with generalized forgetting, of types chosen at run time.
///
/// Follows θ of y = φθ + noise, sample by sample.
#[derive(Clone)]
pub struct Estimator {
    pub(crate) typed: ByType<Estimators>,
    calls_function: bool,
}

impl Estimator {
    /// The estimator that `settings` say, in the arithmetic that is fast on this machine.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and what is allowed.
    pub fn new(settings: &Settings<'_>) -> Result<Self, Error> {
        let (covariance, theta) = (settings.initial_covariance, settings.initial_theta);
        Ok(Self::of(make!(settings.number_type, T => {
            configure::estimator::<T>(settings, covariance, theta)?
        })))
    }

    /// The estimator that [`Estimator::to_bytes`] saved, bit for bit.
    ///
    /// # Errors
    /// [`Error::Core`] says what is wrong with the bytes.
    pub fn from_bytes(state: &[u8]) -> Result<Self, Error> {
        Ok(Self::of(make!(saved_type(state)?, T => AnyEstimator::<T>::from_bytes(state)?)))
    }

    pub(crate) fn of(typed: ByType<Estimators>) -> Self {
        let calls_function = each!(&typed, e => has_function(e));
        Self { typed, calls_function }
    }

    /// The estimator, configuration and state, as bytes: portable, versioned and checked.
    ///
    /// # Errors
    /// [`Error::Core`] when a part of it is a function of the user's.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        Ok(each!(&self.typed, e => e.to_bytes())?)
    }

    /// A copy.
    ///
    /// # Errors
    /// [`Error::Core`] when there is not enough memory.
    pub fn copy(&self) -> Result<Self, Error> {
        each!(&self.typed, e => check_copies(e, 1))?;
        Ok(self.clone())
    }

    /// Whether a function of the user's is called in the middle of a sample.
    ///
    /// Such a function may do anything: an interface then passes copies of arrays that it can
    /// reach.
    #[inline]
    #[must_use]
    pub fn calls_function(&self) -> bool {
        self.calls_function
    }

    /// Back to the initial estimate and covariance, as if there had been no sample.
    pub fn reset(&mut self) {
        each!(&mut self.typed, e => e.reset());
    }

    /// Takes one sample: `phi` (p, n) and `y` (p, m) with sizes of 1 left out or not, and `gamma` ()
    /// or (p, p); 1 if not given.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; nothing has changed.
    #[inline]
    pub fn update(
        &mut self,
        phi: View<'_>,
        y: View<'_>,
        gamma: Option<View<'_>>,
    ) -> Result<Update, Error> {
        self.update_with((phi, y, gamma), UpdateOptions::default())
    }

    /// [`Estimator::update`] with all options.
    ///
    /// # Errors
    /// Those of [`Estimator::update`], and [`Error`] names `elapsed` unless it is finite and not
    /// negative.
    #[inline]
    pub fn update_with(
        &mut self,
        sample: (View<'_>, View<'_>, Option<View<'_>>),
        options: UpdateOptions,
    ) -> Result<Update, Error> {
        each!(&mut self.typed, e => update(e, sample, options))
    }

    /// Takes a whole record of T samples: `phi` (T, n) or (T, p, n), `y` (T, p, m) with sizes of
    /// 1 left out or not, `gamma` (), (p, p), (T,) or (T, p, p). `outputs` names what is kept, see
    /// [`Run`]; [`Run::DEFAULT_OUTPUTS`] if not given.
    ///
    /// Equal to one [`Estimator::update`] a sample: bit for bit up to ten parameters, to rounding
    /// above, where several samples are taken together.
    ///
    /// # Errors
    /// [`Error::Sample`] names the sample and what is wrong with it, others the argument that does
    /// not fit; the estimator is as it was before the record.
    pub fn run(
        &mut self,
        record: (View<'_>, View<'_>, Option<View<'_>>),
        missing: Missing,
        outputs: Option<&[&str]>,
    ) -> Result<Run, Error> {
        self.run_while(record, &RunOptions::new(missing, outputs), &mut || Ok(()))
    }

    /// [`Estimator::run`] with all options, asking a few times a second whether to go on.
    ///
    /// # Errors
    /// Those of [`Estimator::run`], and [`Error::Sample`] with what `go_on` answers.
    pub fn run_while(
        &mut self,
        record: (View<'_>, View<'_>, Option<View<'_>>),
        options: &RunOptions<'_>,
        go_on: GoOn<'_>,
    ) -> Result<Run, Error> {
        each!(&mut self.typed, e => record::run(e, record, options, go_on))
    }

    /// φθ of one regressor or many: (..., n) gives (...) or (..., m).
    ///
    /// # Errors
    /// [`Error::Shape`] names `phi`.
    pub fn predict(&self, phi: View<'_>) -> Result<Array, Error> {
        each!(&self.typed, e => predict(e, phi))
    }

    /// n
    #[must_use]
    pub fn parameters(&self) -> usize {
        each!(&self.typed, e => e.prior().memory().parameters())
    }

    /// p
    #[must_use]
    pub fn rows(&self) -> usize {
        each!(&self.typed, e => e.prior().memory().rows())
    }

    /// m
    #[must_use]
    pub fn targets(&self) -> usize {
        each!(&self.typed, e => e.prior().memory().targets())
    }

    /// The type of its numbers.
    #[inline]
    #[must_use]
    pub fn number_type(&self) -> NumberType {
        self.typed.number_type()
    }

    /// Samples used since the start; skipped ones do not count.
    #[must_use]
    pub fn samples(&self) -> u64 {
        each!(&self.typed, e => e.samples())
    }

    /// θ, (n,) or (n, m).
    #[must_use]
    pub fn theta(&self) -> Array {
        each!(&self.typed, e => theta(e))
    }

    /// Goes on from this θ, (n,) or (n, m); P stays as it is.
    ///
    /// # Errors
    /// [`Error`] names `theta`; nothing has changed.
    pub fn set_theta(&mut self, theta: View<'_>) -> Result<(), Error> {
        each!(&mut self.typed, e => {
            let (n, m) = (e.prior().memory().parameters(), e.prior().memory().targets());
            shape::check("theta", theta.shape(), &[], &[n, m])?;
            let by_parameter = Number::read(theta.numbers());
            // one target after the other
            let place = |k: usize| by_parameter[k % n * m + k / n];
            Ok(e.set_theta(&(0..n * m).map(place).collect::<Vec<_>>())?)
        })
    }

    /// λ, where it is constant; none where a rate chooses it, or the rule uses none.
    #[must_use]
    pub fn forgetting_factor(&self) -> Option<f64> {
        let used = uses_factor(&self.describe().rule.name);
        let factor = each!(&self.typed, e => e.rate().constant().map(Real::to_f64));
        factor.filter(|_| used)
    }

    /// Forgets by this constant factor from now on, λ in (0, 1].
    ///
    /// # Errors
    /// [`Error`] names the factor, a rule that uses none, or a rate that chooses it; nothing has
    /// changed.
    pub fn set_forgetting_factor(&mut self, factor: f64) -> Result<(), Error> {
        let rule = self.describe().rule.name;
        if !uses_factor(&rule) {
            let reason = format!("forgetting_factor is set, but the rule {rule} uses none");
            return Err(Error::unsupported(reason));
        }
        Ok(each!(&mut self.typed, e => e.set_forgetting_factor(Real::from_f64(factor)))?)
    }

    /// P, (n, n), in units of 1/φ²: times the noise variance, it is the covariance of θ.
    ///
    /// # Errors
    /// [`Error::Core`] when there is not enough memory.
    pub fn covariance(&self) -> Result<Array, Error> {
        each!(&self.typed, e => covariance(e))
    }

    /// The units s (n,) in which regressors are measured where P₀ follows the data: 1 for a regressor
    /// that has always been 0. Nothing where P₀ was given.
    #[must_use]
    pub fn units(&self) -> Option<Array> {
        each!(&self.typed, e => e.reciprocal_units().map(units))
    }

    /// U (n, n), unit upper triangular, and the diagonal of D (n,), positive, with P = U D Uᵀ.
    ///
    /// # Errors
    /// [`Error::Core`] when there is not enough memory.
    pub fn factor(&self) -> Result<(Array, Array), Error> {
        each!(&self.typed, e => factor(e))
    }

    /// The largest and the smallest element of D, in O(n).
    #[must_use]
    pub fn extremes(&self) -> (f64, f64) {
        each!(&self.typed, e => extremes(e))
    }

    /// What the monitor has found, if there is one.
    #[must_use]
    pub fn health(&self) -> Option<Health> {
        each!(&self.typed, e => Health::of(e))
    }

    /// The rule, rate, weighting and gate by name, each with its parameters.
    #[must_use]
    pub fn describe(&self) -> Description {
        each!(&self.typed, e => Description::of(e))
    }
}

/// The number type of a saved state.
pub(crate) fn saved_type(state: &[u8]) -> Result<NumberType, Error> {
    match number_type(state)? {
        8 => Ok(NumberType::F64),
        _ => Ok(NumberType::F32),
    }
}
