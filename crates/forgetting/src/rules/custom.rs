//! Forgets what a function of the user's says: Theorem 1 itself.
//!
//! ```text
//! F_k = forgetting_matrix(R_k, φ̄_k, ē_k)    R = P⁻¹ n x n, φ̄ p x n and ē p x m, whitened
//! R̄ = R − F_k                               GF-RLS (9), (12); refused unless R̄ > 0
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | F_k | forgetting_matrix | a function; its result symmetric, n x n, with R − F > 0 | |
//!
//! - Proper (A1): if the function returns F ≥ 0.
//! - P̄ bounded above without excitation (A2): if R − F ≥ c I, c > 0.
//! - P bounded below (A3): if R − F is bounded, and φ.
//! - Cost: O(n³) and the function. State: P alone; with a function of the user's it cannot be
//!   saved as bytes.
//! - Use it to try a rule of your own before writing it as one. A sample for which the function
//!   fails, or R − F is not positive definite beyond the rounding of R, is refused and changes
//!   nothing.
//!
//! Reference: B. Lai, D. S. Bernstein, *Generalized forgetting recursive least squares:
//! stability and robustness guarantees*, IEEE Transactions on Automatic Control, 2024,
//! Theorem 1.

mod function;

#[cfg(feature = "alloc")]
pub use function::SharedFunction;
pub use function::{ForgettingMatrix, Named};

use super::{Forgetting, Forgotten, Step};
use crate::choice::{About, Guarantee, Guarantees, Kind, Parameter, Range, Value, Values};
use crate::covariance::dense::check_symmetric;
use crate::error::Error;
use crate::memory::state::{State, Visitor};
use crate::memory::Memory;
use core::marker::PhantomData;
use forgetting_kernels::Real;

const FORGETTING_MATRIX: Parameter = Parameter::elements(
    "forgetting_matrix",
    Kind::Function,
    0.0,
    Range::FINITE,
    "function of R (n x n), the whitened phi (rows x n) and error (rows x targets) that returns F",
)
.required();

/// The registry entry.
pub const ABOUT: About = About {
    squares: 2,
    cost: "O(n^3) and the function",
    guarantees: Some(Guarantees {
        proper: Guarantee::of_function("forgetting_matrix >= 0"),
        bounded_above: Guarantee::of_function("R - forgetting_matrix >= c * I, c > 0"),
        bounded_below: Guarantee::of_function("R - forgetting_matrix bounded, regressors bounded"),
    }),
    ..About::new(&[FORGETTING_MATRIX])
};

/// Forgets what a function says; see [`self`](crate::rules::custom).
#[derive(Clone)]
pub struct Custom<M: Memory, C = Named<<M as Memory>::Real>> {
    function: C,
    memory: PhantomData<M>,
}

/// R, then R − F, and F; of use within one sample only.
#[derive(Clone, Debug)]
pub struct Buffers<M: Memory> {
    information: M::Square,
    matrix: M::Square,
}

impl<M: Memory, C: ForgettingMatrix<M::Real>> Custom<M, C> {
    /// With this function of R, φ̄ and ē.
    ///
    /// ```
    /// use forgetting::rules::Custom;
    /// use forgetting::{Constant, Equal, Error, Estimator, Fixed, Prior};
    ///
    /// let leak = |r: &[f64], _: &[f64], _: &[f64], f: &mut [f64]| {
    ///     f.iter_mut().zip(r).for_each(|(f, r)| *f = 0.02 * r);
    ///     Ok(())
    /// };
    /// let prior = Prior::scalar(Fixed::<f64, 2>::new(), 100.0)?;
    /// let rate = Constant::new(1.0)?;
    /// let mut estimator = Estimator::new(Custom::new(leak), rate, Equal::new(), prior);
    /// estimator.update(&[1.0, 2.0], &[5.0])?;
    /// # Ok::<(), Error>(())
    /// ```
    pub fn new(function: C) -> Self {
        Self { function, memory: PhantomData }
    }
}

impl<M: Memory, C> core::fmt::Debug for Custom<M, C> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Custom").finish_non_exhaustive()
    }
}

