//! An estimator in as few numbers as there are, for machines with little memory.
//!
//! One row, one target, a forgetting factor λ that is the same for every sample, P₀ = c·I, and a rule
//! that has a [form](crate::Forgetting::form): it takes samples one by one, as
//! [`Estimator`](crate::Estimator) does and with the same bits. It keeps θ₀, c, λ, θ, D, what is above
//! the diagonal of U, a bound of P's trace and a count: (n² + 5n)/2 + 3 numbers and eight bytes, beside
//! the parameters of the rule. There is no monitor, no gate and no weighting.

mod after;
mod bank;
mod member;
mod saved;
mod walk;

pub use after::{Given, Pace};
pub use bank::{Bank, Walks, MEMBERS};
pub use saved::{load, save, Saved};
pub use walk::Walk;

use crate::choice::Values;
use crate::covariance::allowed_variances;
use crate::error::Error;
use crate::memory::{Fixed, Packed, Size};
use crate::rates::{Constant, Rate};
use crate::rules::Forgetting;
use crate::sample::{blame, check_theta, out_of_range};
use forgetting_kernels::kernel::compact::Compact as Kernel;
use forgetting_kernels::kernel::form::Form;
use forgetting_kernels::kernel::layout::FEW;
use forgetting_kernels::kernel::outcome::Outcome;
use forgetting_kernels::kernel::vectors::few_products;
use forgetting_kernels::Kernels;

/// See the [module](self).
///
/// ```
/// use forgetting::choice::Defaults;
/// use forgetting::{Compact, Subspace};
///
/// let mut estimator = Compact::<Subspace<_>, f32, 2>::new(&Defaults, 0.98, 100.0, &[0.0; 2])?;
/// for k in 0..100 {
///     let phi = [1.0, (k % 7) as f32];
///     assert!(estimator.update(&phi, 3.0 + 0.5 * phi[1])?.used);
/// }
/// assert!((estimator.theta()[1] - 0.5).abs() < 1e-3);
/// # Ok::<(), forgetting::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Compact<F, T, const N: usize>
where
    Size<N>: Packed<T>,
{
    rule: F,
    forgetting_factor: T,
    initial_covariance: T,
    initial_theta: [T; N],
    triangle: <Size<N> as Packed<T>>::Compact,
    diagonal: [T; N],
    bound: T,
    theta: [T; N],
    samples: u64,
}

