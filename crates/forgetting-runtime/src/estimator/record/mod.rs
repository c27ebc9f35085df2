//! A whole record in one call, all or nothing.

mod bounds;
mod kept;
mod noise;
mod outputs;
mod pause;
mod run;
mod shapes;
mod time;

pub use bounds::Bounds;
pub use run::Run;

use crate::configure::check_copies;
use crate::error::Error;
use crate::missing::{is_missing, Missing};
use crate::number::{Number, View};
pub(crate) use bounds::RecordBounds;
use forgetting::{AnyEstimator, Outcome, Skip};
pub(crate) use kept::{arrays, push, room};
pub(crate) use noise::RecordNoise;
pub(crate) use outputs::Outputs;
pub use pause::GoOn;
pub(crate) use pause::Pause;
pub(crate) use shapes::Sizes;
pub(crate) use time::RecordTime;

/// How a record is taken.
#[derive(Clone, Copy, Debug)]
pub struct RunOptions<'a> {
    /// what is done with samples that have a NaN
    pub missing: Missing,
    /// names of what is kept; the default outputs if not given
    pub outputs: Option<&'a [&'a str]>,
    /// when samples were taken, (T,), or (T + 1,) with the time of the last sample before them: not
    /// decreasing, in the unit of time in which forgetting is stated. If not given, each sample takes
    /// one unit, as does the first of (T,).
    pub time: Option<View<'a>>,
    /// within which θ is moved after each sample, nearest in the metric of P⁻¹, to go on from there
    pub bounds: Option<Bounds<'a>>,
}

impl<'a> RunOptions<'a> {
    /// These, without times or bounds.
    #[must_use]
    pub fn new(missing: Missing, outputs: Option<&'a [&'a str]>) -> Self {
        Self { missing, outputs, time: None, bounds: None }
    }
}

/// The samples of a record.
pub(crate) struct Record<'a, T> {
    pub sizes: Sizes,
    pub phi: &'a [T],
    pub y: &'a [T],
    pub noise: RecordNoise<'a, T>,
    pub missing: Missing,
}

/// Updates `estimator` with every sample; on an error it is as it was before the first.
pub(super) fn run<T: Number>(
    estimator: &mut AnyEstimator<T>,
    (phi, y, gamma): (View<'_>, View<'_>, Option<View<'_>>),
    options: &RunOptions<'_>,
    go_on: GoOn<'_>,
) -> Result<Run, Error> {
    let sizes = Sizes::of(estimator.prior().memory(), &phi, &y)?;
    let outputs = options.outputs.unwrap_or(&Run::DEFAULT_OUTPUTS);
    let mut outputs = Outputs::<T>::named(outputs, sizes)?;
    let shape_of_y = y.shape().to_vec();
    let (phi, y) = (T::read(phi.numbers()), T::read(y.numbers()));
    let gammas = gamma.map(|gamma| T::read(gamma.numbers()));
    let noise = match (&gamma, &gammas) {
        (Some(gamma), Some(gammas)) => RecordNoise::read(gamma.shape(), gammas, sizes)?,
        _ => RecordNoise::Unit,
    };
    let mut time = options.time.map(|time| RecordTime::read(time, sizes)).transpose()?;
    let bounds = options.bounds.as_ref();
    let mut bounds = bounds.map(|bounds| RecordBounds::read(bounds, estimator)).transpose()?;
    let record = Record { sizes, phi: &phi, y: &y, noise, missing: options.missing };
    // the state of before is kept until all is done
    check_copies(estimator, 1)?;
    outputs.prepare(estimator);
    let mut pause = Pause::new(go_on, sizes.rows, sizes.parameters);
    let taken = estimator.all_or_nothing(|estimator| {
        take(estimator, (&record, time.as_mut(), bounds.as_mut()), &mut outputs, &mut pause)
    });
    estimator.keep_innovations(false);
    estimator.keep_prior(false);
    taken.map_err(|(sample, error)| Error::Sample { sample, error })?;
    Ok(outputs.finish(sizes, &shape_of_y))
}

/// The most samples that an estimator takes together.
const MOST: usize = 64;

fn take<T: Number>(
    estimator: &mut AnyEstimator<T>,
    (record, mut time, mut bounds): Sample<'_, '_, T>,
    outputs: &mut Outputs<T>,
    pause: &mut Pause<'_>,
) -> Result<(), (usize, forgetting::Error)> {
    let together = matches!(record.noise, RecordNoise::Unit)
        && !outputs.need_every_state()
        && time.is_none()
        && bounds.is_none()
        && estimator.takes_many();
    let mut outcomes = [Outcome::default(); MOST];
    let mut k = 0;
    while k < record.sizes.samples {
        let taken = if together { many(estimator, record, k, &mut outcomes, outputs) } else { 0 };
        if taken == 0 {
            one(estimator, (record, time.as_deref_mut(), bounds.as_deref_mut()), k, outputs)
                .map_err(|error| (k, error))?;
        }
        pause.after(taken.max(1)).map_err(|error| (k, error))?;
        k += taken.max(1);
    }
    Ok(())
}

/// Takes as many samples from the one at `first` on as the estimator can take together; returns
/// how many, none if it cannot use the first.
fn many<T: Number>(
    estimator: &mut AnyEstimator<T>,
    record: &Record<'_, T>,
    first: usize,
    outcomes: &mut [Outcome<T>; MOST],
    outputs: &mut Outputs<T>,
) -> usize {
    let n = record.sizes.parameters;
    let (phi, y) = (&record.phi[first * n..], &record.y[first..]);
    let most = MOST.min(y.len());
    let taken = outputs.with_thetas((most, n), |thetas| {
        estimator.update_many(phi, y, &mut outcomes[..most], thetas)
    });
    outputs.note_all(estimator, &outcomes[..taken]);
    taken
}

/// A record, when its samples were taken, and within which bounds θ is kept.
type Sample<'r, 't, T> =
    (&'r Record<'r, T>, Option<&'r mut RecordTime<'t>>, Option<&'r mut RecordBounds>);

/// Takes the sample at `k`, or leaves it out; why it was not used, if it was not.
pub(crate) fn one<T: Number>(
    estimator: &mut AnyEstimator<T>,
    (record, time, bounds): Sample<'_, '_, T>,
    k: usize,
    outputs: &mut Outputs<T>,
) -> Result<Option<Skip>, forgetting::Error> {
    let Sizes { parameters: n, rows: p, targets: m, .. } = record.sizes;
    let phi = &record.phi[k * p * n..(k + 1) * p * n];
    let y = &record.y[k * p * m..(k + 1) * p * m];
    let skipped = if record.missing == Missing::Skip && is_missing(phi, y) {
        outputs.note_missing(p * m);
        outputs.note_prior(estimator, true);
        Some(Skip::Missing)
    } else {
        let elapsed = time.map_or(Ok(T::ONE), |time| time.elapsed(k))?;
        let update = estimator.update_after(elapsed, phi, y, record.noise.at(k, p))?;
        outputs.note(&update);
        let skipped = update.skipped;
        outputs.note_prior(estimator, false);
        skipped
    };
    if let Some(bounds) = bounds {
        bounds.hold(estimator)?;
    }
    outputs.note_state(estimator);
    Ok(skipped)
}
