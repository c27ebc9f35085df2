//! What an estimator holds, as arrays.

use crate::error::Error;
use crate::number::{Array, Number, View};
use forgetting::memory::zeros;
use forgetting::{AnyEstimator, Memory};

pub(super) fn theta<T: Number>(estimator: &AnyEstimator<T>) -> Array {
    let memory = estimator.prior().memory();
    let (n, m) = (memory.parameters(), memory.targets());
    if m == 1 {
        return T::array(estimator.theta().to_vec(), &[n]);
    }
    let mut theta = Vec::with_capacity(n * m);
    by_parameter(estimator, &mut theta);
    T::array(theta, &[n, m])
}

/// Appends θ, the m numbers of the first parameter first.
pub(super) fn by_parameter<T: Number>(estimator: &AnyEstimator<T>, numbers: &mut Vec<T>) {
    let memory = estimator.prior().memory();
    let (n, m) = (memory.parameters(), memory.targets());
    let theta = estimator.theta();
    numbers.extend((0..n).flat_map(|i| (0..m).map(move |t| theta[t * n + i])));
}

pub(crate) fn covariance<T: Number>(estimator: &AnyEstimator<T>) -> Result<Array, Error> {
    let factor = estimator.express(estimator.factor());
    let n = factor.parameters();
    let mut dense: Vec<T> = zeros(n * n)?;
    factor.reconstruct(&mut dense);
    Ok(T::array(dense, &[n, n]))
}

/// The largest and the smallest element of D, in the units of the user.
pub(crate) fn extremes<T: Number>(estimator: &AnyEstimator<T>) -> (f64, f64) {
    let units = estimator.reciprocal_units();
    let factor = estimator.factor().settled();
    let elements = factor.diagonal_elements().iter().enumerate();
    elements.fold((0.0, f64::INFINITY), |(largest, smallest), (i, &d)| {
        let unit = units.map_or(1.0, |units| units[i].to_f64());
        let d = d.to_f64() * unit * unit;
        (d.max(largest), d.min(smallest))
    })
}

/// s of these 1/s.
pub(crate) fn units<T: Number>(reciprocals: &[T]) -> Array {
    T::array(reciprocals.iter().map(|&x| T::ONE / x).collect(), &[reciprocals.len()])
}

pub(super) fn factor<T: Number>(estimator: &AnyEstimator<T>) -> Result<(Array, Array), Error> {
    let factor = estimator.express(&estimator.factor().settled());
    let n = factor.parameters();
    let mut dense: Vec<T> = zeros(n * n)?;
    for j in 0..n {
        dense[j * n + j] = T::ONE;
        for i in 0..j {
            dense[i * n + j] = factor.unit(i, j);
        }
    }
    Ok((T::array(dense, &[n, n]), T::array(factor.diagonal_elements().to_vec(), &[n])))
}

pub(super) fn predict<T: Number>(
    estimator: &AnyEstimator<T>,
    phi: View<'_>,
) -> Result<Array, Error> {
    let memory = estimator.prior().memory();
    let (n, m) = (memory.parameters(), memory.targets());
    let Some((_, regressors)) = phi.shape().split_last().filter(|(last, _)| **last == n) else {
        return Err(Error::shape("phi", phi.shape(), format!("(..., {n})")));
    };
    let phi = T::read(phi.numbers());
    let mut prediction: Vec<T> = zeros(phi.len() / n * m)?;
    estimator.predict(&phi, &mut prediction)?;
    let mut shape = regressors.to_vec();
    if m > 1 {
        shape.push(m);
    }
    Ok(Array { shape, elements: T::elements(prediction) })
}