impl<F, T, const N: usize> Compact<F, T, N>
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    /// Growth of the largest element of D over its first value that counts as windup.
    pub const WINDUP: f64 = 10.0;

    /// With these parameters of the rule, λ in (0, 1], P₀ = `initial_covariance`·I and θ₀.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and what is allowed; [`Error::Unsupported`] for a rule
    /// that has no form with these parameters.
    pub fn new(
        rule: &dyn Values,
        forgetting_factor: T,
        initial_covariance: T,
        initial_theta: &[T; N],
    ) -> Result<Self, Error> {
        let rate = Constant::<Fixed<T, N>>::new(forgetting_factor)?;
        let rule = F::configure(rule, Fixed::new())?;
        Self::of(rule, rate, initial_covariance, *initial_theta)
    }

    fn of(
        rule: F,
        rate: Constant<Fixed<T, N>>,
        initial_covariance: T,
        initial_theta: [T; N],
    ) -> Result<Self, Error> {
        if !(initial_covariance >= T::FLOOR && initial_covariance <= T::CEILING) {
            let value = initial_covariance.to_f64();
            return Err(Error::value("initial_covariance", value, allowed_variances::<T>()));
        }
        if let Some(index) = initial_theta.iter().position(|x| !(x.abs() <= T::CEILING)) {
            let value = initial_theta.get(index).map_or(f64::NAN, |x| x.to_f64());
            return Err(Error::value("initial_theta", value, "finite numbers").at(index));
        }
        let mut estimator = Self {
            rule,
            forgetting_factor: rate.constant().unwrap_or(T::ONE),
            initial_covariance,
            initial_theta,
            triangle: Size::<N>::compact(),
            diagonal: [T::ZERO; N],
            bound: T::ZERO,
            theta: initial_theta,
            samples: 0,
        };
        estimator.form(estimator.forgetting_factor, T::ONE)?;
        estimator.reset();
        Ok(estimator)
    }

    /// How a sample changes P with this λ, so many steps of a walk after the last one.
    #[inline(always)]
    fn form(&self, lambda: T, steps: T) -> Result<Form<T>, Error> {
        let form = if N <= FEW { self.rule.form(lambda.max(T::EPSILON), steps) } else { None };
        form.ok_or(Error::Unsupported {
            reason: "this rule with these parameters is not one for compact estimators",
        })
    }

    #[inline(always)]
    fn kernel(&mut self) -> Kernel<'_, T, N> {
        let Self { triangle, diagonal, bound, theta, .. } = self;
        Kernel { triangle: triangle.as_mut(), diagonal, bound, theta }
    }

    /// What time does to it.
    pub fn pace(&self) -> Pace<T> {
        let share = match self.form(self.forgetting_factor, T::ONE) {
            // the square of the root that the rule keeps, rounded as there
            Ok(Form::Walk { noise, per_bound }) => noise.sqrt() * noise.sqrt() * per_bound,
            _ => T::ZERO,
        };
        Pace { factor: self.forgetting_factor, share }
    }

    /// Back to the prior, as if no sample had been seen.
    pub fn reset(&mut self) {
        self.triangle = Size::<N>::compact();
        self.diagonal = [self.initial_covariance; N];
        self.theta = self.initial_theta;
        self.samples = 0;
        self.bound = self.kernel().trace();
    }

    /// Takes the sample of n numbers `phi` and the number `y`.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; the estimator is as it was, bit for bit.
    #[inline(always)]
    pub fn update(&mut self, phi: &[T; N], y: T) -> Result<Outcome<T>, Error> {
        self.take(phi, y, None)
    }

    /// The same of a sample as it is, or of one of which this is `given`: `phi` is then whitened, and so
    /// is the error of the outcome.
    ///
    /// # Errors
    /// Those of [`Compact::update`].
    #[inline(always)]
    pub fn take(
        &mut self,
        phi: &[T; N],
        y: T,
        given: Option<&Given<T>>,
    ) -> Result<Outcome<T>, Error> {
        let (lambda, steps) =
            given.map_or((self.forgetting_factor, T::ONE), |given| (given.factor, given.steps));
        let form = self.form(lambda, steps)?;
        let error = given.map(|given| given.error);
        let taken = self.kernel().take(form, (phi, y), error);
        let mut outcome = taken.ok_or_else(|| self.refuse((phi, y), error))?;
        if outcome.used {
            self.samples = self.samples.saturating_add(1);
        }
        outcome.windup = outcome.largest > T::from_f64(Self::WINDUP) * self.initial_covariance;
        Ok(outcome)
    }

    /// What was wrong with a sample.
    #[cold]
    fn refuse(&self, (phi, y): (&[T; N], T), whitened: Option<T>) -> Error {
        let largest = whitened.unwrap_or(y - self.predict(phi)).abs();
        if largest <= T::CEILING {
            out_of_range("phi (its squared length)", few_products::<T, T, N>(phi, phi).0)
        } else {
            blame(phi, &[y], largest)
        }
    }

    /// Goes on from θ = `theta`. P stays as it is.
    ///
    /// # Errors
    /// [`Error`] names `theta` unless its numbers are within the range; nothing has changed.
    pub fn set_theta(&mut self, theta: &[T; N]) -> Result<(), Error> {
        check_theta(theta)?;
        self.theta = *theta;
        Ok(())
    }

    /// φθ
    #[inline]
    pub fn predict(&self, phi: &[T; N]) -> T {
        few_products::<T, T, N>(phi, &self.theta).0
    }

    /// θ
    pub fn theta(&self) -> &[T; N] {
        &self.theta
    }

    /// λ
    pub fn forgetting_factor(&self) -> T {
        self.forgetting_factor
    }

    /// Samples used since the start; skipped ones do not count.
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// P, written to `dense`, row by row.
    pub fn covariance(&mut self, dense: &mut [[T; N]; N]) {
        let diagonal = self.diagonal;
        let kernel = self.kernel();
        for (i, row) in dense.iter_mut().enumerate() {
            for (j, element) in row.iter_mut().enumerate() {
                // in the same order for (i, j) and (j, i)
                let (low, high) = (i.min(j), i.max(j));
                let columns = diagonal.iter().enumerate().skip(high);
                *element = columns.fold(T::ZERO, |sum, (k, &d)| {
                    sum + kernel.unit(low, k) * d * kernel.unit(high, k)
                });
            }
        }
    }
}
