//! What an `RLS` makes of samples.

use super::Rls;
use crate::arrays::{output_or_float, Input};
use crate::bounds::{BoundsInput, Pair};
use crate::errors::{heed_signals, raise};
use crate::prediction::interval;
use crate::run::Run;
use crate::samples::Samples;
use crate::settings::Names;
use crate::time::{read_elapsed, read_times};
use crate::update::Update;
use forgetting_runtime::{Missing, UpdateOptions};
use pyo3::prelude::*;

#[pymethods]
impl Rls {
    /// phi @ theta; with a level the interval that holds the next measurement, too.
    ///
    /// Parameters
    /// ----------
    /// phi : (n,) or (T, n) array
    /// level : float, optional
    ///     Share of measurements that the interval holds, between 0 and 1; see `forgetting.predict`.
    /// errors : (T,) array, optional
    ///     One-step errors so far, of which the interval is then made.
    ///
    /// Returns
    /// -------
    /// float, (targets,), (T,) or (T, targets); with a level a `Prediction` of three
    #[pyo3(signature = (phi, level=None, *, errors=None))]
    fn predict<'py>(
        slf: &Bound<'py, Self>,
        phi: &Bound<'py, PyAny>,
        level: Option<&Bound<'py, PyAny>>,
        errors: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if let Some(level) = level {
            return interval(slf, phi, level, errors);
        }
        let (py, this) = (slf.py(), slf.get());
        let phi = Input::read("phi", phi, this.number_type)?;
        let estimator = this.estimator.lock(py)?;
        output_or_float(py, estimator.predict(phi.view("phi")?).map_err(raise)?)
    }

    /// Take one sample.
    ///
    /// Parameters
    /// ----------
    /// phi : (n,) or (rows, n) array
    /// y : float, (rows,), (targets,) or (rows, targets) array
    /// gamma : float or (rows, rows) array, optional
    ///     Noise covariance of the sample, positive definite; 1 if not given.
    /// elapsed : float or duration, optional
    ///     Time since the last sample, in the unit of time in which forgetting is stated (a duration
    ///     counts in seconds); 1 if not given. A forgetting factor becomes its power, at least 1/1024,
    ///     and process noise a multiple.
    /// missing : {"error", "skip"}
    ///     What to do with a sample that has a NaN: refuse it, or leave it out.
    ///
    /// Returns
    /// -------
    /// Update
    ///
    /// Raises
    /// ------
    /// InvalidInput
    ///     For a wrong shape, NaN or Inf, or a gamma that is not positive definite.
    /// NumericalRange
    ///     When the sample is too large. In either case nothing has changed. A covariance that has no
    ///     room to grow any more stays: `rank` is 0, and `windup` true.
    #[pyo3(signature = (phi, y, gamma=None, *, elapsed=None, missing="error"))]
    fn update(
        &self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
        elapsed: Option<&Bound<'_, PyAny>>,
        missing: &str,
    ) -> PyResult<Update> {
        let samples = Samples::read(|name, values| self.input(name, values), phi, y, gamma)?;
        let missing = Missing::named(missing).map_err(raise)?;
        let options = UpdateOptions { elapsed: read_elapsed(elapsed)?, missing };
        let mut estimator = self.estimator.lock(py)?;
        estimator.update_with(samples.views()?, options).map(Update).map_err(raise)
    }

    /// Take a whole record, without Python in the loop and without holding the interpreter.
    ///
    /// Equal to one `update` a sample: bit for bit up to ten parameters, to rounding above, where
    /// several samples are taken together.
    ///
    /// Parameters
    /// ----------
    /// phi : (T, n) or (T, rows, n) array
    /// y : (T,), (T, rows), (T, targets) or (T, rows, targets) array
    /// gamma : float, (rows, rows), (T,) or (T, rows, rows) array, optional
    ///     Noise covariance, the same for all samples or one a sample.
    /// outputs : str or sequence of str, optional
    ///     What to keep: names of attributes of `Run`.
    /// missing : {"error", "skip"}
    ///     What to do with a sample that has a NaN: refuse the record, or leave the sample out.
    /// time : (T,) or (T + 1,) array of numbers or dates, optional
    ///     When samples were taken, not decreasing, with the time of the last sample before them or
    ///     without; see `elapsed` of `update`. If not given, each sample takes one unit of time. A
    ///     sample that is left out takes none: its time is the next one's.
    /// bounds : pair of (n,) array, optional
    ///     Smallest and largest value of each parameter, -inf and inf where there is none. After each
    ///     sample theta is moved to the nearest point within them, as by
    ///     ``est.theta = bounded(est.theta, est.covariance, lower, upper)``, and goes on from there:
    ///     for true parameters within the bounds the error, weighed by P⁻¹, never rises by that.
    ///     Of estimators with one target.
    ///
    /// Returns
    /// -------
    /// Run
    ///
    /// Raises
    /// ------
    /// InvalidInput, NumericalRange
    ///     Names the sample and what is wrong with it; the estimator is as it was before the
    ///     record.
    ///
    /// Examples
    /// --------
    /// >>> import numpy as np
    /// >>> import forgetting as fg
    /// >>> phi = np.array([[1.0, 0.5], [1.0, 0.6], [1.0, 0.4]])
    /// >>> run = fg.RLS(2, rule="none").run(phi, [-1.0, 2.0, 1.0], bounds=([0.0, 0.0], [1.0, 1.0]))
    /// >>> bool((run.theta >= 0.0).all() and (run.theta <= 1.0).all())
    /// True
    #[pyo3(signature = (phi, y, gamma=None, outputs=None, missing="error", *, time=None, bounds=None))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn run(
        &self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
        outputs: Option<Names>,
        missing: &str,
        time: Option<&Bound<'_, PyAny>>,
        bounds: Option<Pair<'_>>,
    ) -> PyResult<Run> {
        let missing = Missing::named(missing).map_err(raise)?;
        let bounds = BoundsInput::read(bounds.as_ref())?;
        let samples = Samples::read(|name, values| self.input(name, values), phi, y, gamma)?;
        let times = read_times(time)?;
        let mut held = self.estimator.lock(py)?;
        let estimator = &mut *held;
        samples.run(py, (missing, outputs, times.as_ref()), bounds.as_ref(), |record, options| {
            estimator.run_while(record, options, &mut heed_signals)
        })
    }

    /// Back to the initial estimate and covariance, as if no sample had been seen.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.estimator.lock(py)?.reset();
        Ok(())
    }
}
