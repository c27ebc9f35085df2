//! One sample in one call.

use crate::arrays::{owned, with_slice, Array, Number};
use crate::callable::calls_python;
use crate::errors::raise;
use crate::update::Update;
use forgetting::saved::AnyEstimator;
use forgetting::{Memory, Noise};
use pyo3::prelude::*;

/// One sample.
#[inline]
pub fn update<T: Number>(
    estimator: &mut AnyEstimator<T>,
    phi: Array<'_, '_>,
    y: Array<'_, '_>,
    gamma: Option<Array<'_, '_>>,
) -> PyResult<Update> {
    let memory = estimator.prior().memory();
    let (rows, targets) = (memory.rows(), memory.targets());
    if rows > 1 {
        estimator.keep_innovations(true);
    }
    if calls_python(estimator) {
        let (phi, y) = (owned("phi", phi)?, owned("y", y)?);
        let gamma = gamma.map(|gamma| owned("gamma", gamma)).transpose()?;
        let noise = gamma.as_deref().map_or(Noise::Unit, noise);
        let update = estimator.update_with_noise(&phi, &y, noise).map_err(raise)?;
        return Update::new(&update, rows, targets);
    }
    let mut update = |noise: Noise<'_, T>| {
        with_slice("phi", phi, |phi: &[T]| {
            with_slice("y", y, |y: &[T]| {
                let update = estimator.update_with_noise(phi, y, noise).map_err(raise)?;
                Update::new(&update, rows, targets)
            })
        })
    };
    match gamma {
        None => update(Noise::Unit),
        Some(gamma) => with_slice("gamma", gamma, |gamma| update(noise(gamma))),
    }
}

#[inline]
fn noise<T: Number>(gamma: &[T]) -> Noise<'_, T> {
    match gamma {
        [scalar] => Noise::Scalar(*scalar),
        full => Noise::Full(full),
    }
}
