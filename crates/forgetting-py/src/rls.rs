//! The class `RLS`.

use crate::arrays::Number;
use crate::configure::{make, read_sizes};
use crate::errors::{invalid, raise};
use crate::outputs::{Run, DEFAULT_OUTPUTS};
use crate::update::Update;
use crate::{record, results, sample};
use forgetting::saved::{number_type, AnyEstimator};
use forgetting::{Memory, Real};
use forgetting_cpu::{level, Fused, Level};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyType};

/// An estimator in one of the number types.
#[derive(Clone)]
pub enum Inner {
    Double(Box<AnyEstimator<f64>>),
    Single(Box<AnyEstimator<f32>>),
    // on a machine with fused multiply-add
    FusedDouble(Box<AnyEstimator<Fused<f64>>>),
    FusedSingle(Box<AnyEstimator<Fused<f32>>>),
}

/// The same expression for a new estimator of either precision, in the arithmetic that is fast on
/// this machine.
macro_rules! new {
    ($double:expr, $make:expr) => {
        match ($double, level() >= Level::Fused) {
            (true, false) => Inner::Double(Box::new($make)),
            (false, false) => Inner::Single(Box::new($make)),
            (true, true) => Inner::FusedDouble(Box::new($make)),
            (false, true) => Inner::FusedSingle(Box::new($make)),
        }
    };
}

/// The same expression for any number type.
macro_rules! either {
    ($inner:expr, $estimator:ident => $expression:expr) => {
        match $inner {
            Inner::Double($estimator) => $expression,
            Inner::Single($estimator) => $expression,
            Inner::FusedDouble($estimator) => $expression,
            Inner::FusedSingle($estimator) => $expression,
        }
    };
}

pub(crate) use {either, new};

/// Recursive least squares with generalized forgetting.
///
/// Follows theta of y = phi @ theta + noise, sample by sample (GF-RLS, Theorem 1).
///
/// Parameters
/// ----------
/// parameters : int
///     Number n of parameters of each target.
/// rule : str or Rule, default "subspace"
///     Where to forget; see `forgetting.rules()`.
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
/// initial_covariance : float, (n,) or (n, n) array, default 100.0
///     P before the first sample, positive definite, in units of 1/phi**2.
/// initial_theta : (n,) or (n, targets) array, optional
///     Estimate before the first sample; 0 if not given.
/// dtype : {"float64", "float32"}
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
#[pyclass(name = "RLS", module = "forgetting")]
pub struct Rls {
    pub(crate) inner: Inner,
}

