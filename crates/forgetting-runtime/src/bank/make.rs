//! A bank from its settings.

use crate::choice::{has_function, Choice};
use crate::configure;
use crate::error::Error;
use crate::function::for_rule;
use crate::number::{Number, NumberType, Numbers, View};
use crate::settings::{ForgettingFactor, Settings};
use forgetting::bank::{default_members, Bank, DEFAULT_PRIOR_RATIO};
use forgetting::mixers::{AnyMixer, MIXERS};
use forgetting::{AnyEstimator, Dynamic, DIFFUSE};

/// A member of a bank.
#[derive(Clone, Debug)]
pub struct Member {
    /// where it forgets
    pub rule: Choice,
    /// how much
    pub forgetting_factor: ForgettingFactor,
}

/// What a bank is made from.
#[derive(Clone, Debug)]
pub struct BankSettings<'a> {
    /// sizes, number type, weighting, gate and prior of all members; a rule, a forgetting factor
    /// and a monitor are not those of a bank. Without an initial covariance the members measure φ in
    /// units that the data choose.
    pub common: Settings<'a>,
    /// the members; [`forgetting::bank::default_members`] if not given
    pub members: Option<Vec<Member>>,
    /// what mixes them; `mlpol` if not given, with [`DEFAULT_PRIOR_RATIO`] for default members
    pub mixer: Option<Choice>,
}

/// Process noise up to which a default member is one where samples are weighted.
const SLOW: f64 = 1.0;
/// The most members of a bank.
const MOST: usize = 1024;

pub(crate) fn bank<T: Number>(settings: &BankSettings<'_>) -> Result<Bank<T>, Error> {
    let BankSettings { common, members, mixer } = settings;
    if common.initial_covariance.is_none() && common.initial_theta.is_some() {
        return Err(Error::unsupported(
            "initial_theta goes with initial_covariance: it says how far to trust it",
        ));
    }
    let of_walks = members.is_none();
    let members = match members {
        Some(members) => named::<T>(common, members)?,
        None => defaults::<T>(common)?,
    };
    if members.iter().any(has_function) {
        return Err(Error::unsupported(
            "a bank takes no function of yours: it would be called for each member and sample",
        ));
    }
    let mut mixer = mixer.clone().unwrap_or_else(|| Choice::named("mlpol"));
    if of_walks && mixer.name == "mlpol" && mixer.get("prior_ratio").is_none() {
        mixer = mixer.with("prior_ratio", DEFAULT_PRIOR_RATIO);
    }
    let of_members = Dynamic::new(members.len().max(1), 1, 1)?;
    let mixer = mixer.make(("mixer", MIXERS), for_rule, |name, values| {
        AnyMixer::named(name, values, of_members)
    })?;
    Ok(match common.initial_covariance {
        Some(_) => Bank::new(members, mixer),
        None => Bank::of_data(members, mixer),
    }?)
}

/// Members of these rules.
fn named<T: Number>(
    common: &Settings<'_>,
    members: &[Member],
) -> Result<Vec<AnyEstimator<T>>, Error> {
    if !(1..=MOST).contains(&members.len()) {
        let (count, allowed) = (members.len() as f64, "1 to 1024 of them");
        return Err(forgetting::Error::value("members", count, allowed).into());
    }
    let diffuse = [DIFFUSE];
    let diffuse = View::new("initial_covariance", Numbers::F64(&diffuse), &[])?;
    let covariance = common.initial_covariance.unwrap_or(diffuse);
    let make = |member: &Member| {
        let settings = Settings {
            rule: Some(member.rule.clone()),
            forgetting_factor: member.forgetting_factor.clone(),
            ..common.clone()
        };
        configure::estimator::<T>(&settings, Some(covariance), common.initial_theta)
    };
    members.iter().map(make).collect()
}

/// The default members, with the weighting, the gate and the prior of `common`.
///
/// With a weighting there is none that takes its parameters from one sample alone: what a weight can
/// do there is little, as P is large beside any noise.
fn defaults<T: Number>(common: &Settings<'_>) -> Result<Vec<AnyEstimator<T>>, Error> {
    let plain =
        common.weighting.is_none() && common.gate.is_none() && common.initial_covariance.is_none();
    if plain {
        let memory = Dynamic::new(common.parameters, common.rows, common.targets)?;
        return Ok(default_members(memory)?);
    }
    let walk = |noise: &f64| Member {
        rule: Choice::named("random_walk").with("process_noise", *noise).with("bound", DIFFUSE),
        forgetting_factor: ForgettingFactor::None,
    };
    let slow = |noise: &&f64| common.weighting.is_none() || **noise <= SLOW;
    let noises = forgetting::bank::DEFAULT_NOISE.iter().filter(slow);
    let members: Vec<_> = noises.map(walk).collect();
    named(common, &members)
}

impl BankSettings<'_> {
    /// The default bank of n = `parameters`.
    #[must_use]
    pub fn new(parameters: usize) -> Self {
        Self { common: Settings::new(parameters), members: None, mixer: None }
    }

    /// The number type of the bank.
    #[must_use]
    pub fn number_type(&self) -> NumberType {
        self.common.number_type
    }
}
