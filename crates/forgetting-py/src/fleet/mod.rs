//! The class `Fleet`.

mod estimators;
mod make;
mod parallel;
mod streams;
mod update;

pub use update::FleetUpdate;

use crate::arrays::{shaped, Number};
use crate::errors::{invalid, raise};
use crate::results;
use crate::rls::{either, new, Inner as One, Rls};
use forgetting::fleet::check_kind;
use forgetting::saved::{number_type, AnyEstimator};
use forgetting_cpu::{level, Fused, Level};
use make::{check_callables, read_count, Arguments};
use pyo3::exceptions::{PyIndexError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyTuple, PyType};
use streams::Streams;
use update::{read_mask, DEFAULT_OUTPUTS};

#[derive(Clone)]
enum Inner {
    Double(Box<Streams<f64>>),
    Single(Box<Streams<f32>>),
    // on a machine with fused multiply-add
    FusedDouble(Box<Streams<Fused<f64>>>),
    FusedSingle(Box<Streams<Fused<f32>>>),
}

/// The same expression for streams and one more thing of the same number type.
macro_rules! both {
    ($inner:expr, $Other:ident $other:expr; $streams:ident, $one:ident => $expression:expr) => {
        match ($inner, $other) {
            (Inner::Double($streams), $Other::Double($one)) => Some($expression),
            (Inner::Single($streams), $Other::Single($one)) => Some($expression),
            (Inner::FusedDouble($streams), $Other::FusedDouble($one)) => Some($expression),
            (Inner::FusedSingle($streams), $Other::FusedSingle($one)) => Some($expression),
            _ => None,
        }
    };
}

/// Many independent streams of the same number of parameters and the same rule, updated together.
///
/// Each stream is an `RLS` of one row and one target of its own; a fleet takes a sample of each
/// in one call. What a stream cannot use is told in the result and leaves that stream alone, bit
/// for bit: one bad sample does not stop the others.
///
/// Parameters
/// ----------
/// count : int
///     Number of streams, from 1; `append` adds more.
/// parameters : int
///     Number n of parameters of each stream.
/// rule : str or Rule, default "subspace"
///     Where to forget; see `forgetting.rules()`. Not one made from a function of yours.
/// forgetting_factor : float or (count,) array, optional
///     In place of that of the rule: for all streams, or one a stream; in (0, 1].
/// weighting : str or Weighting, optional
///     How far to trust a sample, by its innovation; see `forgetting.weightings()`.
/// gate : str or Gate, optional
///     Which samples to learn from; see `forgetting.gates()`.
/// initial_covariance : float, (n,), (n, n), (count, n) or (count, n, n) array, default 100.0
///     P before the first sample, positive definite, in units of 1/phi**2: for all streams, or
///     one a stream. An (n, n) array is one matrix for all, also when count is n.
/// initial_theta : (n,) or (count, n) array, optional
///     Estimate before the first sample, for all streams or one a stream; 0 if not given.
/// dtype : {"float64", "float32"}
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
#[pyclass(name = "Fleet", module = "forgetting")]
pub struct Fleet {
    inner: Inner,
    /// None for what suits the machine
    threads: Option<usize>,
}

