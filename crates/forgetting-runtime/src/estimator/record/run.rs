//! The results of a record.

use crate::number::Array;
#[cfg(doc)]
use forgetting::{Answer, Skip, Update};

/// Results of a record of T samples.
///
/// | output | shape | |
/// |---|---|---|
/// | `theta` | (T, n) or (T, n, m) | θ after each sample |
/// | `error` | as y | y − φθ with the θ of before; NaN where a value is missing |
/// | `leverage` | (T,) | variance of the prediction in units of the noise variance |
/// | `forgetting_factor` | (T,) | λ used; 1 where the sample was missing |
/// | `rank` | (T,) counts | number of directions that lost information |
/// | `skipped` | (T,) codes | 0 where the sample was used, else [`Skip::code`] |
/// | `gate` | (T,) codes | [`Answer::code`] |
/// | `windup` | (T,) yes or no | whether P has wound up |
/// | `whitened_innovation` | as y | L⁻¹(y − φθ), see [`Update::whiten`] |
/// | `variance` | (T, n) | diagonal of P after each sample |
/// | `covariance` | (T, n, n) | P after each sample |
/// | `weight` | (T,) | Γ was divided by this, by the weighting and by the rule |
/// | `prior_covariance` | (T, n, n) | P after forgetting and before the data of each sample |
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// the outputs that were asked for, each with its name
    pub outputs: Vec<(&'static str, Array)>,
    /// number of samples in the record
    pub samples: usize,
    /// number of samples used
    pub used: usize,
    /// whether a sample was measured with another Γ than it was given
    pub reweighted: bool,
}

impl Run {
    /// Names of the outputs that are kept when none are named.
    pub const DEFAULT_OUTPUTS: [&'static str; 6] =
        ["theta", "error", "leverage", "forgetting_factor", "rank", "skipped"];

    /// Names of all outputs.
    pub const OUTPUTS: [&'static str; 13] = [
        "theta",
        "error",
        "leverage",
        "forgetting_factor",
        "rank",
        "skipped",
        "gate",
        "windup",
        "whitened_innovation",
        "variance",
        "covariance",
        "prior_covariance",
        "weight",
    ];

    /// Takes out the output of this name, if it was asked for.
    pub fn take(&mut self, name: &str) -> Option<Array> {
        let position = self.outputs.iter().position(|(own, _)| *own == name)?;
        Some(self.outputs.swap_remove(position).1)
    }
}
