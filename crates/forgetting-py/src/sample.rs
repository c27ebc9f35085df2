//! One sample in one call.

use crate::arrays::{with_slice, Array, Number};
use crate::errors::raise;
use crate::update::Update;
use forgetting::parameter::{Kind, Parameter};
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
    let copies = calls_python(estimator);
    let mut update = |noise: Noise<'_, T>| {
        with_slice("phi", phi, |phi: &[T]| {
            with_slice("y", y, |y: &[T]| {
                let update = if copies {
                    estimator.update_weighted(&phi.to_vec(), &y.to_vec(), noise)
                } else {
                    estimator.update_weighted(phi, y, noise)
                };
                Ok(Update::new(&update.map_err(raise)?, rows, targets))
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

/// Whether an update may run Python code, which could change the arrays it was given.
fn calls_python<T: Number>(estimator: &AnyEstimator<T>) -> bool {
    let is_function = |parameter: &Parameter| parameter.kind == Kind::Function;
    estimator.rule().about().parameters.iter().any(is_function)
        || estimator.rate().about().parameters.iter().any(is_function)
}
