//! The bounds of P that a rule states.

use crate::choice::Choice;
use crate::configure;
use crate::error::Error;
use forgetting::choice::Constants;
use forgetting::{Dynamic, Forgetting};

/// The bounds of the eigenvalues of P after every sample, P₀ taken in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CovarianceBounds {
    /// P is at least this; None where there is no such bound, or no formula for it
    pub below: Option<f64>,
    /// P is at most this; None as above
    pub above: Option<f64>,
    /// whether P stays bounded whatever the input
    pub bounded: bool,
}

/// What `rule` says of P, given the constants.
///
/// # Errors
/// [`Error`] names the parameter of the rule, its value and what is allowed.
pub fn covariance_bounds(rule: &Choice, constants: &Constants) -> Result<CovarianceBounds, Error> {
    let memory = Dynamic::<f64>::new(constants.parameters, 1, 1)?;
    let rule = configure::rule(rule, memory)?;
    let bounds = rule.bounds(constants).with_initial(constants.initial);
    Ok(CovarianceBounds { below: bounds.below, above: bounds.above, bounded: rule.is_bounded() })
}
