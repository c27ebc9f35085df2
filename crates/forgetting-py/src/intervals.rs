//! The class `Intervals`, and estimates within bounds.

use crate::arrays::{output, output_or_float, Input};
use crate::errors::raise;
use crate::shared::Shared;
use forgetting_runtime::{bounded as project, check_shape, Array, Elements, Error, NumberType};
use pyo3::prelude::*;

/// The half-width of an interval about each next prediction that holds the share of errors it promises,
/// whatever they are.
///
/// It is a factor times the root of the mean square of the last hundred errors. The factor begins with
/// that of Gaussian errors, grows after each error outside and shrinks after each one inside: over many
/// samples the share inside is the level, under any drift and any distribution, in any unit
/// (adaptive conformal inference: Gibbs and Candes 2021; Angelopoulos, Candes and Tibshirani 2023).
///
/// Parameters
/// ----------
/// level : float
///     Share of errors inside, between 0 and 1.
/// rate : float, default 0.1
///     How fast the factor follows: over T samples the share inside is off by less than 5 / (rate T)
///     in most records.
/// skip : int, default 0
///     Errors at first that are not counted, such as the number of parameters.
/// factor : float, optional
///     What to begin with; that of Gaussian errors, 1.96 for 0.95, if not given.
///
/// Raises
/// ------
/// InvalidInput
///     Names the parameter, its value and what is allowed.
///
/// Examples
/// --------
/// >>> import numpy as np
/// >>> import forgetting as fg
/// >>> errors = np.random.default_rng(0).standard_t(3, size=20_000)
/// >>> intervals = fg.Intervals(0.9)
/// >>> half_widths = intervals.run(errors)
/// >>> round(intervals.coverage, 2)
/// 0.9
#[pyclass(frozen, module = "forgetting")]
pub struct Intervals(Shared<forgetting_runtime::Intervals>);

/// What `pickle` keeps of them.
type Numbers = ([f64; 5], [u64; 3]);

#[pymethods]
impl Intervals {
    #[new]
    #[pyo3(signature = (level, *, rate=0.1, skip=0, factor=None),
        text_signature = "(level, *, rate=0.1, skip=0, factor=None)")]
    fn new(
        py: Python<'_>,
        level: f64,
        rate: f64,
        skip: u64,
        factor: Option<f64>,
    ) -> PyResult<Self> {
        let gaussian = || -> PyResult<f64> {
            if !(level > 0.0 && level < 1.0) {
                return Ok(1.0); // the level is refused
            }
            let normal = py.import("statistics")?.getattr("NormalDist")?.call0()?;
            normal.call_method1("inv_cdf", (0.5 + level / 2.0,))?.extract()
        };
        let factor = factor.map_or_else(gaussian, Ok)?;
        let intervals = forgetting_runtime::Intervals::new(level, rate, factor, skip);
        intervals.map(Shared::new).map(Self).map_err(|error| raise(error.into()))
    }

    /// The half-width for the next error; NaN before there was one.
    #[getter]
    fn half_width(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.0.lock(py)?.half_width().unwrap_or(f64::NAN))
    }

    /// The root of the mean square of the last hundred errors; NaN before there was one.
    #[getter]
    fn deviation(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.0.lock(py)?.deviation().unwrap_or(f64::NAN))
    }

    /// The share of errors that were inside; NaN before the first that had an interval.
    #[getter]
    fn coverage(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.0.lock(py)?.coverage().unwrap_or(f64::NAN))
    }

    /// Take the error y - prediction; a NaN is none.
    fn update(&self, py: Python<'_>, error: f64) -> PyResult<()> {
        self.0.lock(py)?.update(error).map_err(|error| raise(error.into()))
    }

    /// Take many errors (T,); returns the half-width that each prediction had, (T,).
    ///
    /// Raises
    /// ------
    /// InvalidInput
    ///     For an infinite error, with its position; nothing has changed.
    fn run<'py>(&self, py: Python<'py>, errors: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let input = Input::read("errors", errors, NumberType::F64)?;
        let errors = input.view("errors")?;
        check_shape("errors", errors.shape(), &[errors.numbers().len()]).map_err(raise)?;
        let mut held = self.0.lock(py)?;
        let mut intervals = *held;
        let mut half_widths = Vec::with_capacity(errors.numbers().len());
        for (sample, &error) in errors.numbers().to_f64().iter().enumerate() {
            half_widths.push(intervals.half_width().unwrap_or(f64::NAN));
            intervals.update(error).map_err(|error| raise(Error::Sample { sample, error }))?;
        }
        *held = intervals;
        let shape = vec![half_widths.len()];
        output(py, Array { shape, elements: Elements::F64(half_widths) })
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        Ok(Self(Shared::new(*self.0.lock(py)?)))
    }

    fn __deepcopy__(&self, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.__copy__(memo.py())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Numbers)> {
        Ok((slf.getattr("_of")?, slf.get().0.lock(slf.py())?.numbers()))
    }

    /// Those that keep these numbers and counts.
    #[staticmethod]
    fn _of(numbers: [f64; 5], counts: [u64; 3]) -> PyResult<Self> {
        let intervals = forgetting_runtime::Intervals::from_numbers(numbers, counts);
        intervals.map(Shared::new).map(Self).map_err(|error| raise(error.into()))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let held = self.0.lock(py)?;
        let (half_width, coverage) = (held.half_width(), held.coverage());
        let number = |x: Option<f64>| x.map_or("none yet".into(), |x| format!("{x:.4}"));
        Ok(format!("Intervals(half-width {}, coverage {})", number(half_width), number(coverage)))
    }
}

