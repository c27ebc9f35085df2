//! The class `RLS`.

use crate::arrays::{output, output_or_float, Input};
use crate::bounds::{BoundsInput, Pair};
use crate::errors::{heed_signals, raise};
use crate::prediction::interval;
use crate::run::Run;
use crate::settings::{
    names, read_choices, read_optional, view, with_factor, write_description, write_health, Dtype,
    Names, Whole,
};
use crate::shared::Shared;
use crate::time::{read_elapsed, read_times, times_input};
use crate::update::Update;
use forgetting_runtime::{
    size, Estimator, Missing, NumberType, RunOptions, Settings, UpdateOptions,
};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyType};

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

    /// How far the estimate can be trusted now.
    ///
    /// Parameters
    /// ----------
    /// exact : bool, default False
    ///     Eigenvalues of P themselves, in O(n**3); else bounds from its factor, in O(n).
    ///
    /// Returns
    /// -------
    /// Health
    #[pyo3(signature = (exact=false))]
    fn health<'py>(slf: &Bound<'py, Self>, exact: bool) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("forgetting.health")?.call_method1("health_of", (slf, exact))
    }

    /// What the monitor has seen, as a dictionary; None without one.
    fn watched<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let health = self.estimator.lock(py)?.health();
        health.map(|health| write_health(py, health)).transpose()
    }

    /// The rule, rate, weighting and gate by name, each with its parameters.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let description = self.estimator.lock(py)?.describe();
        write_description(py, &description)
    }

    /// The forgetting rule, as an object that would make the same one.
    #[getter]
    fn rule<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("forgetting.choices")?
            .call_method1("rule_from_description", (self.describe(py)?, self.dtype()))
    }

    /// The weighting, as an object that would make the same one.
    #[getter]
    fn weighting<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("forgetting.choices")?
            .call_method1("weighting_from_description", (self.describe(py)?, self.dtype()))
    }

    /// The gate, as an object that would make the same one.
    #[getter]
    fn gate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("forgetting.choices")?
            .call_method1("gate_from_description", (self.describe(py)?, self.dtype()))
    }

    /// phi @ theta; with a level the interval that holds the next measurement, too.
    ///
    /// Parameters
    /// ----------
    /// phi : (n,) or (T, n) array
    /// level : float, optional
    ///     Share of measurements that the interval holds, between 0 and 1; see `forgetting.predict`.
    /// errors : (T,) array, optional
    ///     One-step errors so far, of which the interval is then made.
    ///
    /// Returns
    /// -------
    /// float, (targets,), (T,) or (T, targets); with a level a `Prediction` of three
    #[pyo3(signature = (phi, level=None, *, errors=None))]
    fn predict<'py>(
        slf: &Bound<'py, Self>,
        phi: &Bound<'py, PyAny>,
        level: Option<&Bound<'py, PyAny>>,
        errors: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if let Some(level) = level {
            return interval(slf, phi, level, errors);
        }
        let (py, this) = (slf.py(), slf.get());
        let phi = Input::read("phi", phi, this.number_type)?;
        let estimator = this.estimator.lock(py)?;
        output_or_float(py, estimator.predict(phi.view("phi")?).map_err(raise)?)
    }

    /// Take one sample.
    ///
    /// Parameters
    /// ----------
    /// phi : (n,) or (rows, n) array
    /// y : float, (rows,), (targets,) or (rows, targets) array
    /// gamma : float or (rows, rows) array, optional
    ///     Noise covariance of the sample, positive definite; 1 if not given.
    /// elapsed : float or duration, optional
    ///     Time since the last sample, in the unit of time in which forgetting is stated (a duration
    ///     counts in seconds); 1 if not given. A forgetting factor becomes its power, at least 1/1024,
    ///     and process noise a multiple.
    /// missing : {"error", "skip"}
    ///     What to do with a sample that has a NaN: refuse it, or leave it out.
    ///
    /// Returns
    /// -------
    /// Update
    ///
    /// Raises
    /// ------
    /// InvalidInput
    ///     For a wrong shape, NaN or Inf, or a gamma that is not positive definite.
    /// NumericalRange
    ///     When the sample is too large. In either case nothing has changed. A covariance that has no
    ///     room to grow any more stays: `rank` is 0, and `windup` true.
    #[pyo3(signature = (phi, y, gamma=None, *, elapsed=None, missing="error"))]
    fn update(
        &self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
        elapsed: Option<&Bound<'_, PyAny>>,
        missing: &str,
    ) -> PyResult<Update> {
        let (phi, y) = (self.input("phi", phi)?, self.input("y", y)?);
        let gamma = gamma.map(|gamma| self.input("gamma", gamma)).transpose()?;
        let missing = Missing::named(missing).map_err(raise)?;
        let options = UpdateOptions { elapsed: read_elapsed(elapsed)?, missing };
        let mut estimator = self.estimator.lock(py)?;
        let (phi, y, gamma) = (phi.view("phi")?, y.view("y")?, view("gamma", &gamma)?);
        estimator.update_with((phi, y, gamma), options).map(Update).map_err(raise)
    }

    /// Take a whole record, without Python in the loop and without holding the interpreter.
    ///
    /// Equal to one `update` a sample: bit for bit up to ten parameters, to rounding above, where
    /// several samples are taken together.
    ///
    /// Parameters
    /// ----------
    /// phi : (T, n) or (T, rows, n) array
    /// y : (T,), (T, rows), (T, targets) or (T, rows, targets) array
    /// gamma : float, (rows, rows), (T,) or (T, rows, rows) array, optional
    ///     Noise covariance, the same for all samples or one a sample.
    /// outputs : str or sequence of str, optional
    ///     What to keep: names of attributes of `Run`.
    /// missing : {"error", "skip"}
    ///     What to do with a sample that has a NaN: refuse the record, or leave the sample out.
    /// time : (T,) or (T + 1,) array of numbers or dates, optional
    ///     When samples were taken, not decreasing, with the time of the last sample before them or
    ///     without; see `elapsed` of `update`. If not given, each sample takes one unit of time. A
    ///     sample that is left out takes none: its time is the next one's.
    /// bounds : pair of (n,) array, optional
    ///     Smallest and largest value of each parameter, -inf and inf where there is none. After each
    ///     sample theta is moved to the nearest point within them, as by
    ///     ``est.theta = bounded(est.theta, est.covariance, lower, upper)``, and goes on from there:
    ///     for true parameters within the bounds the error, weighed by P⁻¹, never rises by that.
    ///     Of estimators with one target.
    ///
    /// Returns
    /// -------
    /// Run
    ///
    /// Raises
    /// ------
    /// InvalidInput, NumericalRange
    ///     Names the sample and what is wrong with it; the estimator is as it was before the
    ///     record.
    ///
    /// Examples
    /// --------
    /// >>> import numpy as np
    /// >>> import forgetting as fg
    /// >>> phi = np.array([[1.0, 0.5], [1.0, 0.6], [1.0, 0.4]])
    /// >>> run = fg.RLS(2, rule="none").run(phi, [-1.0, 2.0, 1.0], bounds=([0.0, 0.0], [1.0, 1.0]))
    /// >>> bool((run.theta >= 0.0).all() and (run.theta <= 1.0).all())
    /// True
    #[pyo3(signature = (phi, y, gamma=None, outputs=None, missing="error", *, time=None, bounds=None))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn run(
        &self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
        outputs: Option<Names>,
        missing: &str,
        time: Option<&Bound<'_, PyAny>>,
        bounds: Option<Pair<'_>>,
    ) -> PyResult<Run> {
        let missing = Missing::named(missing).map_err(raise)?;
        let bounds = BoundsInput::read(bounds.as_ref())?;
        let (phi, y) = (self.input("phi", phi)?, self.input("y", y)?);
        let gamma = gamma.map(|gamma| self.input("gamma", gamma)).transpose()?;
        let times = read_times(time)?;
        let times = times_input(&times)?;
        let mut held = self.estimator.lock(py)?;
        let record = (phi.view("phi")?, y.view("y")?, view("gamma", &gamma)?);
        let (estimator, outputs) = (&mut *held, names(outputs.as_ref()));
        let mut options = RunOptions::new(missing, outputs.as_deref());
        options.time = view("time", &times)?;
        options.bounds = bounds.as_ref().map(BoundsInput::view).transpose()?;
        let run = py.detach(|| estimator.run_while(record, &options, &mut heed_signals));
        Run::new(py, run.map_err(raise)?)
    }

    /// Back to the initial estimate and covariance, as if no sample had been seen.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.estimator.lock(py)?.reset();
        Ok(())
    }

    /// The estimator, configuration and state, as bytes: portable, versioned and checked.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.estimator.lock(py)?.to_bytes().map_err(raise)?))
    }

    /// The estimator that `to_bytes` saved, bit for bit.
    #[classmethod]
    fn from_bytes(_: &Bound<'_, PyType>, state: &[u8]) -> PyResult<Self> {
        Ok(Self::of(Estimator::from_bytes(state).map_err(raise)?))
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = slf.getattr("from_bytes")?;
        Ok((restore, (slf.get().to_bytes(slf.py())?,)))
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py).map(Self::of)
    }

    fn __deepcopy__(&self, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.__copy__(memo.py())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let rule = self.rule(py)?.repr()?;
        let (n, p, m) = (self.parameters(), self.rows(), self.targets());
        let samples = self.samples(py)?;
        Ok(format!("RLS({n}, rule={rule}, rows={p}, targets={m}) after {samples} samples"))
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
