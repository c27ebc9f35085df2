//! A whole record through a bank, all or nothing.

use super::outputs::Outputs;
use crate::error::Error;
use crate::estimator::record::{
    GoOn, Pause, Record, RecordNoise, RecordTime, Run, RunOptions, Sizes,
};
use crate::missing::{is_missing, Missing};
use crate::number::{Number, View};
use forgetting::bank::{Bank, BankOutcome};
use forgetting::Skip;

/// Why a bank does not feed bounds back.
pub(crate) const ONE_RULE: &str =
    "bounds are fed back to one rule; a bank mixes several, each with a P of its own";

/// Names of the outputs that are kept when none are named.
const DEFAULT_OUTPUTS: [&str; 6] =
    ["theta", "error", "leverage", "forgetting_factor", "skipped", "memory"];

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
            one(bank, (record, time.as_deref_mut()), k, outputs).map_err(|error| (k, error))?;
        }
        pause.after(taken.max(1)).map_err(|error| (k, error))?;
        k += taken.max(1);
    }
    Ok(())
}

/// Takes the sample at `k`, or leaves it out; why it was not used, if it was not.
pub(crate) fn one<T: Number>(
    bank: &mut Bank<T>,
    (record, time): (&Record<'_, T>, Option<&mut RecordTime<'_>>),
    k: usize,
    outputs: &mut Outputs<T>,
) -> Result<Option<Skip>, forgetting::Error> {
    let Sizes { parameters: n, rows: p, targets: m, .. } = record.sizes;
    let phi = &record.phi[k * p * n..(k + 1) * p * n];
    let y = &record.y[k * p * m..(k + 1) * p * m];
    outputs.note_weights(bank);
    let skipped = if record.missing == Missing::Skip && is_missing(phi, y) {
        outputs.note_missing(p * m);
        Some(Skip::Missing)
    } else {
        let elapsed = time.map_or(Ok(T::ONE), |time| time.elapsed(k))?;
        let update = bank.update_after(elapsed, phi, y, record.noise.at(k, p))?;
        outputs.note(&update);
        update.skipped
    };
    outputs.note_state(bank);
    Ok(skipped)
}
