//! What one sample told, for Python.

use crate::arrays::shaped;
use crate::errors::raise;
use forgetting::gates::Answer;
use forgetting::{Real, Skip};
use pyo3::prelude::*;
use pyo3::types::PyFloat;

/// One number a row and target, and the shape to show them in.
enum Shaped {
    Scalar(f64),
    Array { elements: Vec<f64>, rows: usize, targets: usize },
}

impl Shaped {
    #[inline]
    fn new<T: Real>(elements: &[T], rows: usize, targets: usize) -> Self {
        match elements {
            [element] => Self::Scalar(element.to_f64()),
            elements => Self::Array {
                elements: elements.iter().map(|x| x.to_f64()).collect(),
                rows,
                targets,
            },
        }
    }

    fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match self {
            Self::Scalar(element) => Ok(PyFloat::new(py, *element).into_any()),
            Self::Array { elements, rows, targets: 1 } => shaped(py, elements.clone(), &[*rows]),
            Self::Array { elements, rows, targets } => {
                shaped(py, elements.clone(), &[*rows, *targets])
            }
        }
    }
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
pub struct Update {
    error: Shaped,
    whitened: Shaped,
    #[pyo3(get)]
    leverage: f64,
    #[pyo3(get)]
    forgetting_factor: f64,
    #[pyo3(get)]
    rank: usize,
    skipped: Option<Skip>,
    gate: Answer,
    #[pyo3(get)]
    windup: bool,
}

impl Update {
    /// From the crate's update, for a problem of these sizes; several rows must be whitened.
    #[inline]
    pub fn new<T: Real>(
        update: &forgetting::Update<'_, T>,
        rows: usize,
        targets: usize,
    ) -> PyResult<Self> {
        let whitened = if update.error.len() == 1 {
            let mut whitened = [T::ZERO];
            update.whiten(&mut whitened).map_err(raise)?;
            Shaped::new(&whitened, rows, targets)
        } else {
            let mut whitened = vec![T::ZERO; update.error.len()];
            update.whiten(&mut whitened).map_err(raise)?;
            Shaped::new(&whitened, rows, targets)
        };
        Ok(Self {
            error: Shaped::new(update.error, rows, targets),
            whitened,
            leverage: update.leverage.to_f64(),
            forgetting_factor: update.forgetting_factor.to_f64(),
            rank: update.rank,
            skipped: update.skipped,
            gate: update.gate,
            windup: update.windup,
        })
    }
}

#[pymethods]
impl Update {
    #[getter]
    fn error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.error.show(py)
    }

    #[getter]
    fn whitened_innovation<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.whitened.show(py)
    }

    #[getter]
    fn gate(&self) -> &'static str {
        self.gate.word()
    }

    #[getter]
    fn skipped(&self) -> Option<&'static str> {
        self.skipped.map(|reason| reason.word())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let Self { leverage, forgetting_factor, rank, .. } = self;
        let error = self.error.show(py)?.repr()?;
        let skipped = self.skipped.map_or("None".into(), |reason| format!("{:?}", reason.word()));
        let gate = self.gate.word();
        let windup = if self.windup { "True" } else { "False" };
        Ok(format!(
            "Update(error={error}, leverage={leverage}, forgetting_factor={forgetting_factor}, \
             rank={rank}, skipped={skipped}, gate={gate:?}, windup={windup})"
        ))
    }
}
