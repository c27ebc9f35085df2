//! The class `RLS`.

mod chosen;
mod samples;
mod saved;

use crate::arrays::{output, Input};
use crate::errors::raise;
use crate::settings::{read_choices, read_optional, view, with_factor, Dtype, Whole};
use crate::shared::Shared;
use forgetting_runtime::{size, Estimator, NumberType, Settings};
use pyo3::prelude::*;

/// Recursive least squares with generalized forgetting.
///
/// Follows theta of y = phi @ theta + noise, sample by sample (GF-RLS, Theorem 1).
///
/// Parameters
/// ----------
/// parameters : int
///     Number n of parameters of each target.
/// rule : str or Rule, optional
///     Where to forget; see `forgetting.rules()`. If not given, `RandomWalk(0.003, bound=1e5)`;
///     `Subspace(0.99)` where an initial covariance is given.
/// forgetting_factor : float or Rate, optional
///     How much to forget, in the place of the rule's; of `Subspace` if no rule is given.
/// weighting : str or Weighting, optional
///     How far to trust a sample, by its innovation; see `forgetting.weightings()`.
/// gate : str, Gate or callable, optional
///     Whether a sample is used; see `forgetting.gates()`. A callable is shown the `Evidence` of
///     each sample and answers "update", "freeze" (learn, but forget nothing) or "hold" (do
///     nothing).
/// rows : int, default 1
///     Measurements a sample that share one theta.
/// targets : int, default 1
///     Parameter vectors that share phi and one covariance.
/// initial_covariance : float, (n,) or (n, n) array, optional
///     P before the first sample, positive definite, in units of 1/phi**2. If not given, each
///     regressor is measured in units of its typical size so far, and P is 1e5 in these: no
///     prediction then depends on the units of phi or y, and what a rule, a rate or a gate is told
///     (a threshold, a process noise, an information matrix) is in these units, too.
/// initial_theta : (n,) or (n, targets) array, optional
///     Estimate before the first sample; 0 if not given.
/// dtype : {"float64", "float32"} or NumPy type
///     Type of all numbers.
/// monitor : bool, default False
///     Watch for windup, excitation, noise and whiteness, see `health`; costs O(n) a sample.
///
/// Raises
/// ------
/// InvalidInput
///     Names the parameter, its value and what is allowed.
///
/// Examples
/// --------
/// >>> import forgetting as fg
/// >>> est = fg.RLS(2, rule=fg.Subspace(0.98, threshold=1e-3))
/// >>> for k in range(100):
/// ...     u = est.update([1.0, k % 7], 3.0 + 0.5 * (k % 7))
/// >>> est.theta.round(2)
/// array([3. , 0.5])
///
/// Notes
/// -----
/// Threads may share an estimator: each call waits for the one before it, without holding the
/// interpreter. Only a function that an estimator itself calls cannot use it.
#[pyclass(frozen, name = "RLS", module = "forgetting")]
pub struct Rls {
    pub(crate) estimator: Shared<Estimator>,
    /// n, p and m
    sizes: [usize; 3],
    number_type: NumberType,
    calls_function: bool,
}

