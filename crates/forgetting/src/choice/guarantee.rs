//! What a rule guarantees, as data: the claims, where each holds and where it fails, and the
//! bounds of P that follow from known constants. The tests run the settings; the README, the
//! pages and the reports print the claims and the bounds.

use super::Value;

/// Whether something is guaranteed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// for every input
    Always,
    /// under this condition
    If(&'static str),
    /// not in general
    No,
}

impl core::fmt::Display for Claim {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Always => f.write_str("always"),
            Self::If(condition) => write!(f, "if {condition}"),
            Self::No => f.write_str("no"),
        }
    }
}

/// What a rule guarantees of the information F that it takes and of the covariance P.
#[derive(Clone, Copy, Debug)]
pub struct Guarantees {
    /// A1: F ≥ 0
    pub proper: Guarantee,
    /// A2: P̄ is bounded above, without any excitation
    pub bounded_above: Guarantee,
    /// A3: P is bounded below, for bounded regressors
    pub bounded_below: Guarantee,
}

impl Guarantees {
    /// Each with its name, in every language.
    pub fn named(&self) -> [(&'static str, Guarantee); 3] {
        let Self { proper, bounded_above, bounded_below } = *self;
        [("proper", proper), ("bounded_above", bounded_above), ("bounded_below", bounded_below)]
    }
}

/// A claim and the settings that show it.
#[derive(Clone, Copy, Debug)]
pub struct Guarantee {
    /// whether it is guaranteed
    pub claim: Claim,
    /// a setting that meets the condition, where the usual ones do not
    pub holds: Option<Setting>,
    /// a setting in which it fails, unless it always holds
    pub fails: Option<Setting>,
}

impl Guarantee {
    /// For every input.
    pub const ALWAYS: Self = Self { claim: Claim::Always, holds: None, fails: None };

    /// Under this condition, without which it `fails` in a setting.
    pub const fn when(condition: &'static str, fails: Setting) -> Self {
        Self { claim: Claim::If(condition), holds: None, fails: Some(fails) }
    }

    /// Not in general: it `fails` in a setting.
    pub const fn no(fails: Setting) -> Self {
        Self { claim: Claim::No, holds: None, fails: Some(fails) }
    }

    /// Under a condition on a function of the user's, which no setting can show.
    pub const fn of_function(condition: &'static str) -> Self {
        Self { claim: Claim::If(condition), holds: None, fails: None }
    }

    /// The same, with a setting that meets the condition.
    pub const fn holds_in(self, setting: Setting) -> Self {
        Self { holds: Some(setting), ..self }
    }
}

/// A run that shows whether a claim holds.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// parameters of the rule by name, the defaults for the rest
    pub parameters: &'static [(&'static str, Value<'static>)],
    /// λ, the same at every sample
    pub forgetting_factor: f64,
    /// P₀ = variance · I
    pub variance: f64,
    /// the regressors
    pub input: Input,
    /// the size of the errors
    pub error: f64,
}

impl Setting {
    /// λ = 0.95, P₀ = 10 I, errors within ±1 and the default parameters.
    pub const fn usual(input: Input) -> Self {
        Self { parameters: &[], forgetting_factor: 0.95, variance: 10.0, input, error: 1.0 }
    }

    /// The same with these parameters of the rule.
    pub const fn with(self, parameters: &'static [(&'static str, Value<'static>)]) -> Self {
        Self { parameters, ..self }
    }

    /// The same with this λ.
    pub const fn factor(self, forgetting_factor: f64) -> Self {
        Self { forgetting_factor, ..self }
    }
}

/// The regressors of a run: every component within ±1, but for a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// every direction, with this many rows
    Exciting(usize),
    /// 50 exciting samples, then zeros
    Silent,
    /// 50 exciting samples, then one direction
    Fixed,
    /// rows that are multiples of each other, every second sample silent
    Dependent,
    /// all directions, times this factor
    Scaled(f64),
    /// one direction, falling to this length over 3000 samples
    Fading(f64),
    /// two rows, the second of this length and orthogonal to the first
    Uneven(f64),
    /// once (1, ±1e-3, 0), then ten times (0, 1e-4, 0)
    Alternating,
    /// one component at a time
    Axes,
    /// all components equal, but for one part in a thousand
    Correlated,
}

/// What bounds of P depend on, beside the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// n
    pub parameters: usize,
    /// the smallest and the largest eigenvalue of P₀
    pub initial: (f64, f64),
    /// the smallest and the largest λ
    pub forgetting_factors: (f64, f64),
    /// β ≥ 0: no squared singular value of the whitened regressors is larger; infinite if unknown
    pub regressor_bound: f64,
}

impl Constants {
    /// (1 − λ)/β: where R grows by β at each sample and shrinks by λ at least, P stays above.
    pub fn least_remembered(&self, largest_factor: f64) -> Option<f64> {
        positive((1.0 - largest_factor) / self.regressor_bound)
    }

    /// Of a rule that forgets along samples only, and leaves out what is below `threshold`: what
    /// it forgets in a direction is made up for by the sample as soon as R is threshold²/(1 − λ).
    pub fn along_samples(&self, threshold: f64) -> Bounds {
        let (smallest, largest) = self.forgetting_factors;
        Bounds {
            below: self.least_remembered(largest),
            above: positive((1.0 - smallest) / (threshold * threshold)),
        }
    }

    /// 1/(β + 1/p): P after a sample, where P̄ is at least p.
    pub fn least_after(&self, forgotten: f64) -> Option<f64> {
        positive(1.0 / (self.regressor_bound + 1.0 / forgotten))
    }
}

/// Bounds of the eigenvalues of P after every sample; P may be beyond them where P₀ is, but no
/// further than P₀. None where the rule has no bound, or no formula for it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// P is at least this, for regressors within their bound
    pub below: Option<f64>,
    /// P is at most this, for any input
    pub above: Option<f64>,
}

impl Bounds {
    /// The bounds with P₀ taken in.
    pub fn with_initial(self, (smallest, largest): (f64, f64)) -> Self {
        Self {
            below: self.below.map(|below| below.min(smallest)),
            above: self.above.map(|above| above.max(largest)),
        }
    }
}

/// The bound, if it is one.
pub fn positive(bound: f64) -> Option<f64> {
    (bound > 0.0 && bound.is_finite()).then_some(bound)
}
