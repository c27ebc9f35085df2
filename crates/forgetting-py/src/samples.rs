//! Samples and records from Python, whatever estimator takes them.

use crate::arrays::Input;
use crate::bounds::BoundsInput;
use crate::errors::raise;
use crate::run::Run;
use crate::settings::{names, view, Names};
use crate::time::times_input;
use forgetting_runtime::{Error, Missing, RunOptions, View};
use pyo3::prelude::*;

/// φ, y and Γ of a sample or a record.
pub struct Samples<'a, 'py> {
    phi: Input<'a, 'py>,
    y: Input<'a, 'py>,
    gamma: Option<Input<'a, 'py>>,
}

/// The same in their shapes.
type Views<'a> = (View<'a>, View<'a>, Option<View<'a>>);

impl<'a, 'py> Samples<'a, 'py> {
    /// Each by `read`, which is told its name.
    ///
    /// # Errors
    /// Those of `read`.
    #[inline(always)]
    pub fn read(
        read: impl Fn(&str, &'a Bound<'py, PyAny>) -> PyResult<Input<'a, 'py>>,
        phi: &'a Bound<'py, PyAny>,
        y: &'a Bound<'py, PyAny>,
        gamma: Option<&'a Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let (phi, y) = (read("phi", phi)?, read("y", y)?);
        Ok(Self { phi, y, gamma: gamma.map(|gamma| read("gamma", gamma)).transpose()? })
    }

    /// φ, y and Γ in their shapes; see [`Input::numbers`].
    #[inline(always)]
    pub fn views(&self) -> PyResult<Views<'_>> {
        Ok((self.phi.view("phi")?, self.y.view("y")?, view("gamma", &self.gamma)?))
    }

    /// What `run` makes of them as a record, with estimates within bounds if there are any, without
    /// holding the interpreter.
    ///
    /// # Errors
    /// `InvalidInput` names `time` when its values are not numbers; those of `run`.
    pub fn run(
        &self,
        py: Python<'_>,
        (missing, outputs, times): (Missing, Option<Names>, Option<&Bound<'py, PyAny>>),
        bounds: Option<&BoundsInput<'_, 'py>>,
        run: impl FnOnce(Views<'_>, &RunOptions<'_>) -> Result<forgetting_runtime::Run, Error> + Send,
    ) -> PyResult<Run> {
        let (record, outputs, times) =
            (self.views()?, names(outputs.as_ref()), times_input(times)?);
        let options = RunOptions {
            time: view("time", &times)?,
            bounds: bounds.map(BoundsInput::view).transpose()?,
            ..RunOptions::new(missing, outputs.as_deref())
        };
        let run = py.detach(|| run(record, &options));
        Run::new(py, run.map_err(raise)?)
    }
}
