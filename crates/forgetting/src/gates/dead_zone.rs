//! Lets a sample through if its error is larger than the noise explains.
//!
//! ```text
//! r_k = ‖ē_k‖ over the rows, of the target where it is longest     ē = Γ^(−1/2)(y − φθ)
//! update if r_k > width, else what `otherwise` says
//! ```
//!
//! | symbol | name | range | default |
//! |---|---|---|---|
//! | r | width | (0, ∞) | 1 |
//! | | otherwise | hold, freeze | hold |
//!
//! The error is whitened by Γ: `width` is in standard deviations of the noise where Γ is its
//! covariance, and in units of y where P₀ is given and Γ is not, which is then 1. It is the error
//! itself, not divided by √(1 + φ̄Pφ̄ᵀ) and not weighted.
//!
//! - While the model explains the data to within `width`, nothing is forgotten: with hold θ and P
//!   stay as they are, with freeze P still shrinks as the data say. Neither can wind up.
//! - With bounded noise, ‖ē‖ ≤ width for the true θ, held samples are those that do not contradict
//!   θ. Gaussian noise of variance 1 is within a width of 2 for 95 % of the samples: to hold those
//!   is to learn from the tails only, and slowly.
//! - An error that is small by chance holds a sample that would have told much, so that hold
//!   learns later than it could. Freeze does not.
//! - Where neither Γ nor P₀ is given, Γ here is the variance of the noise, estimated from the errors;
//!   until five after 2n samples have told it, every sample passes.
//! - Cost: O(p m). State: none.
//! - Use it against drift in quiet times, and where the parameters change seldom: `freeze` then
//!   averages on, and forgets when the model no longer fits.
//! - Not with hold where every sample is needed: in Gaussian noise most of them are held.
//!
//! Reference: B. Egardt, *Stability of Adaptive Controllers*, 1979; G. C. Goodwin, K. S. Sin,
//! *Adaptive Filtering, Prediction and Control*, 1984.

use super::otherwise::{self, OTHERWISE};
use super::{Answer, Gate};
use crate::choice::{About, Parameter, Range, Value, Values};
use crate::sample::Evidence;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::Real;

const WIDTH: Parameter = Parameter::real(
    "width",
    1.0,
    Range::POSITIVE,
    "longest whitened error that is left to the noise (units of y over those of sqrt(gamma))",
);

/// The registry entry.
pub const ABOUT: About = About::new(&[WIDTH, OTHERWISE]);

/// Open for large errors; see [`self`](crate::gates::dead_zone).
#[derive(Clone, Copy, Debug)]
pub struct DeadZone<M: Memory> {
    width: M::Real,
    otherwise: Answer,
}

impl<M: Memory> DeadZone<M> {
    /// With the longest whitened error that does not pass, and what is done then.
    ///
    /// # Errors
    /// [`Error::Value`] unless `width` is positive.
    pub fn new(width: M::Real, otherwise: Answer) -> Result<Self, Error> {
        Ok(Self { width: WIDTH.check(width)?, otherwise })
    }
}

impl<M: Memory> Gate<M> for DeadZone<M> {
    fn configure(values: &dyn Values, _: M) -> Result<Self, Error> {
        Self::new(WIDTH.number(values)?, otherwise::read(values)?)
    }

    fn describe(&self, each: &mut dyn FnMut(&'static str, Value<'_>)) {
        each(WIDTH.name, Value::Real(self.width.to_f64()));
        otherwise::describe(self.otherwise, each);
    }

    fn needs_noise_variance(&self) -> bool {
        true
    }

    #[inline]
    fn answer(&self, evidence: &Evidence<'_, '_, M>) -> Result<Answer, Error> {
        let r = evidence.standardized(evidence.largest_squared_error()).sqrt();
        let passes = r > self.width || evidence.noise_variance.is_none();
        Ok(if passes { Answer::Update } else { self.otherwise })
    }
}

#[cfg(test)]
mod tests {
    use super::DeadZone;
    use crate::gates::{Answer, AnyGate};
    use crate::covariance::Prior;
    use crate::estimator::Estimator;
    use crate::memory::Dynamic;
    use crate::rates::Constant;
    use crate::rules::Exponential;
    use crate::sample::{Noise, Skip};
    use crate::weightings::Equal;

    #[test]
    fn the_error_counts_in_standard_deviations_of_the_target_where_it_is_longest() {
        let memory = Dynamic::<f64>::new(1, 2, 2).unwrap();
        let (rate, prior) = (Constant::new(0.9).unwrap(), Prior::scalar(memory, 1.0).unwrap());
        let gate = AnyGate::DeadZone(DeadZone::new(2.5, Answer::Hold).unwrap());
        let mut estimator =
            Estimator::new(Exponential::new(), rate, Equal::new(), prior).with_gate(gate);
        // lengths 3 and 5, over √4
        let y = [3.0, 3.0, 0.0, 4.0];
        let update = estimator.update_with_noise(&[1.0, 1.0], &y, Noise::Scalar(4.0)).unwrap();
        assert_eq!(update.skipped, Some(Skip::Gate), "2.5 is not above 2.5");
        let update = estimator.update_with_noise(&[1.0, 1.0], &y, Noise::Scalar(3.9)).unwrap();
        assert_eq!((update.skipped, update.gate), (None, Answer::Update));
    }
}