#[pymethods]
impl Rls {
    #[new]
    #[pyo3(signature = (parameters, *, rule=None, forgetting_factor=None, weighting=None, gate=None,
        rows=Whole(1), targets=Whole(1), initial_covariance=None, initial_theta=None, dtype=Dtype::DEFAULT, monitor=false),
        text_signature = "(parameters, *, rule=None, forgetting_factor=None, weighting=None, gate=None, \
        rows=1, targets=1, initial_covariance=None, initial_theta=None, dtype='float64', monitor=False)")]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        parameters: Whole,
        rule: Option<&Bound<'_, PyAny>>,
        forgetting_factor: Option<&Bound<'_, PyAny>>,
        weighting: Option<&Bound<'_, PyAny>>,
        gate: Option<&Bound<'_, PyAny>>,
        rows: Whole,
        targets: Whole,
        initial_covariance: Option<&Bound<'_, PyAny>>,
        initial_theta: Option<&Bound<'_, PyAny>>,
        dtype: Dtype,
        monitor: bool,
    ) -> PyResult<Self> {
        let number_type = dtype.0;
        let covariance = read_optional("initial_covariance", initial_covariance, number_type)?;
        let theta = read_optional("initial_theta", initial_theta, number_type)?;
        let choices = read_choices(parameters, rule, weighting, gate)?;
        let choices = with_factor(choices, forgetting_factor)?;
        let settings = Settings {
            rows: size("rows", rows.0).map_err(raise)?,
            targets: size("targets", targets.0).map_err(raise)?,
            number_type,
            initial_covariance: view("initial_covariance", &covariance)?,
            initial_theta: view("initial_theta", &theta)?,
            monitor,
            ..choices
        };
        Ok(Self::of(Estimator::new(&settings).map_err(raise)?))
    }

    /// Number n of parameters of each target.
    #[getter]
    fn parameters(&self) -> usize {
        self.sizes[0]
    }

    /// Measurements a sample that share one theta.
    #[getter]
    fn rows(&self) -> usize {
        self.sizes[1]
    }

    /// Parameter vectors that share phi and one covariance.
    #[getter]
    fn targets(&self) -> usize {
        self.sizes[2]
    }

    /// Name of the number type.
    #[getter]
    fn dtype(&self) -> &'static str {
        self.number_type.name()
    }

    /// Samples used since the start; skipped ones do not count.
    #[getter]
    fn samples(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.estimator.lock(py)?.samples())
    }

    /// The estimate, (n,) or (n, targets).
    #[getter]
    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.estimator.lock(py)?.theta())
    }

    #[setter]
    fn set_theta(&self, theta: &Bound<'_, PyAny>) -> PyResult<()> {
        let input = self.input("theta", theta)?;
        self.estimator.lock(theta.py())?.set_theta(input.view("theta")?).map_err(raise)
    }

    /// The constant forgetting factor; None where a rate chooses it, or the rule uses none.
    #[getter]
    fn forgetting_factor(&self, py: Python<'_>) -> PyResult<Option<f64>> {
        Ok(self.estimator.lock(py)?.forgetting_factor())
    }

    #[setter]
    fn set_forgetting_factor(&self, py: Python<'_>, factor: f64) -> PyResult<()> {
        self.estimator.lock(py)?.set_forgetting_factor(factor).map_err(raise)
    }

    /// The covariance P, (n, n), in units of 1/phi**2: times the noise variance, it is that of
    /// the estimate.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.estimator.lock(py)?.covariance().map_err(raise)?)
    }

    /// The units (n,) in which regressors are measured, 1 for one that has always been 0; None where an
    /// initial covariance was given.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.estimator.lock(py)?.units().map(|units| output(py, units)).transpose()
    }

    /// The factor of the covariance: U (n, n) unit upper triangular and D (n,) positive, with
    /// P = U @ diag(D) @ U.T.
    fn factor<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let (unit, diagonal) = self.estimator.lock(py)?.factor().map_err(raise)?;
        Ok((output(py, unit)?, output(py, diagonal)?))
    }

    /// The largest and the smallest element of D, for `health`: O(n).
    #[pyo3(name = "_extremes")]
    fn extremes(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        Ok(self.estimator.lock(py)?.extremes())
    }
}

impl Rls {
    /// With this estimator.
    pub fn of(estimator: Estimator) -> Self {
        Self {
            sizes: [estimator.parameters(), estimator.rows(), estimator.targets()],
            number_type: estimator.number_type(),
            calls_function: estimator.calls_function(),
            estimator: Shared::new(estimator),
        }
    }

    /// A copy of the estimator.
    pub fn copy(&self, py: Python<'_>) -> PyResult<Estimator> {
        self.estimator.lock(py)?.copy().map_err(raise)
    }

    /// Numbers for a sample or a record: copied if Python code runs while they are read.
    #[inline(always)]
    fn input<'a, 'py>(
        &self,
        name: &str,
        values: &'a Bound<'py, PyAny>,
    ) -> PyResult<Input<'a, 'py>> {
        Input::read_or_copy(name, values, self.number_type, self.calls_function)
    }
}
