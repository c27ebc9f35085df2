//! What an estimator holds, for Python.

use crate::arrays::{shaped, with_slice, Array, Number};
use crate::choice::{shape_of, write_choice};
use crate::errors::{invalid, raise};
use forgetting::gates::Gate;
use forgetting::rates::Rate;
use forgetting::rules::Forgetting;
use forgetting::saved::AnyEstimator;
use forgetting::weightings::Weighting;
use forgetting::Memory;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat};

/// The estimate, (n,) or (n, targets).
pub fn theta<'py, T: Number>(
    py: Python<'py>,
    estimator: &AnyEstimator<T>,
) -> PyResult<Bound<'py, PyAny>> {
    let memory = estimator.prior().memory();
    let (n, m) = (memory.parameters(), memory.targets());
    let values = estimator.theta();
    if m == 1 {
        return shaped(py, values.to_vec(), &[n]);
    }
    let transposed = (0..n).flat_map(|i| (0..m).map(move |t| values[t * n + i])).collect();
    shaped(py, transposed, &[n, m])
}

/// P, (n, n).
pub fn covariance<'py, T: Number>(
    py: Python<'py>,
    estimator: &AnyEstimator<T>,
) -> PyResult<Bound<'py, PyAny>> {
    let n = estimator.factor().parameters();
    let mut dense = vec![T::ZERO; n * n];
    estimator.factor().reconstruct(&mut dense);
    shaped(py, dense, &[n, n])
}

/// U (n, n) and D (n,).
pub fn factor<'py, T: Number>(
    py: Python<'py>,
    estimator: &AnyEstimator<T>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let factor = estimator.factor();
    let n = factor.parameters();
    let mut dense = vec![T::ZERO; n * n];
    for j in 0..n {
        dense[j * n + j] = T::ONE;
        for i in 0..j {
            dense[i * n + j] = factor.unit(i, j);
        }
    }
    let diagonal = factor.diagonal_elements().to_vec();
    Ok((shaped(py, dense, &[n, n])?, shaped(py, diagonal, &[n])?))
}

/// What the monitor has seen; the names are those of the crate's `Health`.
pub fn watched<'py, T: Number>(
    py: Python<'py>,
    estimator: &AnyEstimator<T>,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(health) = estimator.health() else { return Ok(None) };
    let watched = PyDict::new(py);
    let n = health.direction.len();
    watched.set_item("windup", health.windup)?;
    watched.set_item("informed", health.informed)?;
    watched.set_item("direction", shaped(py, health.direction.to_vec(), &[n])?)?;
    let least = health.least_variances.to_vec();
    watched.set_item("least_variances", shaped(py, least, &[n])?)?;
    watched.set_item("variance", health.variance.to_f64())?;
    watched.set_item("growth", health.growth.to_f64())?;
    watched.set_item("since_informed", health.since_informed)?;
    let silence = health.since_excited.iter().map(|&age| age.to_f64() as i64).collect();
    watched.set_item("since_excited", shaped::<i64>(py, silence, &[n])?)?;
    watched.set_item("samples", health.samples)?;
    watched.set_item("block", health.block.to_f64())?;
    watched.set_item("noise_variance", health.noise_variance.to_f64())?;
    watched.set_item("correlation", health.correlation.to_f64())?;
    watched.set_item("weight", health.weight.to_f64())?;
    Ok(Some(watched))
}

/// Rule, rate, weighting and gate by name, each with its parameters.
pub fn describe<'py, T: Number>(
    py: Python<'py>,
    estimator: &AnyEstimator<T>,
) -> PyResult<Bound<'py, PyDict>> {
    let description = PyDict::new(py);
    let (rule, rate, weighting) = (estimator.rule(), estimator.rate(), estimator.weighting());
    let of_rule = write_choice(py, rule.about().name, |each| {
        rule.describe(&mut |name, value| each(name, value))
    })?;
    description.set_item("rule", of_rule)?;
    let of_rate = write_choice(py, rate.about().name, |each| {
        rate.describe(&mut |name, value| each(name, value))
    })?;
    description.set_item("rate", of_rate)?;
    let of_weighting = write_choice(py, weighting.about().name, |each| {
        weighting.describe(&mut |name, value| each(name, value))
    })?;
    description.set_item("weighting", of_weighting)?;
    let gate = estimator.gate();
    let of_gate = write_choice(py, gate.about().name, |each| {
        gate.describe(&mut |name, value| each(name, value))
    })?;
    description.set_item("gate", of_gate)?;
    Ok(description)
}

/// phi @ theta for one regressor or many.
pub fn predict<'py, T: Number>(
    py: Python<'py>,
    estimator: &AnyEstimator<T>,
    phi: Array<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let memory = estimator.prior().memory();
    let (n, m) = (memory.parameters(), memory.targets());
    let mut shape = shape_of("phi", phi)?;
    if shape.last() != Some(&n) {
        return Err(invalid(format!("phi has shape {shape:?}, expected (..., {n})")));
    }
    shape.pop();
    with_slice("phi", phi, |phi: &[T]| {
        let mut prediction = vec![T::ZERO; phi.len() / n * m];
        estimator.predict(phi, &mut prediction).map_err(raise)?;
        if m > 1 {
            shape.push(m);
        }
        match (shape.as_slice(), prediction.as_slice()) {
            ([], [y]) => Ok(PyFloat::new(py, y.to_f64()).into_any()),
            _ => shaped(py, prediction, &shape),
        }
    })
}
