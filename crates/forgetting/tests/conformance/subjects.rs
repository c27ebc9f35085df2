//! Every rule of the registry, with each of its words and each rule that it can be put around.
#![allow(dead_code, reason = "each test uses its share")]

use forgetting::choice::About;
use forgetting::choice::{Kind, Parameter, Value, Values};
use forgetting::gates::Answer;
use forgetting::rates::AnyRate;
use forgetting::rules::{Rule, RULES};
use forgetting::saved::AnyEstimator;
use forgetting::weightings::AnyWeighting;
use forgetting::{
    Dynamic, Error, Estimator, Forgetting, Kernels, Memory, Noise, Prior, Rate, Real, Skip,
    Weighting,
};

/// Values of parameters.
#[derive(Clone, Debug, Default)]
pub struct Given(pub Vec<(&'static str, Item)>);

/// One value.
#[derive(Clone)]
pub enum Item {
    Real(f64),
    Word(&'static str),
    /// rows and elements
    Matrix(usize, Vec<f64>, fn(&[f64], usize) -> f64),
    /// a rule with values of its own, none of them a matrix
    Rule(&'static str, Given),
}

impl std::fmt::Debug for Item {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Real(x) => write!(f, "{x:?}"),
            Self::Word(word) => f.write_str(word),
            Self::Matrix(rows, elements, _) => write!(f, "{rows} rows of {elements:?}"),
            Self::Rule(name, given) => write!(f, "{name} {:?}", given.0),
        }
    }
}

impl Given {
    pub fn one(name: &'static str, item: Item) -> Self {
        Self(vec![(name, item)])
    }

    /// Looks the values up; matrices need functions that live as long as the look-up.
    pub fn with<R>(&self, look: impl FnOnce(&dyn Values) -> R) -> R {
        let functions: Vec<Box<dyn Fn(usize) -> f64>> =
            self.0.iter().map(|(_, item)| item.clone().function()).collect();
        look(&Found { given: self, functions: &functions })
    }
}

impl Item {
    pub fn matrix(rows: usize, elements: &[f64]) -> Self {
        Self::Matrix(rows, elements.to_vec(), |elements, k| elements[k])
    }

    fn function(self) -> Box<dyn Fn(usize) -> f64> {
        match self {
            Self::Matrix(_, elements, at) => Box::new(move |k| at(&elements, k)),
            _ => Box::new(|_| f64::NAN),
        }
    }
}

struct Found<'a> {
    given: &'a Given,
    functions: &'a [Box<dyn Fn(usize) -> f64>],
}

impl Values for Found<'_> {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        let position = self.given.0.iter().position(|(known, _)| *known == name)?;
        Some(match &self.given.0[position].1 {
            Item::Real(x) => Value::Real(*x),
            Item::Word(word) => Value::Word(word),
            Item::Matrix(rows, elements, _) => Value::Matrix {
                rows: *rows,
                columns: elements.len() / rows,
                elements: &self.functions[position],
            },
            Item::Rule(name, given) => Value::Choice { name, values: given },
        })
    }
}

impl Values for Given {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        let (_, item) = self.0.iter().find(|(known, _)| *known == name)?;
        match item {
            Item::Real(x) => Some(Value::Real(*x)),
            Item::Word(word) => Some(Value::Word(word)),
            Item::Matrix(..) | Item::Rule(..) => None,
        }
    }
}

/// A rule with a choice of its words and inner rules, and the defaults for the rest.
#[derive(Clone)]
pub struct Subject {
    pub about: &'static About,
    pub given: Given,
}

impl std::fmt::Debug for Subject {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {:?}", self.about.name, self.given.0)
    }
}

impl Subject {
    pub fn rule<M: Memory>(&self, memory: M) -> Result<Rule<M>, Error> {
        self.given.with(|values| Rule::named(self.about.name, values, memory))
    }

    /// The estimator with this rule, or None where the rule does not take so many rows.
    pub fn estimator<T: Kernels>(
        &self,
        sizes: (usize, usize, usize),
        forgetting_factor: f64,
        variance: f64,
    ) -> Option<AnyEstimator<T>> {
        let memory = Dynamic::<T>::new(sizes.0, sizes.1, sizes.2).unwrap();
        let rule = match self.rule(memory) {
            Err(Error::Value { parameter: "rows", .. }) => return None,
            other => other.unwrap_or_else(|error| panic!("{self:?}: {error}")),
        };
        let factor = Given::one("forgetting_factor", Item::Real(forgetting_factor));
        let rate = factor.with(|values| AnyRate::named("constant", values, memory)).unwrap();
        let weighting = AnyWeighting::named("equal", &forgetting::choice::Defaults, memory);
        let prior = Prior::scalar(memory, T::from_f64(variance)).unwrap();
        Some(Estimator::new(rule, rate, weighting.unwrap(), prior))
    }
}

