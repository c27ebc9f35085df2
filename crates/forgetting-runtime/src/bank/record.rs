//! A whole record through a bank, all or nothing.

use super::by_parameter;
use crate::error::Error;
use crate::estimator::record::{GoOn, Missing, Pause, RecordNoise, Run, Sizes};
use crate::number::{Array, Elements, Number, View};
use forgetting::bank::{Bank, BankUpdate};
use forgetting::{Answer, Memory, Noise, Skip};

/// Names of the outputs that are kept when none are named.
pub(super) const DEFAULT_OUTPUTS: [&str; 6] =
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
struct Outputs<T> {
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
    missing: Missing,
    outputs: &[&str],
    go_on: GoOn<'_>,
) -> Result<Run, Error> {
    let sizes = Sizes::of(bank.memory(), &phi, &y)?;
    let count = bank.members().len();
    let mut outputs = Outputs::<T>::named(outputs, sizes, count)?;
    let (phi, y) = (T::read(phi.numbers()), T::read(y.numbers()));
    let gammas = gamma.map(|gamma| T::read(gamma.numbers()));
    let noise = match (&gamma, &gammas) {
        (Some(gamma), Some(gammas)) => RecordNoise::read(gamma.shape(), gammas, sizes)?,
        _ => RecordNoise::Unit,
    };
    let Sizes { samples, parameters: n, rows: p, targets: m } = sizes;
    let mut pause = Pause::new(go_on, count * p, n);
    let taken = bank.all_or_nothing(|bank| {
        for k in 0..samples {
            let phi = &phi[k * p * n..(k + 1) * p * n];
            let y = &y[k * p * m..(k + 1) * p * m];
            let is_missing = |values: &[T]| values.iter().any(|x| x.to_f64().is_nan());
            let missing = missing == Missing::Skip && (is_missing(phi) || is_missing(y));
            let sample = (!missing).then_some((phi, y, noise.at(k, p)));
            outputs.take(bank, sample, p * m).map_err(|error| (k, error))?;
            pause.after(1).map_err(|error| (k, error))?;
        }
        Ok(())
    });
    taken.map_err(|(sample, error)| Error::Sample { sample, error })?;
    Ok(outputs.finish(sizes, count))
}

impl<T: Number> Outputs<T> {
    /// Room for the outputs of these names.
    fn named(names: &[&str], sizes: Sizes, count: usize) -> Result<Self, Error> {
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

    /// Lets the bank take a sample, or leaves it out where there is none, and notes what came of it.
    fn take(
        &mut self,
        bank: &mut Bank<T>,
        sample: Option<(&[T], &[T], Noise<'_, T>)>,
        width: usize,
    ) -> Result<(), forgetting::Error> {
        if let Some(weights) = &mut self.weights {
            weights.extend_from_slice(bank.weights());
        }
        match sample {
            Some((phi, y, noise)) => self.note(&bank.update(phi, y, noise)?),
            None => self.note_missing(width),
        }
        if let Some(theta) = &mut self.theta {
            by_parameter(bank, theta);
        }
        if let Some(memory) = &mut self.memory {
            memory.push(bank.memory_in_samples());
        }
        self.note_covariance(bank);
        Ok(())
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

    /// The outputs as arrays.
    fn finish(self, sizes: Sizes, count: usize) -> Run {
        let Sizes { samples, parameters: n, rows: p, targets: m } = sizes;
        // one target has no dimension of its own
        let by_target = |shape: [usize; 3]| shape[..3 - usize::from(m == 1)].to_vec();
        let numbers = |numbers: Option<Vec<T>>| numbers.map(T::elements);
        let each = vec![samples];
        let outputs = [
            ("theta", numbers(self.theta), by_target([samples, n, m])),
            ("error", numbers(self.error), by_target([samples, p, m])),
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
