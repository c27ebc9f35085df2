//! One sample in one call.

use crate::arrays::{with_slice, Array, Number};
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
    let mut update = |noise: Noise<'_, T>| {
        with_slice("phi", phi, |phi: &[T]| {
            with_slice("y", y, |y: &[T]| {
                let update = estimator.update_weighted(phi, y, noise).map_err(raise)?;
                Ok(Update::new(&update, rows, targets))
            })
        })
    };
    match gamma {
        None => update(Noise::Unit),
        Some(gamma) => with_slice("gamma", gamma, |gamma| match gamma {
            [scalar] => update(Noise::Scalar(*scalar)),
            full => update(Noise::Full(full)),
        }),
    }
}
