//! Calls from Python that do nothing, with the arguments of `RLS.update`.

use pyo3::prelude::*;

/// As many numbers as `Update` has.
#[pyclass(frozen)]
struct Answer {
    #[pyo3(get)]
    error: f64,
    #[pyo3(get)]
    leverage: f64,
    #[pyo3(get)]
    forgetting_factor: f64,
    #[pyo3(get)]
    rank: usize,
}

/// An estimator that estimates nothing.
#[pyclass]
struct Empty {
    samples: u64,
}

#[pymethods]
impl Empty {
    #[new]
    fn new() -> Self {
        Self { samples: 0 }
    }

    /// Takes the arguments and returns None.
    #[pyo3(signature = (phi, y, gamma=None))]
    fn update(
        &mut self,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
    ) {
        let _ = (phi, y, gamma);
        self.samples += 1;
    }

    /// The same, and returns a new object.
    #[pyo3(signature = (phi, y, gamma=None))]
    fn answer(
        &mut self,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
    ) -> Answer {
        self.update(phi, y, gamma);
        Answer { error: 0.0, leverage: 0.0, forgetting_factor: 1.0, rank: 0 }
    }
}

#[pymodule]
fn noop(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Empty>()
}
