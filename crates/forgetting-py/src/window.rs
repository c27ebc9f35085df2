//! The class `InformationWindow`.

use crate::arrays::{shaped, with_slice, Array};
use crate::configure::read_sizes;
use crate::errors::raise;
use forgetting::InformationWindow as Window;
use pyo3::prelude::*;

/// The sum of phi.T @ phi over the last samples, in O(n**2) a sample.
///
/// Parameters
/// ----------
/// parameters, window, rows : int
///     n, the number N of samples, and the rows of each.
#[pyclass(subclass, module = "forgetting")]
pub struct InformationWindow {
    window: Window<f64>,
    parameters: usize,
}

#[pymethods]
impl InformationWindow {
    #[new]
    #[pyo3(signature = (parameters, window, rows=1))]
    fn new(parameters: i64, window: i64, rows: i64) -> PyResult<Self> {
        let sizes = [("parameters", parameters), ("window", window), ("rows", rows)];
        let [parameters, window, rows] = read_sizes(sizes)?;
        let window = Window::new(parameters, rows, window).map_err(raise)?;
        Ok(Self { window, parameters })
    }

    /// Take one sample, whitened: (n,) or (rows, n).
    fn add(&mut self, phi: Array<'_, '_>) -> PyResult<()> {
        with_slice("phi", phi, |phi| self.window.add(phi).map_err(raise))
    }

    /// The sum, (n, n), in units of phi**2.
    #[getter]
    fn information<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let n = self.parameters;
        let mut information = vec![0.0; n * n];
        self.window.information(&mut information).map_err(raise)?;
        shaped(py, information, &[n, n])
    }

    /// Size below which an eigenvalue of the sum cannot be told from rounding.
    #[getter]
    fn noise(&self) -> f64 {
        self.window.noise()
    }

    /// Samples taken so far.
    #[getter]
    fn seen(&self) -> u64 {
        self.window.samples()
    }

    /// Samples in a full window.
    #[getter]
    fn window(&self) -> usize {
        self.window.window()
    }
}
