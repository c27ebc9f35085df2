//! The class `Fleet`.

mod samples;
mod saved;
mod streams;
mod update;

pub use update::FleetUpdate;

use crate::arrays::{optional, output};
use crate::errors::{heed_signals, invalid, raise};
use crate::settings::{read_choices, read_optional, view, write_description, Dtype, Whole};
use crate::shared::Shared;
use forgetting_runtime::{threads, BankSettings, NumberType, Settings};
use pyo3::prelude::*;
use pyo3::types::PyString;

/// Many independent streams of the same number of parameters and the same rule, updated together.
///
/// Each stream is an `RLS` or a `Bank` of one row and one target of its own; a fleet takes a sample
/// of each in one call. What a stream cannot use is reported and leaves that stream alone, bit
/// for bit: one bad sample does not stop the others.
///
/// Parameters
/// ----------
/// count : int
///     Number of streams, from 0; `append` adds more.
/// parameters : int
///     Number n of parameters of each stream.
/// rule : str or Rule, optional
///     Where to forget, as that of `RLS`; see `forgetting.rules()`. Not one made from a function of
///     yours. "auto" chooses nothing beforehand: each stream is what `Bank(parameters)` is, a mixture of
///     random walks of eight speeds. Of four parameters that takes about 1 microsecond a sample and
///     1.5 kB a stream; one rule takes 1/50 of the time and 1/6 of the memory.
/// forgetting_factor : float or (count,) array, optional
///     In place of that of the rule: for all streams, or one a stream; in (0, 1]. Not with "auto".
/// weighting : str or Weighting, optional
///     How far to trust a sample, by its innovation; see `forgetting.weightings()`.
/// gate : str or Gate, optional
///     Which samples to learn from; see `forgetting.gates()`.
/// initial_covariance : float, (n,), (n, n), (count, n) or (count, n, n) array, optional
///     P before the first sample, positive definite, in units of 1/phi**2: for all streams, or
///     one a stream. An (n, n) array is one matrix for all, also when count is n. With "auto" the
///     same for all. If not given, it follows the data, as that of `RLS`.
/// initial_theta : (n,) or (count, n) array, optional
///     Estimate before the first sample, for all streams or one a stream; 0 if not given. With "auto"
///     the same for all, together with an initial covariance.
/// dtype : {"float64", "float32"} or NumPy type
///     Type of all numbers.
/// threads : int, optional
///     Cores that an update runs on; if not given, all where that is faster than one. The result
///     does not depend on it.
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
/// >>> fleet = fg.Fleet(1000, 2, rule=fg.Exponential(0.98))
/// >>> slope = np.linspace(0.0, 1.0, 1000)
/// >>> for k in range(100):
/// ...     phi = np.tile([1.0, k % 7], (1000, 1))
/// ...     u = fleet.update(phi, 3.0 + slope * phi[:, 1])
/// >>> u.used
/// 1000
/// >>> bool(abs(fleet.theta[:, 1] - slope).max() < 1e-3)
/// True
///
/// Nothing chosen, and a stream apart from its fleet:
///
/// >>> fleet = fg.Fleet(3, 2, rule="auto")
/// >>> for k in range(100):
/// ...     u = fleet.update([[1.0, k % 7]] * 3, [k % 7, 1.0 + k % 7, 2.0 + k % 7])
/// >>> fleet[2]
/// Bank(2, 8 members, mixer="mlpol") after 100 samples
///
/// Notes
/// -----
/// Threads may share a fleet: each call waits for the one before it, without holding the
/// interpreter.
#[pyclass(frozen, name = "Fleet", module = "forgetting")]
pub struct Fleet {
    fleet: Shared<forgetting_runtime::Fleet>,
    parameters: usize,
    number_type: NumberType,
}

