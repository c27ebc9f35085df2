//! What a `Bank` makes of samples.

use super::Bank;
use crate::arrays::output_or_float;
use crate::bank_update::BankUpdate;
use crate::errors::{heed_signals, raise};
use crate::prediction::interval;
use crate::run::Run;
use crate::samples::Samples;
use crate::settings::Names;
use crate::time::{read_elapsed, read_times};
use forgetting_runtime::{Missing, UpdateOptions};
use pyo3::prelude::*;

#[pymethods]
impl Bank {
    /// phi @ theta; with a level the interval that holds the next measurement, too.
    ///
    /// Parameters
    /// ----------
    /// phi : (n,) or (T, n) array
    /// level : float, optional
    ///     Share of measurements that the interval holds, between 0 and 1; see `forgetting.predict`.
    /// errors : (T,) array, optional
    ///     One-step errors so far, of which the interval is then made; a bank needs them.
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
        let phi = this.input("phi", phi)?;
        let bank = this.bank.lock(py)?;
        output_or_float(py, bank.predict(phi.view("phi")?).map_err(raise)?)
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
    /// BankUpdate
    ///
    /// Raises
    /// ------
    /// InvalidInput
    ///     For a wrong shape, NaN or Inf, or a gamma that is not positive definite.
    /// NumericalRange
    ///     When no member could take the sample. In either case nothing has changed.
    #[pyo3(signature = (phi, y, gamma=None, *, elapsed=None, missing="error"))]
    fn update(
        &self,
        py: Python<'_>,
        phi: &Bound<'_, PyAny>,
        y: &Bound<'_, PyAny>,
        gamma: Option<&Bound<'_, PyAny>>,
        elapsed: Option<&Bound<'_, PyAny>>,
        missing: &str,
    ) -> PyResult<BankUpdate> {
        let samples = Samples::read(|name, values| self.input(name, values), phi, y, gamma)?;
        let missing = Missing::named(missing).map_err(raise)?;
        let options = UpdateOptions { elapsed: read_elapsed(elapsed)?, missing };
        let mut bank = self.bank.lock(py)?;
        bank.update_with(samples.views()?, options).map(BankUpdate).map_err(raise)
    }

    /// Take a whole record, without Python in the loop and without holding the interpreter.
    ///
    /// Parameters
    /// ----------
    /// phi : (T, n) or (T, rows, n) array
    /// y : (T,), (T, rows), (T, targets) or (T, rows, targets) array
    /// gamma : float, (rows, rows), (T,) or (T, rows, rows) array, optional
    ///     Noise covariance, the same for all samples or one a sample.
    /// outputs : str or sequence of str, optional
    ///     What to keep: "theta", "error", "leverage", "forgetting_factor", "skipped", "windup",
    ///     "variance", "covariance", "weights" or "memory".
    /// missing : {"error", "skip"}
    ///     What to do with a sample that has a NaN: refuse the record, or leave the sample out.
    /// time : (T,) or (T + 1,) array of numbers or dates, optional
    ///     When samples were taken, not decreasing, with the time of the last sample before them or
    ///     without; see `elapsed` of `update`. If not given, each sample takes one unit of time. A
    ///     sample that is left out takes none: its time is the next one's.
    ///
    /// Returns
    /// -------
    /// Run
    ///
    /// Raises
    /// ------
    /// InvalidInput, NumericalRange
    ///     Names the sample and what is wrong with it; the bank is as it was before the record.
    #[pyo3(signature = (phi, y, gamma=None, outputs=None, missing="error", *, time=None))]
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
    ) -> PyResult<Run> {
        let missing = Missing::named(missing).map_err(raise)?;
        let samples = Samples::read(|name, values| self.input(name, values), phi, y, gamma)?;
        let times = read_times(time)?;
        let mut held = self.bank.lock(py)?;
        let bank = &mut *held;
        samples.run(py, (missing, outputs, times.as_ref()), None, |record, options| {
            bank.run_while(record, options, &mut heed_signals)
        })
    }

    /// Back to the start, as if no sample had been seen.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        self.bank.lock(py)?.reset();
        Ok(())
    }
}
