//! The class `InformationWindow`.

use crate::arrays::{output, Input};
use crate::errors::raise;
use crate::settings::{read_optional, view, Whole};
use crate::shared::Shared;
use forgetting_runtime::NumberType;
use pyo3::prelude::*;

/// The sum of phi.T @ phi over the last samples, in O(n**2) a sample.
///
/// Parameters
/// ----------
/// parameters, window, rows : int
///     n, the number N of samples, and the rows of each.
#[pyclass(frozen, subclass, module = "forgetting")]
pub struct InformationWindow(Shared<forgetting_runtime::InformationWindow>);

#[pymethods]
impl InformationWindow {
    #[new]
    #[pyo3(signature = (parameters, window, rows=Whole(1)), text_signature = "(parameters, window, rows=1)")]
    fn new(parameters: Whole, window: Whole, rows: Whole) -> PyResult<Self> {
        let window = forgetting_runtime::InformationWindow::new(parameters.0, window.0, rows.0);
        window.map(Shared::new).map(Self).map_err(raise)
    }

    /// Take one sample: (n,) or (rows, n), with the noise covariance gamma.
    #[pyo3(signature = (phi, gamma=None))]
    fn add(&self, phi: &Bound<'_, PyAny>, gamma: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let values = phi;
        let phi = Input::read("phi", values, NumberType::F64)?;
        let gamma = read_optional("gamma", gamma, NumberType::F64)?;
        let mut window = self.0.lock(values.py())?;
        window.add(phi.view("phi")?, view("gamma", &gamma)?).map_err(raise)
    }

    /// The sum, (n, n), in units of phi**2.
    #[getter]
    fn information<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.0.lock(py)?.information().map_err(raise)?)
    }

    /// Size below which an eigenvalue of the sum cannot be told from rounding.
    #[getter]
    fn noise(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.0.lock(py)?.noise())
    }

    /// Samples taken so far.
    #[getter]
    fn seen(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.0.lock(py)?.samples())
    }

    /// Samples in a full window.
    #[getter]
    fn window(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.0.lock(py)?.window())
    }
}