#[pymethods]
impl Fleet {
    #[new]
    #[pyo3(signature = (count, parameters, *, rule=None, forgetting_factor=None, weighting=None,
        gate=None, initial_covariance=None, initial_theta=None, dtype="float64", threads=None))]
    #[allow(clippy::too_many_arguments, reason = "Python's keywords")]
    fn new(
        count: i64,
        parameters: i64,
        rule: Option<&Bound<'_, PyAny>>,
        forgetting_factor: Option<&Bound<'_, PyAny>>,
        weighting: Option<&Bound<'_, PyAny>>,
        gate: Option<&Bound<'_, PyAny>>,
        initial_covariance: Option<&Bound<'_, PyAny>>,
        initial_theta: Option<&Bound<'_, PyAny>>,
        dtype: &str,
        threads: Option<i64>,
    ) -> PyResult<Self> {
        let count = read_count(count)?;
        let double = match dtype {
            "float64" => true,
            "float32" => false,
            _ => {
                let allowed = r#""float64", "float32""#;
                return Err(invalid(format!("dtype = {dtype:?}, allowed: {allowed}")));
            }
        };
        let given = Arguments {
            rule,
            weighting,
            gate,
            forgetting_factor,
            initial_covariance,
            initial_theta,
        };
        let threads = read_threads(threads)?;
        Ok(Self { inner: new!(double, make::fleet(count, parameters, &given)?), threads })
    }

    /// Number of streams.
    #[getter]
    fn count(&self) -> usize {
        either!(&self.inner, s => s.len())
    }

    fn __len__(&self) -> usize {
        self.count()
    }

    /// Number n of parameters of each stream.
    #[getter]
    fn parameters(&self) -> usize {
        either!(&self.inner, s => s.parameters())
    }

    /// Cores that an update runs on; None for all where that is faster.
    #[getter]
    fn threads(&self) -> Option<usize> {
        self.threads
    }

    #[setter]
    fn set_threads(&mut self, threads: Option<i64>) -> PyResult<()> {
        self.threads = read_threads(threads)?;
        Ok(())
    }

    /// Name of the number type.
    #[getter]
    fn dtype(&self) -> &'static str {
        match self.inner {
            Inner::Double(_) | Inner::FusedDouble(_) => f64::DTYPE,
            Inner::Single(_) | Inner::FusedSingle(_) => f32::DTYPE,
        }
    }

    /// The forgetting rule, as an object that would make the same one. Where forgetting factors
    /// differ, it has that of a new stream; see `forgetting_factor`.
    #[getter]
    fn rule<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let description = either!(&self.inner, s => results::describe(py, s.fresh()))?;
        let choices = py.import("forgetting.choices")?;
        choices.call_method1("rule_from_description", (description, self.dtype()))
    }

    /// The forgetting factor of each stream, (count,); None where it is not constant.
    #[getter]
    fn forgetting_factor<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let count = self.count();
        either!(&self.inner, s => {
            s.forgetting_factor().map(|factors| shaped(py, factors, &[count])).transpose()
        })
    }

    /// The estimates, (count, n).
    #[getter]
    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        either!(&self.inner, s => shaped(py, s.theta(), &[s.len(), s.parameters()]))
    }

    /// The diagonal of each stream's covariance P, (count, n), in units of 1/phi**2.
    #[getter]
    fn variance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        either!(&self.inner, s => shaped(py, s.variance(), &[s.len(), s.parameters()]))
    }

    /// Samples used by each stream since its start, (count,).
    #[getter]
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        either!(&self.inner, s => shaped(py, s.spread().samples, &[s.len()]))
    }

    /// The covariance P of the stream at `index`, (n, n), in units of 1/phi**2.
    fn covariance<'py>(&self, py: Python<'py>, index: i64) -> PyResult<Bound<'py, PyAny>> {
        let index = self.position(index)?;
        either!(&self.inner, s => results::covariance(py, &s.get(index)))
    }

    /// How far each estimate can be trusted now, in O(n) a stream.
    ///
    /// Returns
    /// -------
    /// FleetHealth
    fn health<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let count = self.count();
        let (largest, smallest, windup, samples) = either!(&self.inner, s => {
            let spread = s.spread();
            let samples = shaped(py, spread.samples, &[count])?;
            let windup = shaped(py, spread.windup, &[count])?;
            let largest = shaped(py, spread.largest, &[count])?;
            (largest, shaped(py, spread.smallest, &[count])?, windup, samples)
        });
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
        either!(&self.inner, s => update::predict(py, s, phi))
    }

    /// Take a sample of each stream, without holding the interpreter.
    ///
    /// Parameters
    /// ----------
    /// phi : (count, n) array
    /// y : (count,) array
    /// mask : (count,) array of bool, optional
    ///     Which streams have a sample; all if not given. A NaN in phi or y says the same of its
    ///     stream.
    /// outputs : sequence of str, default ("error", "skipped")
    ///     What to keep, of "error", "leverage" and "skipped".
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
    #[pyo3(signature = (phi, y, mask=None, outputs=None))]
    fn update(
        &mut self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        mask: Option<&Bound<'_, PyAny>>,
        outputs: Option<Vec<String>>,
    ) -> PyResult<FleetUpdate> {
        let outputs = outputs.unwrap_or_else(|| DEFAULT_OUTPUTS.map(String::from).to_vec());
        let threads = self.threads;
        either!(&mut self.inner, s => update::update(py, s, (phi, y, mask), &outputs, threads))
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
        if let Ok(other) = more.cast::<Self>() {
            let other = other.borrow().inner.clone();
            return slf.borrow_mut().join(&other);
        }
        let count = more
            .extract::<i64>()
            .map_err(|_| invalid(format!("more = {more:?}, allowed: a whole number or a Fleet")))?;
        let count = read_count(count)?;
        either!(&mut slf.borrow_mut().inner, s => s.grow(count))
    }

    /// Back to the initial estimate and covariance, as if no sample had been seen.
    ///
    /// Parameters
    /// ----------
    /// mask : (count,) array of bool, optional
    ///     Which streams; all if not given.
    #[pyo3(signature = (mask=None))]
    fn reset(&mut self, mask: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let mask = mask.map(|mask| read_mask(mask, self.count())).transpose()?;
        either!(&mut self.inner, s => s.reset(mask.as_deref()));
        Ok(())
    }

    /// The streams as an Arrow table: one row a stream, with its number `stream` and its `state`,
    /// the bytes of `RLS.to_bytes`. Needs pyarrow: ``pip install forgetting[cli]``.
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

    /// The state of a new stream, then that of each stream, as `RLS.to_bytes` says it.
    fn _states<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        either!(&self.inner, s => {
            let state = |estimator: &AnyEstimator<_>| {
                Ok(PyBytes::new(py, &estimator.to_bytes().map_err(raise)?))
            };
            let each = (0..s.len()).map(|i| state(&s.get(i)));
            std::iter::once(state(s.fresh())).chain(each).collect()
        })
    }

    /// The fleet that has these states.
    #[staticmethod]
    fn _of_states(fresh: &[u8], states: Vec<Bound<'_, PyBytes>>) -> PyResult<Self> {
        let double = number_type(fresh).map_err(raise)? == 8;
        Ok(Self { inner: new!(double, restore(fresh, &states)?), threads: None })
    }

    /// A copy of the stream at `index`, as an estimator that goes on from there.
    fn __getitem__(&self, index: &Bound<'_, PyAny>) -> PyResult<Rls> {
        let index = self.position(read_index(index)?)?;
        Ok(Rls {
            inner: match &self.inner {
                Inner::Double(s) => One::Double(Box::new(s.get(index))),
                Inner::Single(s) => One::Single(Box::new(s.get(index))),
                Inner::FusedDouble(s) => One::FusedDouble(Box::new(s.get(index))),
                Inner::FusedSingle(s) => One::FusedSingle(Box::new(s.get(index))),
            },
        })
    }

    /// Puts a copy of `estimator` in the place of the stream at `index`.
    fn __setitem__(&mut self, index: &Bound<'_, PyAny>, estimator: &Rls) -> PyResult<()> {
        let index = self.position(read_index(index)?)?;
        both!(&mut self.inner, One &estimator.inner; s, one => s.put(index, one.as_ref().clone()))
            .unwrap_or_else(|| Err(invalid("a stream has the dtype of its fleet")))
    }

    #[allow(clippy::type_complexity, reason = "Python's protocol")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyAny>, Bound<'py, PyAny>))> {
        let mut states = slf.borrow()._states(slf.py())?;
        let each = PyTuple::new(slf.py(), states.split_off(1))?.to_list().into_any();
        Ok((slf.getattr("_of_states")?, (states.remove(0).into_any(), each)))
    }

    fn __copy__(&self) -> Self {
        Self { inner: self.inner.clone(), threads: self.threads }
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.__copy__()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let rule = self.rule(py)?.repr()?;
        Ok(format!("Fleet({}, {}, rule={rule})", self.count(), self.parameters()))
    }
}

