//! The class `Fleet`.

use crate::arrays::{optional, output, Input};
use crate::bank::Bank;
use crate::errors::{heed_signals, invalid, raise};
use crate::pickle::{reduce, Reduced};
use crate::rls::Rls;
use crate::settings::{
    names, read_choices, read_optional, view, write_description, Dtype, Names, Whole,
};
use crate::shared::Shared;
use forgetting_runtime::{threads, BankSettings, Error, NumberType, Settings, Stream};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyString, PyTuple, PyType};
use pyo3::IntoPyObjectExt;

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
        let fleet = match (auto, factor) {
            (false, factor) => forgetting_runtime::Fleet::new(count.0, &settings, factor),
            (true, None) => {
                let settings = BankSettings { common: settings, members: None, mixer: None };
                forgetting_runtime::Fleet::of_banks(count.0, &settings)
            }
            (true, Some(_)) => {
                return Err(invalid("forgetting_factor is given, but the rule auto uses none"))
            }
        };
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
        optional(py, self.fleet.lock(py)?.forgetting_factor())
    }

    /// The estimates, (count, n).
    #[getter]
    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.fleet.lock(py)?.theta())
    }

    /// The diagonal of each stream's covariance P, (count, n), in units of 1/phi**2.
    #[getter]
    fn variance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.fleet.lock(py)?.variance())
    }

    /// Samples used by each stream since its start, (count,).
    #[getter]
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.fleet.lock(py)?.samples())
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

    /// phi @ theta of each stream.
    ///
    /// Parameters
    /// ----------
    /// phi : (count, n) array
    ///
    /// Returns
    /// -------
    /// (count,) ndarray
    fn predict<'py>(
        &self,
        py: Python<'py>,
        phi: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let phi = Input::read("phi", phi, self.number_type)?;
        let held = self.fleet.lock(py)?;
        let (fleet, phi) = (&*held, phi.view("phi")?);
        output(py, py.detach(|| fleet.predict(phi)).map_err(raise)?)
    }

    /// Take a sample of each stream, without holding the interpreter. Ctrl-C is heard within half a
    /// second; the fleet is then as it was before, bit for bit.
    ///
    /// Parameters
    /// ----------
    /// phi : (count, n) array
    /// y : (count,) array
    /// mask : (count,) array of bool, optional
    ///     Which streams have a sample; all if not given. A NaN in phi or y says the same of its
    ///     stream.
    /// outputs : str or sequence of str, default ("error", "skipped")
    ///     What to keep, of "error", "leverage" and "skipped".
    /// elapsed : float or (count,) array, optional
    ///     Time since the last sample of each stream, as that of `RLS.update`. Streams are then taken
    ///     one by one, in microseconds each; of banks each member, too.
    ///
    /// Returns
    /// -------
    /// FleetUpdate
    ///
    /// Raises
    /// ------
    /// InvalidInput
    ///     For a wrong shape; nothing has changed. What a stream cannot use is not raised: the
    ///     code in `skipped` says "refused" where the sample has an infinite number or the result
    ///     would leave the range of the number type, and that stream is as it was.
    #[pyo3(signature = (phi, y, mask=None, outputs=None, *, elapsed=None))]
    fn update(
        &self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        mask: Option<&Bound<'_, PyAny>>,
        outputs: Option<Names>,
        elapsed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<FleetUpdate> {
        let number_type = self.number_type;
        let mask = mask.map(|mask| read_mask(mask)).transpose()?;
        let phi = Input::read("phi", phi, number_type)?;
        let y = Input::read("y", y, number_type)?;
        let elapsed = read_optional("elapsed", elapsed, number_type)?;
        let mut held = self.fleet.lock(py)?;
        let elapsed = view("elapsed", &elapsed)?;
        let samples = (phi.view("phi")?, y.view("y")?, mask.as_deref());
        let (fleet, outputs) = (&mut *held, names(outputs.as_ref()));
        let update = py
            .detach(|| fleet.update_while(elapsed, samples, outputs.as_deref(), &mut heed_signals))
            .map_err(raise)?;
        Ok(FleetUpdate {
            error: optional(py, update.error)?,
            leverage: optional(py, update.leverage)?,
            skipped: optional(py, update.skipped)?,
            used: update.used,
        })
    }

    /// Add streams after the last.
    ///
    /// Parameters
    /// ----------
    /// more : int or Fleet
    ///     So many new streams, or copies of those of another fleet of the same parameters, rule,
    ///     weighting and dtype. New streams start from what was given for all streams, and from
    ///     the default where one was given for each.
    fn append(slf: &Bound<'_, Self>, more: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = slf.py();
        if let Ok(other) = more.cast::<Self>() {
            let other = other.get().fleet.lock(py)?.clone();
            return slf.get().fleet.lock(py)?.append(&other).map_err(raise);
        }
        let count = more
            .extract::<Whole>()
            .map_err(|_| invalid(format!("more = {more:?}, allowed: a whole number or a Fleet")))?;
        slf.get().fleet.lock(py)?.grow(count.0).map_err(raise)
    }

    /// Back to the initial estimate and covariance, as if no sample had been seen.
    ///
    /// Parameters
    /// ----------
    /// mask : (count,) array of bool, optional
    ///     Which streams; all if not given.
    #[pyo3(signature = (mask=None))]
    fn reset(&self, py: Python<'_>, mask: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let mask = mask.map(|mask| read_mask(mask)).transpose()?;
        self.fleet.lock(py)?.reset(mask.as_deref()).map_err(raise)
    }

    /// The streams as an Arrow table: one row a stream, with its number `stream` and its `state`,
    /// the bytes of `RLS.to_bytes` or `Bank.to_bytes`. Needs pyarrow: ``pip install forgetting[cli]``.
    fn to_arrow<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("forgetting.fleet")?.call_method1("to_arrow", (slf,))
    }

    /// The fleet that `to_arrow` saved, bit for bit; one stream for each row of the table.
    #[classmethod]
    fn from_arrow<'py>(
        _: &Bound<'py, PyType>,
        table: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        table.py().import("forgetting.fleet")?.call_method1("from_arrow", (table,))
    }

    /// The state of a new stream, then that of each stream, as `to_bytes` of a stream says it.
    fn _states<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        let fleet = self.fleet.lock(py)?;
        let fresh = std::iter::once_with(|| fleet.fresh_state());
        let streams = (0..fleet.count() as i64).map(|stream| fleet.state(stream));
        let bytes = |state: Result<Vec<u8>, Error>| {
            py.check_signals()?;
            Ok(PyBytes::new(py, &state.map_err(raise)?))
        };
        fresh.chain(streams).map(bytes).collect()
    }

    /// The fleet that has these states.
    #[staticmethod]
    fn _of_states(py: Python<'_>, fresh: &[u8], states: Vec<Bound<'_, PyBytes>>) -> PyResult<Self> {
        let states: Vec<&[u8]> = states.iter().map(|state| state.as_bytes()).collect();
        py.detach(|| forgetting_runtime::Fleet::from_states(fresh, &states, &mut heed_signals))
            .map(Self::of)
            .map_err(raise)
    }

    /// A copy of the stream at `index`, as an `RLS` or a `Bank` that goes on from there.
    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (position, py) = (read_index(index)?, index.py());
        match self.fleet.lock(py)?.get(position).map_err(raise)? {
            Stream::Estimator(estimator) => Rls::of(estimator).into_bound_py_any(py),
            Stream::Bank(bank) => Bank::of(bank).into_bound_py_any(py),
        }
    }

    /// Puts a copy of `stream`, an `RLS` or a `Bank`, in the place of the stream at `index`.
    fn __setitem__(&self, index: &Bound<'_, PyAny>, stream: &Bound<'_, PyAny>) -> PyResult<()> {
        let (position, py) = (read_index(index)?, index.py());
        let copy = copy(stream)?;
        self.fleet.lock(py)?.put(position, copy).map_err(raise)
    }

    #[allow(clippy::type_complexity, reason = "Python's protocol")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyAny>, Bound<'py, PyAny>))> {
        let mut states = slf.get()._states(slf.py())?;
        let each = PyTuple::new(slf.py(), states.split_off(1))?.to_list().into_any();
        Ok((slf.getattr("_of_states")?, (states.remove(0).into_any(), each)))
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        Ok(Self::of(self.fleet.lock(py)?.clone()))
    }

    fn __deepcopy__(&self, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.__copy__(memo.py())
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

/// A copy of what is to be a stream.
fn copy(stream: &Bound<'_, PyAny>) -> PyResult<Stream> {
    if let Ok(estimator) = stream.cast::<Rls>() {
        return estimator.get().copy(stream.py()).map(Stream::Estimator);
    }
    if let Ok(bank) = stream.cast::<Bank>() {
        return bank.get().copy(stream.py()).map(Stream::Bank);
    }
    let kind = stream.get_type().name()?;
    Err(PyTypeError::new_err(format!("a stream is an RLS or a Bank, not {kind}")))
}

fn read_index(index: &Bound<'_, PyAny>) -> PyResult<i64> {
    let whole = index.extract::<Whole>();
    whole
        .map(|index| index.0)
        .map_err(|_| PyTypeError::new_err("the index of a stream is a whole number"))
}

/// A yes or no for each stream, copied; the fleet says how many there are to be.
fn read_mask(mask: &Bound<'_, PyAny>) -> PyResult<Vec<bool>> {
    let array = mask.py().import("numpy")?.call_method1("asarray", (mask,))?;
    let Ok(flat) = array.cast::<PyArray1<bool>>() else {
        let shape = array.getattr("shape")?;
        return Err(invalid(format!(
            "mask must hold True or False, one for each stream; it has shape {shape} and holds {}",
            array.getattr("dtype")?
        )));
    };
    Ok(flat.to_vec()?)
}

/// What a sample of each stream did: returned by `Fleet.update`. An output that was not asked
/// for is None.
///
/// Attributes
/// ----------
/// error : (count,) ndarray
///     y - phi @ theta with the theta of before, in units of y; NaN where there was no sample or
///     it was refused.
/// leverage : (count,) ndarray
///     Variance of the prediction in units of the noise variance; NaN as above.
/// skipped : (count,) ndarray of uint8
///     0 where the sample was used, else the code of the reason, see `forgetting.SKIPPED`.
/// used : int
///     Number of streams that used their sample.
#[pyclass(frozen, get_all, module = "forgetting")]
pub struct FleetUpdate {
    error: Option<Py<PyAny>>,
    leverage: Option<Py<PyAny>>,
    skipped: Option<Py<PyAny>>,
    used: usize,
}

#[pymethods]
impl FleetUpdate {
    fn __repr__(&self) -> String {
        format!("FleetUpdate(used={})", self.used)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduce(slf, &["error", "leverage", "skipped", "used"])
    }

    #[staticmethod]
    fn _of(
        error: Option<Py<PyAny>>,
        leverage: Option<Py<PyAny>>,
        skipped: Option<Py<PyAny>>,
        used: usize,
    ) -> Self {
        Self { error, leverage, skipped, used }
    }
}