impl<M: Memory, C: ForgettingMatrix<M::Real>> Forgetting<M> for Custom<M, C> {
    type State = Buffers<M>;

    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        C::from_values(values).map(Self::new)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        if let Some(value) = self.function.value() {
            each(FORGETTING_MATRIX.name, value);
        }
    }

    fn start(&self, memory: M) -> Buffers<M> {
        Buffers { information: memory.square(), matrix: memory.square() }
    }

    fn restart(&self, _: &mut Buffers<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        Ok(Forgotten::rank(step.factor.parameters()))
    }

    fn forget(&self, state: &mut Buffers<M>, step: Step<'_, '_, M>) -> Result<Forgotten, Error> {
        let n = step.factor.parameters();
        let (information, matrix) = (state.information.as_mut(), state.matrix.as_mut());
        step.factor.reconstruct_information(information, matrix);
        matrix.fill(M::Real::ZERO);
        let sample = &step.sample;
        self.function.forgetting_matrix(
            information,
            sample.regressors(),
            sample.errors(),
            matrix,
        )?;
        check_symmetric(FORGETTING_MATRIX.name, matrix, n)?;
        if matrix.iter().all(|f| *f == M::Real::ZERO) {
            return Ok(Forgotten::rank(0));
        }
        // what is left must exceed the rounding of what it is left of
        let rounding = M::Real::EPSILON * M::Real::from_f64(4.0 * n as f64);
        let least = step.work.gain.as_mut();
        let half = M::Real::from_f64(0.5);
        for i in 0..n {
            least[i] = rounding * information[i * n + i];
            for j in 0..=i {
                information[i * n + j] -= half * (matrix[i * n + j] + matrix[j * n + i]);
            }
        }
        const NAME: &str = "information - forgetting_matrix";
        step.factor.replace_information(information, |i| least[i], NAME)?;
        Ok(Forgotten::rank(n))
    }
}

impl<M: Memory> State<M::Real> for Buffers<M> {
    fn visit(&mut self, _: &mut dyn Visitor<M::Real>) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Dynamic;
    use crate::rates::Constant;
    use crate::testing::{covariance, forget, memory, two_rows};
    use crate::weightings::Equal;

    type Function = fn(&[f64], &[f64], &[f64], &mut [f64]) -> Result<(), Error>;

    #[test]
    fn takes_away_what_the_function_says() {
        let (p, phi) = (covariance(), two_rows());
        let (r, seen) = (p.inverse(), phi.elements.clone());
        let rule = Custom::new(move |given: &[f64], phi: &[f64], error: &[f64], f: &mut [f64]| {
            assert!(given.iter().zip(&r.elements).all(|(x, y)| (x - y).abs() < 1e-13));
            assert_eq!((phi, error), (&seen[..], &[2.0, 2.0][..]));
            f.iter_mut().zip(given).for_each(|(f, r)| *f = 0.25 * r);
            Ok(())
        });
        let memory = memory(&phi, 1);
        let mut state = rule.start(memory);
        let found = forget(&rule, &mut state, &p, &phi, 1.0);
        assert!(found.covariance.distance(&((4.0 / 3.0) * p)) < 1e-14);
    }

    #[test]
    fn what_is_not_admissible_is_refused_and_changes_no_bit() {
        let all: Function = |r, _, _, f| {
            f.copy_from_slice(r);
            Ok(())
        };
        let lopsided: Function = |_, _, _, f| {
            f[1] = 1e-3;
            Ok(())
        };
        let not_a_number: Function = |_, _, _, f| {
            f[3] = f64::NAN;
            Ok(())
        };
        let failing: Function = |_, _, _, _| Err(Error::Function { parameter: "f" });
        let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
        for function in [all, lopsided, not_a_number, failing] {
            let prior = Prior::scalar(memory, 3.0).unwrap();
            let rate = Constant::new(1.0).unwrap();
            let mut estimator = Estimator::new(Custom::new(function), rate, Equal::new(), prior);
            match estimator.update(&[1.0, 2.0], &[1.0]).unwrap_err() {
                Error::Indefinite { .. } | Error::Value { .. } => {}
                other => assert_eq!(other, Error::Function { parameter: "f" }),
            }
            assert_eq!((estimator.theta(), estimator.samples()), (&[0.0, 0.0][..], 0));
            assert_eq!(estimator.factor().diagonal_elements(), [3.0, 3.0]);
        }
    }

    #[test]
    fn zero_forgets_nothing_to_the_bit() {
        let (p, phi) = (covariance(), two_rows());
        let nothing: Function = |_, _, _, _| Ok(());
        let rule = Custom::<Dynamic<f64>, _>::new(nothing);
        let found = forget(&rule, &mut rule.start(memory(&phi, 1)), &p, &phi, 1.0);
        let none = crate::rules::NoForgetting::new();
        let other = forget(&none, &mut (), &p, &phi, 1.0);
        assert_eq!(found.covariance.elements, other.covariance.elements);
    }
}
