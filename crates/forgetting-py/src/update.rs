//! What one sample did, for Python.

use crate::arrays::{innovation, read_innovation};
use crate::pickle::{reduce, Reduced};
use forgetting_runtime::{Answer, Skip};
use pyo3::prelude::*;

/// What one sample did: returned by `RLS.update`.
///
/// Attributes
/// ----------
/// error : float or ndarray
///     y - phi @ theta with the theta of before, in units of y; (rows,) or (rows, targets).
/// leverage : float
///     Variance of the prediction in units of the noise variance (its trace for rows > 1): phi @ P @
///     phi.T with P after forgetting, over gamma and times the weight of the weighting.
/// weight : float
///     Gamma was divided by this: by the weight of the weighting, and by what the rule made of the
///     sample (`data_dependent`, `efra`).
/// forgetting_factor : float
///     The forgetting factor used, in (0, 1].
/// rank : int
///     Number of directions that lost information.
/// skipped : str or None
///     Why the sample was left out: "dead_zone", "within_bound", "missing" or "gate".
/// gate : str
///     What the gate said: "update", "freeze" (learned, nothing forgotten) or "hold".
/// whitened_innovation : float or ndarray
///     solve(L, error) with L @ L.T = gamma + phi @ P @ phi.T, L lower triangular and P that after
///     forgetting: independent, with mean 0 and the variance of the noise in units of gamma, if the
///     model is right. A weighting divides gamma. For one row: error / sqrt(gamma (1 + leverage)).
/// windup : bool
///     Whether the covariance has grown to more than ten times its first value.
#[pyclass(frozen, module = "forgetting")]
pub struct Update(pub forgetting_runtime::Update);

#[pymethods]
impl Update {
    #[getter]
    fn error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        innovation(py, &self.0.error)
    }

    #[getter]
    fn whitened_innovation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        innovation(py, &self.0.whitened_innovation)
    }

    #[getter]
    fn leverage(&self) -> f64 {
        self.0.leverage
    }

    #[getter]
    fn weight(&self) -> f64 {
        self.0.weight
    }

    #[getter]
    fn forgetting_factor(&self) -> f64 {
        self.0.forgetting_factor
    }

    #[getter]
    fn rank(&self) -> usize {
        self.0.rank
    }

    #[getter]
    fn windup(&self) -> bool {
        self.0.windup
    }

    #[getter]
    fn gate(&self) -> &'static str {
        self.0.gate.word()
    }

    #[getter]
    fn skipped(&self) -> Option<&'static str> {
        self.0.skipped.map(|reason| reason.word())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let forgetting_runtime::Update { leverage, forgetting_factor, rank, .. } = self.0;
        let error = self.error(py)?.repr()?;
        let skipped = self.skipped().map_or("None".into(), |reason| format!("{reason:?}"));
        let gate = self.gate();
        let windup = if self.windup() { "True" } else { "False" };
        Ok(format!(
            "Update(error={error}, leverage={leverage}, forgetting_factor={forgetting_factor}, \
             rank={rank}, skipped={skipped}, gate={gate:?}, windup={windup})"
        ))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        const ATTRIBUTES: [&str; 9] = [
            "error",
            "whitened_innovation",
            "leverage",
            "weight",
            "forgetting_factor",
            "rank",
            "skipped",
            "gate",
            "windup",
        ];
        reduce(slf, &ATTRIBUTES)
    }

    #[staticmethod]
    #[allow(clippy::too_many_arguments, reason = "one for each attribute")]
    fn _of(
        error: &Bound<'_, PyAny>,
        whitened_innovation: &Bound<'_, PyAny>,
        leverage: f64,
        weight: f64,
        forgetting_factor: f64,
        rank: usize,
        skipped: Option<&str>,
        gate: &str,
        windup: bool,
    ) -> PyResult<Self> {
        Ok(Self(forgetting_runtime::Update {
            error: read_innovation(error)?,
            whitened_innovation: read_innovation(whitened_innovation)?,
            leverage,
            weight,
            forgetting_factor,
            rank,
            skipped: skipped.and_then(Skip::of_word),
            gate: Answer::of_word(gate).unwrap_or(Answer::Update),
            windup,
        }))
    }
}