/// The estimate within bounds: the point of the box that is nearest to theta in the metric of the
/// inverse of the covariance.
///
/// For true parameters inside the box the error, weighed by that metric, is at most what it was: bounds
/// never harm. Use it on what an estimator says; or go on from it by ``est.theta = bounded(...)``.
///
/// Parameters
/// ----------
/// theta : (n,) or (T, n) array
/// covariance : (n, n) or (T, n, n) array
///     Positive definite; of any scale.
/// lower, upper : (n,) array
///     -inf and inf where there is no bound.
///
/// Returns
/// -------
/// ndarray of the shape of theta
///
/// Raises
/// ------
/// InvalidInput
///     Names what does not fit, and the row.
///
/// Examples
/// --------
/// >>> import numpy as np
/// >>> import forgetting as fg
/// >>> correlated = np.array([[1.0, 0.5], [0.5, 1.0]])
/// >>> fg.bounded([-0.2, 1.0], correlated, [0.0, -np.inf], [np.inf, np.inf])
/// array([0. , 1.1])
#[pyfunction]
pub fn bounded<'py>(
    py: Python<'py>,
    theta: &Bound<'py, PyAny>,
    covariance: &Bound<'py, PyAny>,
    lower: &Bound<'py, PyAny>,
    upper: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let read = |name, values| Input::read(name, values, NumberType::F64);
    let (theta, covariance) = (read("theta", theta)?, read("covariance", covariance)?);
    let (lower, upper) = (read("lower", lower)?, read("upper", upper)?);
    let shape = theta.shape().to_vec();
    let n = shape.last().copied().unwrap_or(0);
    let rows = &shape[..shape.len().saturating_sub(1)];
    check_shape("covariance", covariance.shape(), &[rows, &[n, n]].concat()).map_err(raise)?;
    check_shape("lower", lower.shape(), &[n]).map_err(raise)?;
    check_shape("upper", upper.shape(), &[n]).map_err(raise)?;
    let (lower, upper) = (lower.numbers()?.to_f64(), upper.numbers()?.to_f64());
    let covariance = covariance.numbers()?.to_f64();
    let mut inside = theta.numbers()?.to_f64().into_owned();
    for (sample, row) in inside.chunks_mut(n.max(1)).enumerate() {
        let own = &covariance[sample * n * n..(sample + 1) * n * n];
        project(row, own, &lower, &upper).map_err(|error| {
            raise(if rows.is_empty() { error.into() } else { Error::Sample { sample, error } })
        })?;
    }
    output_or_float(py, Array { shape, elements: Elements::F64(inside) })
}
