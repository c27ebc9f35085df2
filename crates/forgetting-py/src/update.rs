//! What one sample told, for Python.

use crate::arrays::shaped;
use forgetting::Real;
use pyo3::prelude::*;
use pyo3::types::PyFloat;

enum Innovation {
    Scalar(f64),
    Array { elements: Vec<f64>, rows: usize, targets: usize },
}

/// What one sample told: returned by `RLS.update`.
///
/// Attributes
/// ----------
/// error : float or ndarray
///     y - phi @ theta with the theta of before, in units of y; (rows,) or (rows, targets).
/// leverage : float
///     Variance of the prediction in units of the noise variance (its trace for rows > 1).
/// forgetting_factor : float
///     The forgetting factor used, in (0, 1].
/// rank : int
///     Number of directions that lost information.
/// skipped : str or None
///     Why the sample was left out: "dead_zone" or "missing".
/// windup : bool
///     Whether the covariance has grown to more than ten times its first value.
#[pyclass(frozen, module = "forgetting")]
pub struct Update {
    innovation: Innovation,
    #[pyo3(get)]
    leverage: f64,
    #[pyo3(get)]
    forgetting_factor: f64,
    #[pyo3(get)]
    rank: usize,
    skipped: Option<forgetting::Skip>,
    #[pyo3(get)]
    windup: bool,
}

impl Update {
    /// From the crate's update, for a problem of these sizes.
    #[inline]
    pub fn new<T: Real>(update: &forgetting::Update<'_, T>, rows: usize, targets: usize) -> Self {
        let innovation = match update.error {
            [error] => Innovation::Scalar(error.to_f64()),
            errors => Innovation::Array {
                elements: errors.iter().map(|x| x.to_f64()).collect(),
                rows,
                targets,
            },
        };
        Self {
            innovation,
            leverage: update.leverage.to_f64(),
            forgetting_factor: update.forgetting_factor.to_f64(),
            rank: update.rank,
            skipped: update.skipped,
            windup: update.windup,
        }
    }
}

#[pymethods]
impl Update {
    #[getter]
    fn error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match &self.innovation {
            Innovation::Scalar(error) => Ok(PyFloat::new(py, *error).into_any()),
            Innovation::Array { elements, rows, targets: 1 } => {
                shaped(py, elements.clone(), &[*rows])
            }
            Innovation::Array { elements, rows, targets } => {
                shaped(py, elements.clone(), &[*rows, *targets])
            }
        }
    }

    #[getter]
    fn skipped(&self) -> Option<&'static str> {
        self.skipped.map(|reason| reason.word())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let Self { leverage, forgetting_factor, rank, .. } = self;
        let error = self.error(py)?.repr()?;
        let skipped = self.skipped.map_or("None".into(), |reason| format!("{:?}", reason.word()));
        let windup = if self.windup { "True" } else { "False" };
        Ok(format!(
            "Update(error={error}, leverage={leverage}, forgetting_factor={forgetting_factor}, \
             rank={rank}, skipped={skipped}, windup={windup})"
        ))
    }
}
