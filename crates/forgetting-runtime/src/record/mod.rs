//! A whole record in one call, all or nothing.

mod outputs;
mod run;
mod shapes;

pub use run::Run;

use crate::number::Number;
use crate::{Error, View};
use forgetting::saved::AnyEstimator;
use forgetting::{Noise, Outcome};
use outputs::Outputs;
use shapes::{read_noise, Sizes};

/// What is done with a sample that has a NaN.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// the record is refused
    Error,
    /// the sample is left out
    Skip,
}

impl Missing {
    /// The one that `error` or `skip` names.
    ///
    /// # Errors
    /// [`Error::Word`] names `missing`.
    pub fn named(word: &str) -> Result<Self, Error> {
        match word {
            "error" => Ok(Self::Error),
            "skip" => Ok(Self::Skip),
            _ => Err(Error::word("missing", word, &["error", "skip"])),
        }
    }
}

/// Γ of a record: the same for all samples, or one a sample.
#[derive(Clone, Copy)]
enum RecordNoise<'a, T> {
    Unit,
    Scalar(T),
    Full(&'a [T]),
    Scalars(&'a [T]),
    Fulls(&'a [T]),
}

impl<T: Number> RecordNoise<'_, T> {
    fn at(&self, sample: usize, rows: usize) -> Noise<'_, T> {
        match self {
            Self::Unit => Noise::Unit,
            Self::Scalar(gamma) => Noise::Scalar(*gamma),
            Self::Full(gamma) => Noise::Full(gamma),
            Self::Scalars(gammas) => Noise::Scalar(gammas[sample]),
            Self::Fulls(gammas) => {
                Noise::Full(&gammas[sample * rows * rows..(sample + 1) * rows * rows])
            }
        }
    }
}

/// The samples of a record.
struct Record<'a, T> {
    sizes: Sizes,
    phi: &'a [T],
    y: &'a [T],
    noise: RecordNoise<'a, T>,
    missing: Missing,
}

/// Updates `estimator` with every sample; on an error it is as it was before the first.
pub(crate) fn run<T: Number>(
    estimator: &mut AnyEstimator<T>,
    (phi, y, gamma): (View<'_>, View<'_>, Option<View<'_>>),
    missing: Missing,
    outputs: &[&str],
) -> Result<Run, Error> {
    let sizes = Sizes::of(estimator.prior().memory(), &phi, &y)?;
    let mut outputs = Outputs::<T>::named(outputs, sizes)?;
    let (phi, y) = (T::read(phi.numbers()), T::read(y.numbers()));
    let gammas = gamma.map(|gamma| T::read(gamma.numbers()));
    let noise = match (&gamma, &gammas) {
        (Some(gamma), Some(gammas)) => read_noise(gamma.shape(), gammas, sizes)?,
        _ => RecordNoise::Unit,
    };
    let record = Record { sizes, phi: &phi, y: &y, noise, missing };
    outputs.prepare(estimator);
    let taken = estimator.all_or_nothing(|estimator| take(estimator, &record, &mut outputs));
    estimator.keep_innovations(false);
    estimator.keep_prior(false);
    taken.map_err(|(sample, error)| Error::Sample { sample, error })?;
    Ok(outputs.finish(sizes))
}

fn take<T: Number>(
    estimator: &mut AnyEstimator<T>,
    record: &Record<'_, T>,
    outputs: &mut Outputs<T>,
) -> Result<(), (usize, forgetting::Error)> {
    let &Record { sizes: Sizes { samples, parameters: n, rows: p, targets: m }, .. } = record;
    let is_missing = |values: &[T]| values.iter().any(|x| x.to_f64().is_nan());
    let mut k = 0;
    while k < samples {
        let taken = several(estimator, record, k, outputs);
        if taken > 0 {
            k += taken;
            continue;
        }
        let phi = &record.phi[k * p * n..(k + 1) * p * n];
        let y = &record.y[k * p * m..(k + 1) * p * m];
        if record.missing == Missing::Skip && (is_missing(phi) || is_missing(y)) {
            outputs.note_missing(p * m);
            outputs.note_prior(estimator, true);
        } else {
            let update = estimator.update_with_noise(phi, y, record.noise.at(k, p));
            outputs.note(&update.map_err(|error| (k, error))?);
            outputs.note_prior(estimator, false);
        }
        outputs.note_state(estimator);
        k += 1;
    }
    Ok(())
}

/// Takes as many samples from the one at `first` on as the estimator can take together, none where
/// an output needs more of each; returns how many.
fn several<T: Number>(
    estimator: &mut AnyEstimator<T>,
    record: &Record<'_, T>,
    first: usize,
    outputs: &mut Outputs<T>,
) -> usize {
    const MOST: usize = 64;
    if !matches!(record.noise, RecordNoise::Unit) || outputs.need_every_state() {
        return 0;
    }
    let Sizes { parameters: n, rows: p, targets: m, .. } = record.sizes;
    let (phi, y) = (&record.phi[first * p * n..], &record.y[first * p * m..]);
    let mut outcomes = [Outcome::default(); MOST];
    let most = MOST.min(y.len());
    let taken = outputs.with_thetas((most, estimator.theta().len()), |thetas| {
        estimator.update_many(phi, y, &mut outcomes[..most], thetas)
    });
    outputs.note_all(estimator, &outcomes[..taken]);
    taken
}
