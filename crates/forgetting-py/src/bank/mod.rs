//! The class `Bank`.

mod samples;
mod saved;

use crate::arrays::{output, Input};
use crate::choice::{read, read_forgetting_factor, write};
use crate::errors::{invalid, raise};
use crate::settings::{read_choices, read_optional, view, write_description, Dtype, Whole};
use crate::shared::Shared;
use forgetting_runtime::{size, Bank as Inner, BankSettings, Choice, Member, NumberType, Settings};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Several estimators on the same samples, mixed by how well each has predicted.
///
/// Nothing need be chosen: the default members cover all speeds at which parameters may change, and
/// the mixture predicts about as well as the best of them would have. Without an initial covariance no
/// prediction depends on the units of phi or y.
///
/// Parameters
/// ----------
/// parameters : int
///     Number n of parameters of each target.
/// members : sequence of str or Rule, optional
///     A rule each; random walks of eight speeds if not given, of the six slowest with a weighting.
/// mixer : str or Mixer, default "mlpol"
///     How members are weighed; see `forgetting.mixers()`. For the default members, the slowest
///     first, `mlpol` has a `prior_ratio` of 0.93 unless told otherwise.
/// weighting, gate : optional
///     As those of `RLS`, the same for all members; no function of yours.
/// rows, targets : int, default 1
///     As those of `RLS`.
/// initial_covariance : float, (n,) or (n, n) array, optional
///     P before the first sample of all members, in units of 1/phi**2. If not given, each
///     regressor is measured in units of its typical size so far, and P is 1e5 in these.
/// initial_theta : (n,) or (n, targets) array, optional
///     Estimate before the first sample, together with an initial covariance.
/// dtype : {"float64", "float32"} or NumPy type
///     Type of all numbers.
///
/// Raises
/// ------
/// InvalidInput
///     Names the parameter, its value and what is allowed.
///
/// Examples
/// --------
/// >>> import forgetting as fg
/// >>> bank = fg.Bank(2)
/// >>> for k in range(100):
/// ...     u = bank.update([1.0, k % 7], 3.0 + 0.5 * (k % 7))
/// >>> bank.theta.round(4)
/// array([3. , 0.5])
#[pyclass(frozen, module = "forgetting")]
pub struct Bank {
    pub(crate) bank: Shared<Inner>,
    /// n, p and m
    sizes: [usize; 3],
    number_type: NumberType,
}

#[pymethods]
impl Bank {
    #[new]
    #[pyo3(signature = (parameters, members=None, *, mixer=None, weighting=None, gate=None,
        rows=Whole(1), targets=Whole(1), initial_covariance=None, initial_theta=None,
        dtype=Dtype::DEFAULT),
        text_signature = "(parameters, members=None, *, mixer=None, weighting=None, gate=None, \
        rows=1, targets=1, initial_covariance=None, initial_theta=None, dtype='float64')")]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        parameters: Whole,
        members: Option<&Bound<'_, PyAny>>,
        mixer: Option<&Bound<'_, PyAny>>,
        weighting: Option<&Bound<'_, PyAny>>,
        gate: Option<&Bound<'_, PyAny>>,
        rows: Whole,
        targets: Whole,
        initial_covariance: Option<&Bound<'_, PyAny>>,
        initial_theta: Option<&Bound<'_, PyAny>>,
        dtype: Dtype,
    ) -> PyResult<Self> {
        let number_type = dtype.0;
        let covariance = read_optional("initial_covariance", initial_covariance, number_type)?;
        let theta = read_optional("initial_theta", initial_theta, number_type)?;
        let common = Settings {
            rows: size("rows", rows.0).map_err(raise)?,
            targets: size("targets", targets.0).map_err(raise)?,
            number_type,
            initial_covariance: view("initial_covariance", &covariance)?,
            initial_theta: view("initial_theta", &theta)?,
            ..read_choices(parameters, None, weighting, gate)?
        };
        let members = members.map(read_members).transpose()?;
        let settings = BankSettings { common, members, mixer: read("mixer", mixer)? };
        Ok(Self::of(Inner::new(&settings).map_err(raise)?))
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
        Ok(self.bank.lock(py)?.samples())
    }

    /// The estimate of the mixture, (n,) or (n, targets).
    #[getter]
    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.bank.lock(py)?.theta())
    }

    /// The covariance P of the mixture, (n, n), in units of 1/phi**2, with what the members disagree
    /// about: times the noise variance, it is that of the estimate.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.bank.lock(py)?.covariance())
    }

    /// How far each member is believed, (members,): not negative, their sum is 1.
    #[getter]
    fn weights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.bank.lock(py)?.weights())
    }

    /// Over how many samples the bank remembers: n over the mean of s / (1 + s), with s the leverage,
    /// of each member, mixed. With exponential forgetting that is 1 / (1 - lambda).
    #[getter]
    fn memory(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.bank.lock(py)?.memory())
    }

    /// The noise variance, over up to the last thousand samples, in units of gamma.
    #[getter]
    fn noise_variance(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.bank.lock(py)?.noise_variance())
    }

    /// The units (n,) in which regressors are measured, 1 for one that has always been 0; None where an
    /// initial covariance was given.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.bank.lock(py)?.units().map(|units| output(py, units)).transpose()
    }

    /// The mixer and the members by name, each with its parameters.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let written = PyDict::new(py);
        written.set_item("mixer", write(py, &self.bank.lock(py)?.mixer())?)?;
        let members = self.bank.lock(py)?.members();
        let members: PyResult<Vec<_>> =
            members.iter().map(|member| write_description(py, member)).collect();
        written.set_item("members", members?)?;
        Ok(written)
    }

    /// The rules of the members, as objects that would make the same ones.
    #[getter]
    fn members<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let choices = py.import("forgetting.choices")?;
        let members = self.bank.lock(py)?.members();
        let rule = |member| {
            let described = write_description(py, member)?;
            choices.call_method1("rule_from_description", (described, self.dtype()))
        };
        members.iter().map(rule).collect()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let bank = self.bank.lock(py)?;
        let (n, count) = (self.sizes[0], bank.members().len());
        let (mixer, samples) = (bank.mixer().name, bank.samples());
        Ok(format!("Bank({n}, {count} members, mixer={mixer:?}) after {samples} samples"))
    }
}

impl Bank {
    /// A bank for Python.
    pub fn of(bank: Inner) -> Self {
        let (sizes, number_type) =
            ([bank.parameters(), bank.rows(), bank.targets()], bank.number_type());
        Self { bank: Shared::new(bank), sizes, number_type }
    }

    /// A copy of what it is now.
    pub fn copy(&self, py: Python<'_>) -> PyResult<Inner> {
        Ok(self.bank.lock(py)?.clone())
    }

    fn input<'a, 'py>(
        &self,
        name: &str,
        values: &'a Bound<'py, PyAny>,
    ) -> PyResult<Input<'a, 'py>> {
        Input::read(name, values, self.number_type)
    }
}

/// A rule for each member.
fn read_members(members: &Bound<'_, PyAny>) -> PyResult<Vec<Member>> {
    let list = members
        .try_iter()
        .map_err(|_| invalid(format!("members = {members:?}, allowed: a sequence of rules")))?;
    let member = |rule: PyResult<Bound<'_, PyAny>>| {
        let rule = rule?;
        let choice = read("rule", Some(&rule))?.unwrap_or_else(|| Choice::named(""));
        Ok(Member { rule: choice, forgetting_factor: read_forgetting_factor(Some(&rule))? })
    };
    list.map(member).collect()
}
