//! What one sample did to a bank, for Python.

use crate::arrays::{innovation, read_innovation};
use crate::pickle::{reduce, Reduced};
use forgetting_runtime::Skip;
use pyo3::prelude::*;

/// What one sample did: returned by `Bank.update`.
///
/// Attributes
/// ----------
/// error : float or ndarray
///     y - phi @ theta with the theta of before, in units of y; (rows,) or (rows, targets).
/// leverage : float
///     Variance of the prediction in units of the noise variance, without what the members disagree
///     about.
/// forgetting_factor : float
///     That of the members, mixed, in (0, 1].
/// skipped : str or None
///     Why the sample was left out, if all members left it out.
/// windup : bool
///     Whether the covariance of every member that is believed has wound up.
/// asleep : int
///     Members that could not take the sample.
#[pyclass(frozen, module = "forgetting")]
pub struct BankUpdate(pub forgetting_runtime::BankUpdate);

#[pymethods]
impl BankUpdate {
    #[getter]
    fn error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        innovation(py, &self.0.error)
    }

    #[getter]
    fn leverage(&self) -> f64 {
        self.0.leverage
    }

    #[getter]
    fn forgetting_factor(&self) -> f64 {
        self.0.forgetting_factor
    }

    #[getter]
    fn skipped(&self) -> Option<&'static str> {
        self.0.skipped.map(|reason| reason.word())
    }

    #[getter]
    fn windup(&self) -> bool {
        self.0.windup
    }

    #[getter]
    fn asleep(&self) -> usize {
        self.0.asleep
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (error, leverage) = (self.error(py)?.repr()?, self.0.leverage);
        let skipped = self.skipped().map_or("None".into(), |reason| format!("{reason:?}"));
        Ok(format!("BankUpdate(error={error}, leverage={leverage}, skipped={skipped})"))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let attributes = ["error", "leverage", "forgetting_factor", "skipped", "windup", "asleep"];
        reduce(slf, &attributes)
    }

    #[staticmethod]
    fn _of(
        error: &Bound<'_, PyAny>,
        leverage: f64,
        forgetting_factor: f64,
        skipped: Option<&str>,
        windup: bool,
        asleep: usize,
    ) -> PyResult<Self> {
        Ok(Self(forgetting_runtime::BankUpdate {
            error: read_innovation(error)?,
            leverage,
            forgetting_factor,
            skipped: skipped.and_then(Skip::of_word),
            windup,
            asleep,
        }))
    }
}
