//! Forgets each eigenvalue of the information matrix by a function of its own that holds it at α.
//!
//! ```text
//! F_k = (1 − λ_k) (I − α P_k)ᴺ R_k                        choice 1: tutorial (S2)
//! F_k = (1 − λ_k) (R_k − α I)ᴺ (R_k + β I)⁻ᴺ R_k          choice 2: tutorial (S3)
//! r̄ = r (1 − (1 − λ_k) bᴺ),  b = 1 − α/r                  the form used: each eigenvalue r of R
//!                        or  b = (r − α)/(r + β)          by itself, along its eigenvector a
//!                                                         dyad for b > 0, a row for b < 0
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | α | information | (0, ∞) | 0.01 |
//! | N | power | odd whole numbers, 1 to 99 | 1 |
//! | | choice | 1 or 2 | 1 |
//! | β | shift | [0, ∞), with choice 2 | 0 |
//!
//! - Proper (A1): if R₀ ≥ α I; R_k ≥ α I then holds for ever.
//! - P̄ bounded above without excitation (A2): always: R_k ≥ min(λ_min(R₀), α) I.
//! - P bounded below (A3): if λ_k ≤ λ_max < 1 and φ is bounded.
//! - Cost: O(n³). State: P and the eigenvectors and eigenvalues of P⁻¹; none for N = 1,
//!   choice 1, which costs what `exponential_resetting` does.
//! - N = 1 with choice 1 is `exponential_resetting` with α I, bit for bit. For N ≥ 3, what lies
//!   near α is hardly touched: the return to α is slower than any exponential, and information
//!   well below α may jump beyond it. β > 0 bounds the jump.
//! - Use it to reproduce work that used it; else `exponential_resetting`.
//! - Not where information falls far below α by itself: with N ≥ 3 it may jump beyond it.
//!
//! Reference: A. Goel, A. L. Bruce, D. S. Bernstein, *Recursive least squares with
//! variable-direction forgetting*, IEEE Control Systems Magazine 40(4), 2020, sidebar "Toward
//! matrix forgetting"; after G. Kreisselmeier, *Stabilized least-squares type adaptive
//! identifiers*, IEEE Transactions on Automatic Control 35, 1990.

use super::{ExponentialResetting, Forgetting, Forgotten, Step};
use crate::choice::guarantee::positive;
use crate::choice::{
    About, Bounds, Constants, Guarantee, Guarantees, Input, Parameter, Range, Setting, Value,
    Values,
};
use crate::covariance::spectrum::Spectrum;
use crate::rules::root::Root;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const INFORMATION: Parameter = Parameter::real(
    "information",
    0.01,
    Range::POSITIVE,
    "information that silence returns to, in every direction (units of phi^2)",
);
const POWER: Parameter = Parameter::whole(
    "power",
    1.0,
    Range::closed(1.0, 99.0, "odd whole numbers from 1 to 99"),
    "how flat forgetting is near that information; odd",
);
const CHOICE: Parameter = Parameter::whole(
    "choice",
    1.0,
    Range::closed(1.0, 2.0, "1 or 2"),
    "which of the two published functions",
);
const SHIFT: Parameter = Parameter::real(
    "shift",
    0.0,
    Range::NON_NEGATIVE,
    "bounds how far small information can jump; with choice 2 only (units of phi^2)",
);

/// The registry entry.
pub const ABOUT: About = About {
    forgetting_factor: true,
    squares: 5,
    cost: "O(n^3)",
    guarantees: Some(Guarantees {
        proper: Guarantee::when(
            "R_0 >= information * I",
            Setting::usual(Input::Exciting(1)).with(&[("information", Value::Real(1.0))]),
        ),
        bounded_above: Guarantee::ALWAYS,
        bounded_below: Guarantee::when(
            "forgetting factor <= lambda_max < 1, regressors bounded",
            Setting::usual(Input::Exciting(1)).factor(1.0),
        ),
    }),
    ..About::new(&[INFORMATION, POWER, CHOICE, SHIFT])
};

/// Forgets eigenvalue by eigenvalue; see [`self`](crate::rules::matrix_forgetting).
#[derive(Clone, Debug)]
pub struct MatrixForgetting<M: Memory> {
    information: M::Real,
    power: usize,
    /// β; none with choice 1
    shift: Option<M::Real>,
    resetting: ExponentialResetting<M>,
}