impl Fleet {
    /// Where the stream at `index` is, counted from the end if negative.
    fn position(&self, index: i64) -> PyResult<usize> {
        let count = self.count() as i64;
        let position = if index < 0 { index.saturating_add(count) } else { index };
        if (0..count).contains(&position) {
            return Ok(position as usize);
        }
        Err(PyIndexError::new_err(format!("stream {index} of a fleet of {count}")))
    }

    /// Adds the streams of another fleet.
    fn join(&mut self, other: &Inner) -> PyResult<()> {
        both!(&mut self.inner, Inner other; s, others => {
            check_kind(s.fresh(), others.fresh()).map_err(raise)?;
            let first = s.len();
            s.grow(others.len())?;
            (0..others.len()).try_for_each(|i| s.put(first + i, others.get(i)))
        })
        .unwrap_or_else(|| Err(invalid("a stream has the dtype of its fleet")))
    }
}

fn read_threads(threads: Option<i64>) -> PyResult<Option<usize>> {
    const MOST: i64 = 1024;
    match threads {
        Some(threads) if !(1..=MOST).contains(&threads) => {
            Err(invalid(format!("threads = {threads}, allowed: whole numbers from 1 to {MOST}")))
        }
        threads => Ok(threads.map(|threads| threads as usize)),
    }
}

fn read_index(index: &Bound<'_, PyAny>) -> PyResult<i64> {
    let whole = index.extract();
    whole.map_err(|_| PyTypeError::new_err("the index of a stream is a whole number"))
}

/// A fleet of saved streams.
fn restore<T: Number>(fresh: &[u8], states: &[Bound<'_, PyBytes>]) -> PyResult<Streams<T>> {
    let mut streams = Streams::of(AnyEstimator::<T>::from_bytes(fresh).map_err(raise)?);
    check_callables(streams.fresh())?;
    streams.grow(states.len())?;
    for (i, state) in states.iter().enumerate() {
        let stream = AnyEstimator::from_bytes(state.as_bytes());
        let stream = stream.map_err(|error| invalid(format!("stream {i}: {error}")))?;
        streams.put(i, stream)?;
    }
    Ok(streams)
}
