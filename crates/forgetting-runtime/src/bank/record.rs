//! A whole record through a bank, all or nothing.

use super::by_parameter;
use crate::error::Error;
use crate::estimator::record::{
    GoOn, Pause, Record, RecordNoise, RecordTime, Run, RunOptions, Sizes,
};
use crate::missing::{is_missing, Missing};
use crate::number::{Array, Elements, Number, View};
use forgetting::bank::{Bank, BankOutcome, BankUpdate, Kept};
use forgetting::{Answer, Memory, Skip};

/// Why a bank does not feed bounds back.
pub(crate) const ONE_RULE: &str =
    "bounds are fed back to one rule; a bank mixes several, each with a P of its own";

/// Names of the outputs that are kept when none are named.
const DEFAULT_OUTPUTS: [&str; 6] =
    ["theta", "error", "leverage", "forgetting_factor", "skipped", "memory"];

/// Names of all outputs of a bank: those of [`Run`], and
///
/// | output | shape | |
/// |---|---|---|
/// | `weights` | (T, K) | w of each member, with which the sample was predicted |
/// | `memory` | (T,) | over how many samples the bank remembers, after the sample |
pub const BANK_OUTPUTS: [&str; 11] = [
    "theta",
    "error",
    "leverage",
    "forgetting_factor",
    "skipped",
    "gate",
    "windup",
    "variance",
    "covariance",
    "weights",
    "memory",
];

/// The outputs that were asked for, as they grow.
pub(crate) struct Outputs<T> {
    theta: Option<Vec<T>>,
    error: Option<Vec<T>>,
    leverage: Option<Vec<T>>,
    forgetting_factor: Option<Vec<T>>,
    skipped: Option<Vec<u8>>,
    gate: Option<Vec<u8>>,
    windup: Option<Vec<bool>>,
    variance: Option<Vec<T>>,
    covariance: Option<Vec<T>>,
    weights: Option<Vec<T>>,
    memory: Option<Vec<T>>,
    used: usize,
}

