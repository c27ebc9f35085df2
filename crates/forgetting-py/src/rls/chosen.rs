//! What an `RLS` was made with, and how it fares.

use super::Rls;
use crate::settings::{write_description, write_health};
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[pymethods]
impl Rls {
    /// How far the estimate can be trusted now.
    ///
    /// Parameters
    /// ----------
    /// exact : bool, default False
    ///     Eigenvalues of P themselves, in O(n**3); else bounds from its factor, in O(n).
    ///
    /// Returns
    /// -------
    /// Health
    #[pyo3(signature = (exact=false))]
    fn health<'py>(slf: &Bound<'py, Self>, exact: bool) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("forgetting.health")?.call_method1("health_of", (slf, exact))
    }

    /// What the monitor has seen, as a dictionary; None without one.
    fn watched<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let health = self.estimator.lock(py)?.health();
        health.map(|health| write_health(py, health)).transpose()
    }

    /// The rule, rate, weighting and gate by name, each with its parameters.
    fn describe<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let description = self.estimator.lock(py)?.describe();
        write_description(py, &description)
    }

    /// The forgetting rule, as an object that would make the same one.
    #[getter]
    fn rule<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("forgetting.choices")?
            .call_method1("rule_from_description", (self.describe(py)?, self.dtype()))
    }

    /// The weighting, as an object that would make the same one.
    #[getter]
    fn weighting<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("forgetting.choices")?
            .call_method1("weighting_from_description", (self.describe(py)?, self.dtype()))
    }

    /// The gate, as an object that would make the same one.
    #[getter]
    fn gate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("forgetting.choices")?
            .call_method1("gate_from_description", (self.describe(py)?, self.dtype()))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let rule = self.rule(py)?.repr()?;
        let (n, p, m) = (self.parameters(), self.rows(), self.targets());
        let samples = self.samples(py)?;
        Ok(format!("RLS({n}, rule={rule}, rows={p}, targets={m}) after {samples} samples"))
    }
}