impl<M: Memory> MatrixForgetting<M> {
    /// Choice 1, (S2), with α = `information` and N = `power`.
    ///
    /// # Errors
    /// [`Error::Value`] names the parameter that is out of range.
    pub fn new(information: M::Real, power: usize, memory: M) -> Result<Self, Error> {
        let information = INFORMATION.check(information)?;
        if !(information >= M::Real::FLOOR && information <= M::Real::CEILING) {
            return Err(Error::value(INFORMATION.name, information.to_f64(), "within range"));
        }
        POWER.check(power as f64)?;
        if power.is_multiple_of(2) {
            return Err(Error::value(POWER.name, power as f64, POWER.range.words));
        }
        let root = Root::scalar(&INFORMATION, information, memory)?;
        Ok(Self { information, power, shift: None, resetting: ExponentialResetting::new(root) })
    }

    /// Choice 2, (S3), with β = `shift`.
    ///
    /// # Errors
    /// [`Error::Value`] unless `shift` is at least 0.
    pub fn with_shift(self, shift: M::Real) -> Result<Self, Error> {
        let shift = SHIFT.check(shift)?;
        if !(shift <= M::Real::CEILING) {
            return Err(Error::value(SHIFT.name, shift.to_f64(), "within range"));
        }
        Ok(Self { shift: Some(shift), ..self })
    }

    /// bᴺ for the eigenvalue r of R.
    #[inline]
    fn share(&self, r: M::Real) -> M::Real {
        let base = match self.shift {
            None => M::Real::ONE - self.information / r,
            Some(shift) => (r - self.information) / (r + shift),
        };
        (1..self.power).fold(base, |product, _| product * base)
    }

    /// Forgets along eigenvector i; P may grow by `room`.
    #[inline]
    fn forget_along(
        &self,
        spectrum: &mut Spectrum<M>,
        step: &mut Step<'_, '_, M>,
        i: usize,
        room: &mut M::Real,
    ) {
        let r = spectrum.information()[i];
        let lost = (M::Real::ONE - step.forgetting_factor) * self.share(r);
        if lost > M::Real::ZERO {
            let weight = lost / ((M::Real::ONE - lost) * r);
            spectrum.widen(i, (weight, room), step.factor, step.work.gain.as_mut());
        } else if lost < M::Real::ZERO {
            let gained = (-lost * r).min(M::Real::CEILING);
            spectrum.narrow(
                i,
                gained,
                step.factor,
                (step.work.first.as_mut(), step.work.gain.as_mut()),
            );
        }
        spectrum.set_information(i, r - lost * r);
    }
}

impl<M: Memory> Forgetting<M> for MatrixForgetting<M> {
    type State = Spectrum<M>;

    fn configure(values: &dyn Values, memory: M) -> Result<Self, Error> {
        let power: f64 = POWER.number(values)?;
        let rule = Self::new(INFORMATION.number(values)?, power as usize, memory)?;
        let (choice, shift): (f64, _) = (CHOICE.number(values)?, SHIFT.number(values)?);
        if choice > 1.0 {
            return rule.with_shift(shift);
        }
        if shift > M::Real::ZERO {
            return Err(Error::value(SHIFT.name, shift.to_f64(), "0 with choice 1"));
        }
        Ok(rule)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        let choice = if self.shift.is_some() { 2.0 } else { 1.0 };
        each(INFORMATION.name, Value::Real(self.information.to_f64()));
        each(POWER.name, Value::Real(self.power as f64));
        each(CHOICE.name, Value::Real(choice));
        each(SHIFT.name, Value::Real(self.shift.map_or(0.0, |shift| shift.to_f64())));
    }

    fn start(&self, memory: M) -> Spectrum<M> {
        Spectrum::new(memory)
    }

    fn is_bounded(&self) -> bool {
        true
    }

    fn bounds(&self, constants: &Constants) -> Bounds {
        let _ = constants;
        Bounds { below: None, above: positive(1.0 / self.information.to_f64()) }
    }

