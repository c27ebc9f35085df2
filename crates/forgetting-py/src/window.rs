//! The class `InformationWindow`.

use crate::arrays::{output, Input};
use crate::errors::raise;
use forgetting_runtime::NumberType;
use pyo3::prelude::*;

/// The sum of phi.T @ phi over the last samples, in O(n**2) a sample.
///
/// Parameters
/// ----------
/// parameters, window, rows : int
///     n, the number N of samples, and the rows of each.
#[pyclass(subclass, module = "forgetting")]
pub struct InformationWindow(forgetting_runtime::InformationWindow);

#[pymethods]
impl InformationWindow {
    #[new]
    #[pyo3(signature = (parameters, window, rows=1))]
    fn new(parameters: i64, window: i64, rows: i64) -> PyResult<Self> {
        let window = forgetting_runtime::InformationWindow::new(parameters, window, rows);
        window.map(Self).map_err(raise)
    }

    /// Take one sample, whitened: (n,) or (rows, n).
    fn add(&mut self, phi: &Bound<'_, PyAny>) -> PyResult<()> {
        let phi = Input::read("phi", phi, NumberType::F64)?;
        self.0.add(phi.numbers()?).map_err(raise)
    }

    /// The sum, (n, n), in units of phi**2.
    #[getter]
    fn information<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.0.information())
    }

    /// Size below which an eigenvalue of the sum cannot be told from rounding.
    #[getter]
    fn noise(&self) -> f64 {
        self.0.noise()
    }

    /// Samples taken so far.
    #[getter]
    fn seen(&self) -> u64 {
        self.0.samples()
    }

    /// Samples in a full window.
    #[getter]
    fn window(&self) -> usize {
        self.0.window()
    }
}
