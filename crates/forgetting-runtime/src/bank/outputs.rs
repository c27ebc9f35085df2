//! The outputs of a record through a bank as they grow, sample by sample.

use super::by_parameter;
use crate::error::Error;
use crate::estimator::record::{arrays, push, room, Run, Sizes};
use crate::number::{Elements, Number};
use forgetting::bank::{Bank, BankOutcome, BankUpdate, Kept};
use forgetting::{Answer, Memory, Skip};

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

impl<T: Number> Outputs<T> {
    /// Room for the outputs of these names.
    ///
    /// # Errors
    /// [`Error::Output`] for an unknown name, [`Error::Core`] when there is not enough memory.
    pub fn named(names: &[&str], sizes: Sizes, count: usize) -> Result<Self, Error> {
        if let Some(name) = names.iter().find(|name| !BANK_OUTPUTS.contains(name)) {
            return Err(Error::Output { name: (*name).into(), allowed: BANK_OUTPUTS.join(", ") });
        }
        let Sizes { samples, parameters: n, rows: p, targets: m } = sizes;
        Ok(Self {
            theta: room(names, "theta", &[samples, n, m])?,
            error: room(names, "error", &[samples, p, m])?,
            leverage: room(names, "leverage", &[samples])?,
            forgetting_factor: room(names, "forgetting_factor", &[samples])?,
            skipped: room(names, "skipped", &[samples])?,
            gate: room(names, "gate", &[samples])?,
            windup: room(names, "windup", &[samples])?,
            variance: room(names, "variance", &[samples, n])?,
            covariance: room(names, "covariance", &[samples, n, n])?,
            weights: room(names, "weights", &[samples, count])?,
            memory: room(names, "memory", &[samples])?,
            used: 0,
        })
    }

    /// Whether P is needed after every sample.
    pub(super) fn need_covariance(&self) -> bool {
        self.variance.is_some() || self.covariance.is_some()
    }

    /// Lets the bank take as many samples of one row as it can take together, and notes what came of
    /// them; returns how many.
    pub(super) fn take_many(
        &mut self,
        bank: &mut Bank<T>,
        (phi, y): (&[T], &[T]),
        outcomes: &mut [BankOutcome<T>],
    ) -> usize {
        if (bank.memory().rows(), bank.memory().targets()) != (1, 1) {
            return 0;
        }
        let (n, count) = (bank.memory().parameters(), bank.weights().len());
        let most = outcomes.len().min(y.len());
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

    /// Notes what samples that were taken together did.
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

    /// Notes the weights with which the next sample is predicted.
    pub(super) fn note_weights(&mut self, bank: &Bank<T>) {
        if let Some(weights) = &mut self.weights {
            weights.extend_from_slice(bank.weights());
        }
    }

    /// Notes what a sample did.
    pub(super) fn note(&mut self, update: &BankUpdate<'_, T>) {
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

    /// Notes a sample that never reached the bank, which stays as it is.
    pub(super) fn note_missing(&mut self, width: usize) {
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

    /// Notes the state after a sample.
    pub(super) fn note_state(&mut self, bank: &Bank<T>) {
        let n = bank.memory().parameters();
        if let Some(theta) = &mut self.theta {
            by_parameter(bank, theta);
        }
        if let Some(memory) = &mut self.memory {
            memory.push(bank.memory_in_samples());
        }
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
        Run { outputs: arrays(outputs), samples, used: self.used, reweighted: false }
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