#[pymethods]
impl Rls {
    #[new]
    #[pyo3(signature = (parameters, *, rule=None, weighting=None, gate=None, rows=1, targets=1,
        initial_covariance=None, initial_theta=None, dtype="float64", monitor=false))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        parameters: i64,
        rule: Option<&Bound<'_, PyAny>>,
        weighting: Option<&Bound<'_, PyAny>>,
        gate: Option<&Bound<'_, PyAny>>,
        rows: i64,
        targets: i64,
        initial_covariance: Option<&Bound<'_, PyAny>>,
        initial_theta: Option<&Bound<'_, PyAny>>,
        dtype: &str,
        monitor: bool,
    ) -> PyResult<Self> {
        let sizes = [("parameters", parameters), ("rows", rows), ("targets", targets)];
        let sizes = read_sizes(sizes)?;
        let choices = [rule, weighting, gate];
        let initial = (initial_covariance, initial_theta);
        let mut inner = match dtype {
            "float64" | "float32" => {
                new!(dtype == f64::DTYPE, make(sizes, choices, initial)?)
            }
            _ => {
                return Err(invalid(format!(
                    "dtype = {dtype:?}, allowed: \"float64\", \"float32\""
                )))
            }
        };
        if monitor {
            either!(&mut inner, e => e.watch());
        }
        Ok(Self { inner })
    }

    /// Number n of parameters of each target.
    #[getter]
    fn parameters(&self) -> usize {
        either!(&self.inner, e => e.prior().memory().parameters())
    }

    /// Measurements a sample that share one theta.
    #[getter]
    fn rows(&self) -> usize {
        either!(&self.inner, e => e.prior().memory().rows())
    }

    /// Parameter vectors that share phi and one covariance.
    #[getter]
    fn targets(&self) -> usize {
        either!(&self.inner, e => e.prior().memory().targets())
    }

    /// Name of the number type.
    #[getter]
    fn dtype(&self) -> &'static str {
        match self.inner {
            Inner::Double(_) | Inner::FusedDouble(_) => f64::DTYPE,
            Inner::Single(_) | Inner::FusedSingle(_) => f32::DTYPE,
        }
    }

    /// Samples used since the start; skipped ones do not count.
    #[getter]
    fn samples(&self) -> u64 {
        either!(&self.inner, e => e.samples())
    }

    /// The estimate, (n,) or (n, targets).
    #[getter]
    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        either!(&self.inner, e => results::theta(py, e))
    }

    /// The covariance P, (n, n), in units of 1/phi**2: times the noise variance, it is that of
    /// the estimate.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        either!(&self.inner, e => results::covariance(py, e))
    }

    /// The factor of the covariance: U (n, n) unit upper triangular and D (n,) positive, with
    /// P = U @ diag(D) @ U.T.
    fn factor<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        either!(&self.inner, e => results::factor(py, e))
    }

    /// The largest and the smallest element of D, for `health`: O(n).
    #[pyo3(name = "_extremes")]
    fn extremes(&self) -> (f64, f64) {
        either!(&self.inner, e => (e.factor().largest().to_f64(), e.factor().smallest().to_f64()))
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
        either!(&self.inner, e => results::watched(py, e))
    }

    /// The rule, rate, weighting and gate by name, each with its parameters.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        either!(&self.inner, e => results::describe(py, e))
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

    /// phi @ theta.
    ///
    /// Parameters
    /// ----------
    /// phi : (n,) or (T, n) array
    ///
    /// Returns
    /// -------
    /// float, (targets,), (T,) or (T, targets)
    fn predict<'py>(
        &self,
        py: Python<'py>,
        phi: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        either!(&self.inner, e => results::predict(py, e, phi))
    }

    /// Take one sample.
    ///
    /// Parameters
    /// ----------
    /// phi : (n,) or (rows, n) array
    /// y : float, (rows,), (targets,) or (rows, targets) array
    /// gamma : float or (rows, rows) array, optional
    ///     Noise covariance of the sample, positive definite; 1 if not given.
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
    ///     When the covariance would overflow. In either case nothing has changed.
    #[pyo3(signature = (phi, y, gamma=None))]
    fn update(
        &mut self,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Update> {
        either!(&mut self.inner, e => sample::update(e, phi, y, gamma))
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
    /// outputs : sequence of str, optional
    ///     What to keep: names of attributes of `Run`.
    /// missing : {"error", "skip"}
    ///     What to do with a sample that has a NaN: refuse the record, or leave the sample out.
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
    #[pyo3(signature = (phi, y, gamma=None, outputs=None, missing="error"))]
    fn run(
        &mut self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
        outputs: Option<Vec<String>>,
        missing: &str,
    ) -> PyResult<Run> {
        let skip = match missing {
            "error" => false,
            "skip" => true,
            _ => {
                return Err(invalid(format!("missing = {missing:?}, allowed: \"error\", \"skip\"")))
            }
        };
        let outputs = outputs.unwrap_or_else(|| DEFAULT_OUTPUTS.map(String::from).to_vec());
        either!(&mut self.inner, e => record::run(py, e, (phi, y, gamma), &outputs, skip))
    }

    /// Back to the initial estimate and covariance, as if no sample had been seen.
    fn reset(&mut self) {
        either!(&mut self.inner, e => e.reset());
    }

    /// The estimator, configuration and state, as bytes: portable, versioned and checked.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = either!(&self.inner, e => e.to_bytes()).map_err(raise)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// The estimator that `to_bytes` saved, bit for bit.
    #[classmethod]
    fn from_bytes(_: &Bound<'_, PyType>, state: &[u8]) -> PyResult<Self> {
        let double = number_type(state).map_err(raise)? == 8;
        Ok(Self { inner: new!(double, AnyEstimator::from_bytes(state).map_err(raise)?) })
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = slf.getattr("from_bytes")?;
        Ok((restore, (slf.borrow().to_bytes(slf.py())?,)))
    }

    fn __copy__(&self) -> Self {
        Self { inner: self.inner.clone() }
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.__copy__()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let rule = self.rule(py)?.repr()?;
        let (n, p, m) = (self.parameters(), self.rows(), self.targets());
        let samples = self.samples();
        Ok(format!("RLS({n}, rule={rule}, rows={p}, targets={m}) after {samples} samples"))
    }
}
