//! What an estimator is made from, and what it is when nothing is said.

use crate::choice::{Choice, Value};
use crate::error::Error;
use crate::number::{NumberType, View};
use forgetting::defaults::{FORGETTING_FACTOR, PROCESS_NOISE, RULE, RULE_OF_DATA};
use forgetting::rules::RULES;
use forgetting::{Dynamic, DIFFUSE};

/// The most threads that can be asked for.
const MOST_THREADS: i64 = 1024;

/// How much to forget.
#[derive(Clone, Debug, Default)]
pub enum ForgettingFactor {
    /// 0.99, or nothing where the rule uses no forgetting factor
    #[default]
    Default,
    /// nothing by it: the rule has factors of its own
    None,
    /// by this rate; a constant is one, too
    Rate(Choice),
}

impl ForgettingFactor {
    /// The same λ for every sample.
    #[must_use]
    pub fn constant(forgetting_factor: f64) -> Self {
        Self::Rate(Choice::named("constant").with("forgetting_factor", forgetting_factor))
    }

    /// The rate beside the rule of this name; without a factor it reports λ = 1.
    pub(crate) fn rate(&self, rule: &str) -> Choice {
        match self {
            Self::Rate(rate) => rate.clone(),
            Self::Default if uses_factor(rule) => Self::constant(FORGETTING_FACTOR).rate(rule),
            Self::Default | Self::None => Self::constant(1.0).rate(rule),
        }
    }

    /// Whether the rule of this name then uses a forgetting factor.
    pub(crate) fn is_used(&self, rule: &str) -> bool {
        match self {
            Self::Rate(_) => true,
            Self::Default => uses_factor(rule),
            Self::None => false,
        }
    }
}

/// Whether the rule of this name uses a forgetting factor.
pub(crate) fn uses_factor(rule: &str) -> bool {
    RULES.iter().any(|about| about.name == rule && about.forgetting_factor)
}

/// What an estimator is made from.
#[derive(Clone, Debug)]
pub struct Settings<'a> {
    /// n, from 1 to 32768
    pub parameters: usize,
    /// p, from 1 to 32768: measurements a sample that share one θ
    pub rows: usize,
    /// m, from 1 to 32768: parameter vectors that share φ and P
    pub targets: usize,
    /// the type of all numbers
    pub number_type: NumberType,
    /// where to forget; if not given, a random walk that is bounded, or `subspace` where P₀ or a
    /// forgetting factor is given
    pub rule: Option<Choice>,
    /// how much to forget
    pub forgetting_factor: ForgettingFactor,
    /// how far to trust a sample; equally, if not given
    pub weighting: Option<Choice>,
    /// whether a sample is used; always, if not given
    pub gate: Option<Choice>,
    /// P₀, (), (n,) or (n, n), positive definite, in units of 1/φ²; [`Prior::of_data`](forgetting::Prior::of_data) if
    /// not given
    pub initial_covariance: Option<View<'a>>,
    /// θ₀, (n,) or (n, m); 0 if not given
    pub initial_theta: Option<View<'a>>,
    /// whether windup, excitation, noise and whiteness are watched
    pub monitor: bool,
}

impl Settings<'_> {
    /// The defaults for n = `parameters`.
    #[must_use]
    pub fn new(parameters: usize) -> Self {
        Self {
            parameters,
            rows: 1,
            targets: 1,
            number_type: NumberType::F64,
            rule: None,
            forgetting_factor: ForgettingFactor::Default,
            weighting: None,
            gate: None,
            initial_covariance: None,
            initial_theta: None,
            monitor: false,
        }
    }

    /// The same with a rule that takes a forgetting factor, if none was named.
    pub(crate) fn with_factor(&self) -> Self {
        let rule = self.rule.clone().or_else(|| Some(Choice::named(RULE)));
        Self { rule, ..self.clone() }
    }

    /// The same with this forgetting factor in the place of that of the rule.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a rule that uses none.
    pub fn with_forgetting_factor(
        self,
        forgetting_factor: ForgettingFactor,
    ) -> Result<Self, Error> {
        let settings = Self { forgetting_factor, ..self };
        let rule = settings.rule();
        let inner = |value: &Value| match value {
            Value::Word(name) | Value::Choice(Choice { name, .. }) => uses_factor(name),
            _ => false,
        };
        if uses_factor(&rule.name) || rule.parameters.iter().any(|(_, value)| inner(value)) {
            return Ok(settings);
        }
        let reason = format!("forgetting_factor is given, but the rule {} uses none", rule.name);
        Err(Error::unsupported(reason))
    }

    /// The rule, named or not.
    pub(crate) fn rule(&self) -> Choice {
        let walk = || {
            Choice::named(RULE_OF_DATA).with("process_noise", PROCESS_NOISE).with("bound", DIFFUSE)
        };
        match (&self.rule, self.initial_covariance, &self.forgetting_factor) {
            (Some(rule), ..) => rule.clone(),
            (None, None, ForgettingFactor::Default | ForgettingFactor::None) => walk(),
            (None, ..) => Choice::named(RULE),
        }
    }
}

/// A size from a language whose whole numbers have a sign; its range is checked where it is used.
///
/// # Errors
/// [`Error::Core`] names a negative one.
pub fn size(parameter: &'static str, size: i64) -> Result<usize, Error> {
    usize::try_from(size)
        .map_err(|_| forgetting::Error::value(parameter, size as f64, Dynamic::<f64>::SIZES).into())
}

/// The number of threads that a fleet's updates run on; none for what suits the machine.
///
/// # Errors
/// [`Error::Core`] names `threads` unless it is from 1 to 1024.
pub fn threads(threads: Option<i64>) -> Result<Option<usize>, Error> {
    match threads {
        Some(threads) if !(1..=MOST_THREADS).contains(&threads) => {
            let allowed = "whole numbers from 1 to 1024";
            Err(forgetting::Error::value("threads", threads as f64, allowed).into())
        }
        threads => Ok(threads.map(|threads| threads as usize)),
    }
}