    fn follow(&self, spectrum: &mut Spectrum<M>, step: Step<'_, '_, M>) {
        if self.power == 1 && self.shift.is_none() {
            return; // resetting looks at P alone
        }
        spectrum.follow(step.factor);
        spectrum.learn_rows(step.sample.regressors());
    }

    fn change_units(&self, spectrum: &mut Spectrum<M>, _: &[M::Real]) {
        spectrum.discard();
    }

    fn restart(
        &self,
        spectrum: &mut Spectrum<M>,
        step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        spectrum.discard();
        Ok(Forgotten::rank(step.factor.parameters()))
    }

    #[inline]
    fn forget(
        &self,
        spectrum: &mut Spectrum<M>,
        mut step: Step<'_, '_, M>,
    ) -> Result<Forgotten, Error> {
        if self.power == 1 && self.shift.is_none() {
            return self.resetting.forget(&mut (), step);
        }
        let (lambda, n) = (step.forgetting_factor, step.factor.parameters());
        let forgets = lambda < M::Real::ONE;
        if forgets {
            // P̄ ≤ P/λ; from here on nothing can fail
            step.factor.reserve(M::Real::ONE / lambda, M::Real::ZERO)?;
        }
        spectrum.follow(step.factor);
        if forgets {
            let mut room = step.factor.room(lambda);
            for i in 0..n {
                self.forget_along(spectrum, &mut step, i, &mut room);
            }
        }
        spectrum.learn_rows(step.sample.regressors());
        Ok(Forgotten::rank(if forgets { n } else { 0 }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{covariance, forget, memory, Dense};

    #[test]
    fn each_eigenvalue_follows_its_function() {
        let p = Dense::new(2, &[0.25, 0.0, 0.0, 2.0]); // R = diag(4, 0.5)
        let phi = Dense::new(1, &[0.0, 1.0]);
        let memory = memory(&phi, 1);
        let rule = MatrixForgetting::new(1.0, 3, memory).unwrap();
        let found = forget(&rule, &mut rule.start(memory), &p, &phi, 0.5);
        // 4 − ½ (3/4)³ 4 and ½ + ½ (2 − 1)³ ½
        let (strong, weak): (f64, f64) = (4.0 - 27.0 / 32.0, 0.75);
        let expected = Dense::new(2, &[1.0 / strong, 0.0, 0.0, 1.0 / weak]);
        assert!(found.covariance.distance(&expected) < 1e-15);
        let rule = rule.with_shift(0.5).unwrap();
        let found = forget(&rule, &mut rule.start(memory), &p, &phi, 0.5);
        // 4 − ½ (3/4.5)³ 4 and ½ + ½ (½/1)³ ½
        let (strong, weak) = (4.0 - 2.0 * (2.0f64 / 3.0).powi(3), 0.5 + 0.25 / 8.0);
        let expected = Dense::new(2, &[1.0 / strong, 0.0, 0.0, 1.0 / weak]);
        assert!(found.covariance.distance(&expected) < 1e-15);
    }

    #[test]
    fn power_one_is_exponential_resetting_bit_for_bit() {
        let (p, phi) = (covariance(), Dense::new(1, &[0.8, -0.2, 1.1]));
        let memory = memory(&phi, 1);
        let rule = MatrixForgetting::new(0.3, 1, memory).unwrap();
        let ours = forget(&rule, &mut rule.start(memory), &p, &phi, 0.9);
        let root = Root::scalar(&INFORMATION, 0.3, memory).unwrap();
        let other = ExponentialResetting::new(root);
        let theirs = forget(&other, &mut (), &p, &phi, 0.9);
        assert_eq!(ours.covariance.elements, theirs.covariance.elements);
    }

    #[test]
    fn even_powers_and_a_shift_without_choice_2_are_refused() {
        struct Shift;
        impl Values for Shift {
            fn get(&self, name: &str) -> Option<Value<'_>> {
                (name == "shift").then_some(Value::Real(1.0))
            }
        }
        let memory = crate::memory::Dynamic::<f64>::new(2, 1, 1).unwrap();
        assert!(MatrixForgetting::new(0.3, 2, memory).is_err());
        assert!(MatrixForgetting::configure(&Shift, memory).is_err());
    }
}