#[pymethods]
impl Fleet {
    #[new]
    #[pyo3(signature = (count, parameters, *, rule=None, forgetting_factor=None, weighting=None,
        gate=None, initial_covariance=None, initial_theta=None, dtype=Dtype::DEFAULT, threads=None),
        text_signature = "(count, parameters, *, rule=None, forgetting_factor=None, weighting=None, \
        gate=None, initial_covariance=None, initial_theta=None, dtype='float64', threads=None)")]
    #[allow(clippy::too_many_arguments, reason = "Python's keywords")]
    fn new(
        py: Python<'_>,
        count: Whole,
        parameters: Whole,
        rule: Option<&Bound<'_, PyAny>>,
        forgetting_factor: Option<&Bound<'_, PyAny>>,
        weighting: Option<&Bound<'_, PyAny>>,
        gate: Option<&Bound<'_, PyAny>>,
        initial_covariance: Option<&Bound<'_, PyAny>>,
        initial_theta: Option<&Bound<'_, PyAny>>,
        dtype: Dtype,
        threads: Option<Whole>,
    ) -> PyResult<Self> {
        let number_type = dtype.0;
        let threads =
            forgetting_runtime::threads(threads.map(|threads| threads.0)).map_err(raise)?;
        let factor = read_optional("forgetting_factor", forgetting_factor, number_type)?;
        let covariance = read_optional("initial_covariance", initial_covariance, number_type)?;
        let theta = read_optional("initial_theta", initial_theta, number_type)?;
        let auto = rule.is_some_and(is_auto);
        let choices = read_choices(parameters, rule.filter(|_| !auto), weighting, gate)?;
        let settings = Settings {
            number_type,
            initial_covariance: view("initial_covariance", &covariance)?,
            initial_theta: view("initial_theta", &theta)?,
            ..choices
        };
        let factor = view("forgetting_factor", &factor)?;
        if auto && factor.is_some() {
            return Err(invalid("forgetting_factor is given, but the rule auto uses none"));
        }
        let fleet = py.detach(|| match auto {
            true => {
                let settings = BankSettings { common: settings, members: None, mixer: None };
                forgetting_runtime::Fleet::of_banks_while(count.0, &settings, &mut heed_signals)
            }
            false => {
                forgetting_runtime::Fleet::new_while(count.0, &settings, factor, &mut heed_signals)
            }
        });
        let mut fleet = fleet.map_err(raise)?;
        fleet.set_threads(threads);
        Ok(Self::of(fleet))
    }

    /// Number of streams.
    #[getter]
    fn count(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.fleet.lock(py)?.count())
    }

    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.count(py)
    }

    /// Number n of parameters of each stream.
    #[getter]
    fn parameters(&self) -> usize {
        self.parameters
    }

    /// Cores that an update runs on; None for all where that is faster.
    #[getter]
    fn threads(&self, py: Python<'_>) -> PyResult<Option<usize>> {
        Ok(self.fleet.lock(py)?.threads())
    }

    #[setter]
    fn set_threads(&self, py: Python<'_>, count: Option<Whole>) -> PyResult<()> {
        self.fleet.lock(py)?.set_threads(threads(count.map(|count| count.0)).map_err(raise)?);
        Ok(())
    }

    /// Name of the number type.
    #[getter]
    fn dtype(&self) -> &'static str {
        self.number_type.name()
    }

    /// The forgetting rule, as an object that would make the same one; "auto" where streams are banks.
    /// Where forgetting factors differ, it has that of a new stream; see `forgetting_factor`.
    #[getter]
    fn rule<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Some(description) = self.fleet.lock(py)?.describe() else {
            return Ok(PyString::new(py, AUTO).into_any());
        };
        let description = write_description(py, &description)?;
        let choices = py.import("forgetting.choices")?;
        choices.call_method1("rule_from_description", (description, self.dtype()))
    }

    /// The forgetting factor of each stream, (count,); None where it is not constant.
    #[getter]
    fn forgetting_factor(&self, py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
        optional(py, self.fleet.lock(py)?.forgetting_factor().map_err(raise)?)
    }

    /// The estimates, (count, n).
    #[getter]
    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let held = self.fleet.lock(py)?;
        let fleet = &*held;
        output(py, py.detach(|| fleet.theta(&mut heed_signals)).map_err(raise)?)
    }

    /// The diagonal of each stream's covariance P, (count, n), in units of 1/phi**2.
    #[getter]
    fn variance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let held = self.fleet.lock(py)?;
        let fleet = &*held;
        output(py, py.detach(|| fleet.variance(&mut heed_signals)).map_err(raise)?)
    }

    /// Samples used by each stream since its start, (count,).
    #[getter]
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let held = self.fleet.lock(py)?;
        let fleet = &*held;
        output(py, py.detach(|| fleet.samples(&mut heed_signals)).map_err(raise)?)
    }

    /// The covariance P of the stream at `index`, (n, n), in units of 1/phi**2.
    fn covariance<'py>(&self, py: Python<'py>, index: Whole) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.fleet.lock(py)?.covariance(index.0).map_err(raise)?)
    }

    /// How far each estimate can be trusted now, in O(n) a stream, O(n^2) where it is a bank. Like
    /// `update` it hears Ctrl-C.
    ///
    /// Returns
    /// -------
    /// FleetHealth
    fn health<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let held = self.fleet.lock(py)?;
        let fleet = &*held;
        let health = py.detach(|| fleet.health(&mut heed_signals)).map_err(raise)?;
        drop(held);
        let (largest, smallest) = (output(py, health.largest)?, output(py, health.smallest)?);
        let (windup, samples) = (output(py, health.windup)?, output(py, health.samples)?);
        let made = (self.dtype(), largest, smallest, windup, samples);
        py.import("forgetting.fleet")?.call_method1("health_of", made)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let rule = self.rule(py)?.repr()?;
        Ok(format!("Fleet({}, {}, rule={rule})", self.count(py)?, self.parameters))
    }
}

impl Fleet {
    fn of(fleet: forgetting_runtime::Fleet) -> Self {
        let (parameters, number_type) = (fleet.parameters(), fleet.number_type());
        Self { fleet: Shared::new(fleet), parameters, number_type }
    }
}

/// The rule that is a bank.
const AUTO: &str = "auto";

fn is_auto(rule: &Bound<'_, PyAny>) -> bool {
    rule.cast::<PyString>().is_ok_and(|name| name == AUTO)
}
