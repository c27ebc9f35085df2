//! A whole record in one call, without Python in the loop.

use crate::arrays::{contiguous, Array, Number};
use crate::callable::calls_python;
use crate::errors::{invalid, raise_at};
use crate::outputs::{Outputs, Run, Sizes};
use forgetting::saved::AnyEstimator;
use forgetting::Outcome;
use forgetting::{Error, Memory, Noise};
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use std::borrow::Cow;

/// Γ of a record: the same for all samples, or one a sample.
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

/// All samples of a record, without the interpreter.
pub fn run<T: Number>(
    py: Python<'_>,
    estimator: &mut AnyEstimator<T>,
    (phi, y, gamma): (Array<'_, '_>, Array<'_, '_>, Option<Array<'_, '_>>),
    outputs: &[String],
    skip: bool,
) -> PyResult<Run> {
    let memory = estimator.prior().memory();
    let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
    let phi = contiguous::<T>("phi", phi)?.readonly();
    let y = contiguous::<T>("y", y)?.readonly();
    let gamma = gamma.map(|gamma| contiguous::<T>("gamma", gamma)).transpose()?;
    let gamma = gamma.as_ref().map(|gamma| gamma.readonly());
    let samples = phi.as_array().shape().first().copied().unwrap_or(0);
    check_shape("phi", phi.as_array().shape(), samples, &[p, n])?;
    check_shape("y", y.as_array().shape(), samples, &[p, m])?;
    let sizes = Sizes { samples, parameters: n, rows: p, targets: m };
    let mut outputs = Outputs::<T>::named(outputs, sizes)?;
    let copy = calls_python(estimator);
    let (phi, y) = (slice(T::wrap(phi.as_slice()?), copy), slice(T::wrap(y.as_slice()?), copy));
    let elements = match &gamma {
        None => Cow::default(),
        Some(gamma) => slice(T::wrap(gamma.as_slice()?), copy),
    };
    let noise = match &gamma {
        None => RecordNoise::Unit,
        Some(gamma) => read_noise(gamma.as_array().shape(), &elements, samples, p)?,
    };
    outputs.prepare(estimator);
    let outcome = py.detach(|| update_all(estimator, &phi, &y, &noise, skip, &mut outputs));
    estimator.keep_innovations(false);
    estimator.keep_prior(false);
    outcome?;
    outputs.finish(py, sizes)
}

/// The slice, or a copy of it.
fn slice<T: Number>(values: &[T], copy: bool) -> Cow<'_, [T]> {
    if copy {
        Cow::Owned(values.to_vec())
    } else {
        Cow::Borrowed(values)
    }
}

/// Refuses a shape other than `samples` times `sample`, dimensions of 1 left out or not.
fn check_shape(name: &str, shape: &[usize], samples: usize, sample: &[usize; 2]) -> PyResult<()> {
    let elided = |s: &[usize]| s.iter().copied().filter(|&d| d != 1).collect::<Vec<_>>();
    let fits = shape.first() == Some(&samples)
        && elided(&shape[1..]) == elided(sample)
        && shape.len() <= 3;
    if fits {
        return Ok(());
    }
    let [p, n] = sample;
    Err(invalid(format!("{name} has shape {shape:?}, expected ({samples}, {p}, {n}) or less ones")))
}

fn read_noise<'a, T: Number>(
    shape: &[usize],
    gamma: &'a [T],
    samples: usize,
    p: usize,
) -> PyResult<RecordNoise<'a, T>> {
    match *shape {
        [] => Ok(RecordNoise::Scalar(gamma[0])),
        [t] if t == samples => Ok(RecordNoise::Scalars(gamma)),
        [a, b] if (a, b) == (p, p) => Ok(RecordNoise::Full(gamma)),
        [t, a, b] if (t, a, b) == (samples, p, p) => Ok(RecordNoise::Fulls(gamma)),
        _ => Err(invalid(format!(
            "gamma has shape {shape:?}, expected (), ({p}, {p}), ({samples},) or \
             ({samples}, {p}, {p})"
        ))),
    }
}

/// Updates `estimator` with every sample; on an error it is as it was before the first.
fn update_all<T: Number>(
    estimator: &mut AnyEstimator<T>,
    phi: &[T],
    y: &[T],
    noise: &RecordNoise<'_, T>,
    skip_missing: bool,
    outputs: &mut Outputs<T>,
) -> PyResult<()> {
    estimator
        .all_or_nothing(|estimator| samples(estimator, phi, y, noise, skip_missing, outputs))
        .map_err(|(sample, error)| raise_at(error, Some(sample)))
}

fn samples<T: Number>(
    estimator: &mut AnyEstimator<T>,
    phi: &[T],
    y: &[T],
    noise: &RecordNoise<'_, T>,
    skip_missing: bool,
    outputs: &mut Outputs<T>,
) -> Result<(), (usize, Error)> {
    let memory = estimator.prior().memory();
    let (n, p, m) = (memory.parameters(), memory.rows(), memory.targets());
    let missing = |values: &[T]| values.iter().any(|x| x.to_f64().is_nan());
    let (count, mut k) = (y.len() / (p * m), 0);
    while k < count {
        let taken = several(estimator, &phi[k * p * n..], &y[k * p * m..], noise, outputs);
        if taken > 0 {
            k += taken;
            continue;
        }
        let (phi, y) = (&phi[k * p * n..(k + 1) * p * n], &y[k * p * m..(k + 1) * p * m]);
        if skip_missing && (missing(phi) || missing(y)) {
            outputs.note_missing(p * m);
            outputs.note_prior(estimator, true);
        } else {
            let update =
                estimator.update_with_noise(phi, y, noise.at(k, p)).map_err(|error| (k, error))?;
            outputs.note(&update);
            outputs.note_prior(estimator, false);
        }
        outputs.note_state(estimator);
        k += 1;
    }
    Ok(())
}

/// As many samples as the estimator takes in one go, none where an output needs more of each.
fn several<T: Number>(
    estimator: &mut AnyEstimator<T>,
    phi: &[T],
    y: &[T],
    noise: &RecordNoise<'_, T>,
    outputs: &mut Outputs<T>,
) -> usize {
    const MOST: usize = 64;
    if !matches!(noise, RecordNoise::Unit) || outputs.need_every_state() {
        return 0;
    }
    let mut told = [Outcome::default(); MOST];
    let (most, n) = (MOST.min(y.len()), estimator.theta().len());
    let taken = outputs
        .with_thetas((most, n), |thetas| estimator.update_many(phi, y, &mut told[..most], thetas));
    outputs.note_all(estimator, &told[..taken]);
    taken
}