/// What is kept of an update.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub error: Vec<f64>,
    pub leverage: f64,
    pub forgetting_factor: f64,
    pub rank: usize,
    pub skipped: Option<Skip>,
    pub gate: Answer,
    pub windup: bool,
}

/// `Estimator::update_with_noise`, not inlined: all rules are in it, and compiled once this way.
#[inline(never)]
pub fn update<F, R, W, M>(
    estimator: &mut Estimator<F, R, W, M>,
    phi: &[M::Real],
    y: &[M::Real],
    noise: Noise<'_, M::Real>,
) -> Result<Outcome, Error>
where
    F: Forgetting<M>,
    R: Rate<M>,
    W: Weighting<M>,
    M: Memory,
{
    estimator.update_with_noise(phi, y, noise).map(|update| Outcome {
        error: update.error.iter().map(|x| x.to_f64()).collect(),
        leverage: update.leverage.to_f64(),
        forgetting_factor: update.forgetting_factor.to_f64(),
        rank: update.rank,
        skipped: update.skipped,
        gate: update.gate,
        windup: update.windup,
    })
}

/// Whether a value can be given by name and number: a function cannot.
fn can_be_given(about: &About) -> bool {
    let is_function =
        |p: &Parameter| p.kind == Kind::Function && p.default.is_none() && !p.optional;
    !about.parameters.iter().any(is_function)
}

/// A value for each parameter that has no default.
fn required(about: &About) -> Given {
    let needed = about.parameters.iter().filter(|p| p.default.is_none() && !p.optional);
    Given(needed.map(|p| (p.name, Item::Real(sample_in(p)))).collect())
}

/// A number in the range of the parameter.
pub fn sample_in(parameter: &Parameter) -> f64 {
    let found = [0.5, 1.0, 2.0, 0.0].into_iter().find(|&x| parameter.check(x).is_ok());
    found.expect("a range with one of the simplest numbers")
}

/// Every rule with its defaults.
pub fn rules() -> impl Iterator<Item = Subject> {
    let known = RULES.iter().filter(|about| can_be_given(about));
    known.map(|about| Subject { about, given: required(about) })
}

/// The next two values above the default of each whole-numbered parameter, one at a time: with
/// some, a rule keeps a state that it does not keep by default.
fn variants(plain: &Subject) -> Vec<Subject> {
    let memory = Dynamic::<f64>::new(3, 1, 1).unwrap();
    let whole = plain.about.parameters.iter().filter(|p| p.kind == Kind::Whole);
    let values = whole.flat_map(|parameter| {
        let first = match parameter.default {
            Some(Value::Real(default)) => default,
            _ => 0.0,
        };
        [1.0, 2.0].map(|more| (parameter.name, Item::Real(first + more)))
    });
    let subjects = values.map(|value| {
        let mut subject = plain.clone();
        subject.given.0.push(value);
        subject
    });
    subjects.filter(|subject| subject.rule(memory).is_ok()).collect()
}

/// Every rule that goes around others, around every rule with its defaults and with every choice
/// of its parameters that makes it keep a state, at resets that come often.
pub fn pairs() -> Vec<Subject> {
    let memory = Dynamic::<f64>::new(3, 1, 1).unwrap();
    let mut pairs = Vec::new();
    for around in rules() {
        let parameters = around.about.parameters;
        let Some(place) = parameters.iter().find(|p| p.kind == Kind::Rule) else { continue };
        for inner in rules().flat_map(|plain| {
            let mut all = variants(&plain);
            all.push(plain);
            all
        }) {
            for (period, covariance) in [(2.0, 0.3), (3.0, 1e3), (7.0, 100.0)] {
                let mut pair = around.clone();
                let rule = Item::Rule(inner.about.name, inner.given.clone());
                pair.given.0.extend([(place.name, rule), ("criterion", Item::Word("period"))]);
                pair.given.0.push(("period", Item::Real(period)));
                pair.given.0.push(("covariance", Item::Real(covariance)));
                if !matches!(pair.rule(memory), Err(Error::Unknown { .. })) {
                    pairs.push(pair);
                }
            }
        }
    }
    pairs
}

/// Every rule with its defaults, with each of its words and around each rule.
pub fn subjects() -> Vec<Subject> {
    let mut subjects = Vec::new();
    for plain in rules() {
        for parameter in plain.about.parameters {
            let words: Vec<&'static str> = match parameter.kind {
                Kind::Word(words) => words.to_vec(),
                Kind::Rule => rules().map(|rule| rule.about.name).collect(),
                _ => Vec::new(),
            };
            for word in words {
                let mut subject = plain.clone();
                subject.given.0.push((parameter.name, Item::Word(word)));
                let memory = Dynamic::<f64>::new(3, 1, 1).unwrap();
                // a rule around others is none of the others
                if !matches!(subject.rule(memory), Err(Error::Unknown { .. })) {
                    subjects.push(subject);
                }
            }
        }
        subjects.push(plain);
    }
    subjects
}
