//! Lets a sample through if it can tell enough beside what is known already.
//!
//! ```text
//! s_k = tr φ̄_k P_k φ̄_kᵀ,  P before forgetting
//! update if s_k ≥ information, else what `otherwise` says
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | s | information | (0, ∞) | 1e-6 |
//! | | otherwise | hold, freeze | hold |
//!
//! s is the variance of the prediction in units of the noise's; the sample tells ½ ln(1 + s) nats
//! of θ, for one row. It has no unit, and does not depend on the units of φ or θ.
//!
//! - While every regressor is small, P stays as it is: silence cannot wind up, with any rule. Where
//!   other directions go on telling, the gate is open and those that are silent are the rule's
//!   affair: only a rule that forgets direction by direction keeps them.
//! - `information` must be well below what a sample tells in the steady state, which for n
//!   parameters that are all excited is about n (1 − λ), shared unevenly among the samples. Above
//!   that P shrinks until no sample passes, and the gate never opens again.
//! - Freeze lets such samples reduce P, hold does not.
//! - Cost: O(p n²/2). State: none.
//! - Use it with a rule that forgets in silence, such as `exponential`, for records with nights
//!   and standstills.
//! - Not against silence in some directions while others go on telling: that takes a rule that
//!   forgets by directions.

use super::otherwise::{self, OTHERWISE};
use super::{Answer, Gate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::sample::{Evidence, Needs};
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const INFORMATION: Parameter = Parameter::real(
    "information",
    1e-6,
    Range::POSITIVE,
    "least variance of the prediction, in units of the noise's, that lets a sample through",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[INFORMATION, OTHERWISE]);

/// Open for what informs; see [`self`](crate::gates::minimum_information).
#[derive(Clone, Copy, Debug)]
pub struct MinimumInformation<M: Memory> {
    information: M::Real,
    otherwise: Answer,
}

impl<M: Memory> MinimumInformation<M> {
    /// With the least s, and what is done with a sample below it.
    ///
    /// # Errors
    /// [`Error::Value`] unless `information` is positive.
    pub fn new(information: M::Real, otherwise: Answer) -> Result<Self, Error> {
        Ok(Self { information: INFORMATION.check(information)?, otherwise })
    }
}

impl<M: Memory> Gate<M> for MinimumInformation<M> {
    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(INFORMATION.number(values)?, otherwise::read(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(INFORMATION.name, Value::Real(self.information.to_f64()));
        otherwise::describe(self.otherwise, each);
    }

    fn needs(&self) -> Needs {
        Needs::Leverage
    }

    #[inline]
    fn answer(&self, evidence: &Evidence<'_, '_, M>) -> Result<Answer, Error> {
        let passes = evidence.leverage >= self.information;
        Ok(if passes { Answer::Update } else { self.otherwise })
    }
}

#[cfg(test)]
mod tests {
    use super::MinimumInformation;
    use crate::gates::{Answer, AnyGate};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Fixed;
    use crate::rates::Constant;
    use crate::rules::Exponential;
    use crate::sample::Skip;
    use crate::weightings::Equal;

    fn estimator(
        information: f64,
        otherwise: Answer,
    ) -> Estimator<Exponential<M>, Constant<M>, Equal<M>, M> {
        let (rate, prior) = (Constant::new(0.5).unwrap(), Prior::scalar(M::new(), 3.0).unwrap());
        let gate = MinimumInformation::new(information, otherwise).unwrap();
        Estimator::new(Exponential::new(), rate, Equal::new(), prior)
            .with_gate(AnyGate::MinimumInformation(gate))
    }

    type M = Fixed<f64, 1>;

    /// φPφ = 3 passes 3, and not 3.1.
    #[test]
    fn the_threshold_is_on_the_variance_of_the_prediction() {
        let mut open = estimator(3.0, Answer::Hold);
        let update = open.update(&[1.0], &[2.0]).unwrap();
        assert_eq!((update.gate, update.skipped, update.leverage), (Answer::Update, None, 6.0));
        let mut shut = estimator(3.1, Answer::Hold);
        let update = shut.update(&[1.0], &[2.0]).unwrap();
        assert_eq!((update.gate, update.skipped), (Answer::Hold, Some(Skip::Gate)));
        assert_eq!((update.leverage, update.forgetting_factor, update.rank), (3.0, 1.0, 0));
        assert_eq!((shut.theta()[0], shut.samples()), (0.0, 0));
    }

    /// P₊ = 1/(1/3 + 1), θ₊ = P₊ 2: nothing forgotten.
    #[test]
    fn freezing_is_least_squares_without_forgetting() {
        let mut frozen = estimator(3.1, Answer::Freeze);
        let update = frozen.update(&[1.0], &[2.0]).unwrap();
        assert_eq!((update.gate, update.skipped), (Answer::Freeze, None));
        assert_eq!((update.leverage, update.forgetting_factor, update.rank), (3.0, 1.0, 0));
        assert_eq!(frozen.theta()[0], 1.5);
        assert_eq!(frozen.factor().diagonal_elements(), [0.75]);
    }

    /// As the header warns: with φ = 1 the steady state is P₊ = 1 − λ, φP₊φ = 1 − λ.
    #[test]
    fn above_what_the_steady_state_tells_it_never_opens_again() {
        for (information, stays_open) in [(0.45, true), (0.55, false)] {
            let mut estimator = estimator(information, Answer::Hold);
            let mut passed = |_| estimator.update(&[1.0], &[1.0]).unwrap().gate == Answer::Update;
            let last_passes = (0..100).map(&mut passed).skip(50).all(|passes| passes);
            assert_eq!(last_passes, stays_open, "{information}");
        }
    }
}