/// Updates `bank` with every sample; on an error it is as it was before the first.
pub(super) fn run<T: Number>(
    bank: &mut Bank<T>,
    (phi, y, gamma): (View<'_>, View<'_>, Option<View<'_>>),
    options: &RunOptions<'_>,
    go_on: GoOn<'_>,
) -> Result<Run, Error> {
    let sizes = Sizes::of(bank.memory(), &phi, &y)?;
    if options.bounds.is_some() {
        return Err(Error::unsupported(ONE_RULE));
    }
    let count = bank.weights().len();
    let outputs = options.outputs.unwrap_or(&DEFAULT_OUTPUTS);
    let mut outputs = Outputs::<T>::named(outputs, sizes, count)?;
    let shape_of_y = y.shape().to_vec();
    let (phi, y) = (T::read(phi.numbers()), T::read(y.numbers()));
    let gammas = gamma.map(|gamma| T::read(gamma.numbers()));
    let noise = match (&gamma, &gammas) {
        (Some(gamma), Some(gammas)) => RecordNoise::read(gamma.shape(), gammas, sizes)?,
        _ => RecordNoise::Unit,
    };
    let mut time = options.time.map(|time| RecordTime::read(time, sizes)).transpose()?;
    let record = Record { sizes, phi: &phi, y: &y, noise, missing: options.missing };
    let mut pause = Pause::new(go_on, count * sizes.rows, sizes.parameters);
    let taken =
        bank.all_or_nothing(|bank| take(bank, (&record, time.as_mut()), &mut outputs, &mut pause));
    taken.map_err(|(sample, error)| Error::Sample { sample, error })?;
    Ok(outputs.finish(sizes, count, &shape_of_y))
}

/// The most samples that a bank takes together.
const MOST: usize = 64;

fn take<T: Number>(
    bank: &mut Bank<T>,
    (record, mut time): (&Record<'_, T>, Option<&mut RecordTime<'_>>),
    outputs: &mut Outputs<T>,
    pause: &mut Pause<'_>,
) -> Result<(), (usize, forgetting::Error)> {
    let together =
        matches!(record.noise, RecordNoise::Unit) && !outputs.need_covariance() && time.is_none();
    let (n, samples) = (record.sizes.parameters, record.sizes.samples);
    let mut outcomes = [BankOutcome::default(); MOST];
    let mut k = 0;
    while k < samples {
        let taken = match together {
            true => outputs.take_many(bank, (&record.phi[k * n..], &record.y[k..]), &mut outcomes),
            false => 0,
        };
        if taken == 0 {
            outputs.take(bank, (record, time.as_deref_mut()), k).map_err(|error| (k, error))?;
        }
        pause.after(taken.max(1)).map_err(|error| (k, error))?;
        k += taken.max(1);
    }
    Ok(())
}

impl<T: Number> Outputs<T> {
    /// Room for the outputs of these names.
    pub fn named(names: &[&str], sizes: Sizes, count: usize) -> Result<Self, Error> {
        if let Some(name) = names.iter().find(|name| !BANK_OUTPUTS.contains(name)) {
            return Err(Error::Output { name: (*name).into(), allowed: BANK_OUTPUTS.join(", ") });
        }
        let Sizes { samples, parameters: n, rows: p, targets: m } = sizes;
        Ok(Self {
            theta: room(names, "theta", samples * n * m),
            error: room(names, "error", samples * p * m),
            leverage: room(names, "leverage", samples),
            forgetting_factor: room(names, "forgetting_factor", samples),
            skipped: room(names, "skipped", samples),
            gate: room(names, "gate", samples),
            windup: room(names, "windup", samples),
            variance: room(names, "variance", samples * n),
            covariance: room(names, "covariance", samples * n * n),
            weights: room(names, "weights", samples * count),
            memory: room(names, "memory", samples),
            used: 0,
        })
    }

    /// Whether P is needed after every sample.
    fn need_covariance(&self) -> bool {
        self.variance.is_some() || self.covariance.is_some()
    }

    /// Lets the bank take as many samples of one row as it can take together, and notes what came of
    /// them; returns how many.
    fn take_many(
        &mut self,
        bank: &mut Bank<T>,
        (phi, y): (&[T], &[T]),
        outcomes: &mut [BankOutcome<T>; MOST],
    ) -> usize {
        if (bank.memory().rows(), bank.memory().targets()) != (1, 1) {
            return 0;
        }
        let (n, count) = (bank.memory().parameters(), bank.weights().len());
        let most = MOST.min(y.len());
        let taken = {
            let theta = more(&mut self.theta, most * n);
            let weights = more(&mut self.weights, most * count);
            let memory = more(&mut self.memory, most);
            let mut kept = Kept { theta, weights, memory };
            bank.update_many(phi, y, &mut outcomes[..most], &mut kept)
        };
        less(&mut self.theta, (most - taken) * n);
        less(&mut self.weights, (most - taken) * count);
        less(&mut self.memory, most - taken);
        self.note_many(&outcomes[..taken]);
        taken
    }

    fn note_many(&mut self, outcomes: &[BankOutcome<T>]) {
        if let Some(error) = &mut self.error {
            error.extend(outcomes.iter().map(|outcome| outcome.error));
        }
        if let Some(leverage) = &mut self.leverage {
            leverage.extend(outcomes.iter().map(|outcome| outcome.leverage));
        }
        if let Some(factors) = &mut self.forgetting_factor {
            factors.extend(outcomes.iter().map(|outcome| outcome.forgetting_factor));
        }
        if let Some(skipped) = &mut self.skipped {
            skipped.extend(outcomes.iter().map(|_| 0));
        }
        if let Some(gate) = &mut self.gate {
            gate.extend(outcomes.iter().map(|_| Answer::Update.code()));
        }
        if let Some(windup) = &mut self.windup {
            windup.extend(outcomes.iter().map(|outcome| outcome.windup));
        }
        self.used += outcomes.len();
    }

    /// Lets the bank take the sample at `k`, or leaves it out, and notes what came of it; why it was not
    /// used, if it was not.
    pub fn take(
        &mut self,
        bank: &mut Bank<T>,
        (record, time): (&Record<'_, T>, Option<&mut RecordTime<'_>>),
        k: usize,
    ) -> Result<Option<Skip>, forgetting::Error> {
        let Sizes { parameters: n, rows: p, targets: m, .. } = record.sizes;
        let phi = &record.phi[k * p * n..(k + 1) * p * n];
        let y = &record.y[k * p * m..(k + 1) * p * m];
        if let Some(weights) = &mut self.weights {
            weights.extend_from_slice(bank.weights());
        }
        let skipped = if record.missing == Missing::Skip && is_missing(phi, y) {
            self.note_missing(p * m);
            Some(Skip::Missing)
        } else {
            let elapsed = time.map_or(Ok(T::ONE), |time| time.elapsed(k))?;
            let update = bank.update_after(elapsed, phi, y, record.noise.at(k, p))?;
            self.note(&update);
            update.skipped
        };
        if let Some(theta) = &mut self.theta {
            by_parameter(bank, theta);
        }
        if let Some(memory) = &mut self.memory {
            memory.push(bank.memory_in_samples());
        }
        self.note_covariance(bank);
        Ok(skipped)
    }

    fn note(&mut self, update: &BankUpdate<'_, T>) {
        if let Some(error) = &mut self.error {
            error.extend_from_slice(update.error);
        }
        push(&mut self.leverage, update.leverage);
        push(&mut self.forgetting_factor, update.forgetting_factor);
        push(&mut self.skipped, update.skipped.map_or(0, Skip::code));
        push(&mut self.gate, update.gate.code());
        push(&mut self.windup, update.windup);
        self.used += usize::from(update.skipped.is_none());
    }

    fn note_missing(&mut self, width: usize) {
        let nothing = T::from_f64(f64::NAN);
        if let Some(error) = &mut self.error {
            error.extend(std::iter::repeat_n(nothing, width));
        }
        push(&mut self.leverage, nothing);
        push(&mut self.forgetting_factor, T::ONE);
        push(&mut self.skipped, Skip::Missing.code());
        push(&mut self.gate, Answer::Update.code());
        push(&mut self.windup, false);
    }

    fn note_covariance(&mut self, bank: &Bank<T>) {
        let n = bank.memory().parameters();
        if let Some(variance) = &mut self.variance {
            let start = variance.len();
            variance.resize(start + n, T::ZERO);
            bank.variances(&mut variance[start..]);
        }
        if let Some(covariance) = &mut self.covariance {
            let start = covariance.len();
            covariance.resize(start + n * n, T::ZERO);
            bank.covariance(&mut covariance[start..]);
        }
    }

    /// The outputs as arrays, errors in the shape of y.
    pub fn finish(self, sizes: Sizes, count: usize, per_row: &[usize]) -> Run {
        let Sizes { samples, parameters: n, targets: m, .. } = sizes;
        // one target has no dimension of its own
        let theta = [samples, n, m][..3 - usize::from(m == 1)].to_vec();
        let numbers = |numbers: Option<Vec<T>>| numbers.map(T::elements);
        let each = vec![samples];
        let outputs = [
            ("theta", numbers(self.theta), theta),
            ("error", numbers(self.error), per_row.to_vec()),
            ("leverage", numbers(self.leverage), each.clone()),
            ("forgetting_factor", numbers(self.forgetting_factor), each.clone()),
            ("skipped", self.skipped.map(Elements::U8), each.clone()),
            ("gate", self.gate.map(Elements::U8), each.clone()),
            ("windup", self.windup.map(Elements::Bool), each.clone()),
            ("variance", numbers(self.variance), vec![samples, n]),
            ("covariance", numbers(self.covariance), vec![samples, n, n]),
            ("weights", numbers(self.weights), vec![samples, count]),
            ("memory", numbers(self.memory), each),
        ];
        let outputs = outputs.into_iter().filter_map(|(name, elements, shape)| {
            elements.map(|elements| (name, Array { shape, elements }))
        });
        Run { outputs: outputs.collect(), samples, used: self.used, reweighted: false }
    }
}

/// Room for `length` elements of the output `name`, if it is among `names`.
fn room<X>(names: &[&str], name: &str, length: usize) -> Option<Vec<X>> {
    names.contains(&name).then(|| Vec::with_capacity(length))
}

fn push<X>(values: &mut Option<Vec<X>>, value: X) {
    if let Some(values) = values {
        values.push(value);
    }
}

/// Room for `length` more values, if they are kept: zeros, to be written.
fn more<T: Number>(values: &mut Option<Vec<T>>, length: usize) -> &mut [T] {
    match values {
        None => &mut [],
        Some(values) => {
            let old = values.len();
            values.resize(old + length, T::ZERO);
            &mut values[old..]
        }
    }
}

/// Without the last `length` values.
fn less<X>(values: &mut Option<Vec<X>>, length: usize) {
    if let Some(values) = values {
        values.truncate(values.len() - length);
    }
}
