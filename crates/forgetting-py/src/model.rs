//! The class `SignalModel`, on which the model classes of the package stand.

use crate::arrays::{output, Input};
use crate::bank::Bank;
use crate::errors::{heed_signals, invalid, raise};
use crate::rls::Rls;
use crate::settings::{names, Names, Whole};
use crate::shared::Shared;
use forgetting_runtime::{InputOrders, Learner, Model, NumberType, Orders, STRUCTURES};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyType};

/// A model A y = sum of B/F u + C/D e + constant while samples come: it makes of them what an
/// estimator takes.
///
/// Parameters
/// ----------
/// na, nc, nd : int
///     Coefficients of A, C and D.
/// inputs : sequence of (nb, nf, nk)
///     Coefficients of B and F and the delay of each input.
/// constant : bool
///     Whether there is a constant.
/// method : {"prediction_error", "extended_least_squares"}
///     Whether the gradient of the prediction is the regressor, or what the prediction is made of.
///
/// Raises
/// ------
/// InvalidInput
///     Names the order and what is allowed.
#[pyclass(frozen, module = "forgetting._core")]
pub struct SignalModel(Shared<Model>);

#[pymethods]
impl SignalModel {
    #[new]
    #[pyo3(signature = (*, na=Whole(0), nc=Whole(0), nd=Whole(0), inputs=Vec::new(), constant=false,
        method="prediction_error"),
        text_signature = "(*, na=0, nc=0, nd=0, inputs=(), constant=False, \
        method='prediction_error')")]
    fn new(
        na: Whole,
        nc: Whole,
        nd: Whole,
        inputs: Vec<(Whole, Whole, Whole)>,
        constant: bool,
        method: &str,
    ) -> PyResult<Self> {
        let of_input = |(nb, nf, nk)| -> PyResult<InputOrders> {
            Ok(InputOrders { nb: order("nb", nb)?, nf: order("nf", nf)?, nk: order("nk", nk)? })
        };
        let inputs: PyResult<Vec<_>> = inputs.into_iter().map(of_input).collect();
        let (na, nc, nd) = (order("na", na)?, order("nc", nc)?, order("nd", nd)?);
        let orders = Orders { na, nc, nd, inputs: inputs?, constant };
        Ok(Self(Shared::new(Model::new(orders, method).map_err(raise)?)))
    }

    /// Take a record of T samples through an estimator of as many parameters.
    ///
    /// Parameters
    /// ----------
    /// estimator : RLS or Bank
    /// u : (T, inputs) array
    /// y : (T,) array
    ///     NaN for what is missing: such a sample, and every later one whose lags reach it, is left out.
    /// outputs : str or sequence of str
    ///     What to keep: "phi" and "y", which the estimator was given, "error", "theta", "scale" or
    ///     "skipped".
    ///
    /// Returns
    /// -------
    /// dict of str to ndarray, with "used": the number of samples that the estimator used
    ///
    /// Raises
    /// ------
    /// InvalidInput, NumericalRange
    ///     Names the sample and what is wrong with it; nothing has changed.
    #[pyo3(signature = (estimator, u, y, outputs=None))]
    fn learn<'py>(
        &self,
        py: Python<'py>,
        estimator: &Bound<'py, PyAny>,
        u: &Bound<'py, PyAny>,
        y: &Bound<'py, PyAny>,
        outputs: Option<Names>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let u = Input::read("u", u, NumberType::F64)?;
        let y = Input::read("y", y, NumberType::F64)?;
        let record = (u.view("u")?, y.view("y")?);
        let outputs = names(outputs.as_ref()).unwrap_or_default();
        let mut held = self.0.lock(py)?;
        let model = &mut *held;
        let mut learn = |learner: Learner<'_>| {
            py.detach(|| model.learn(learner, record, &outputs, &mut heed_signals)).map_err(raise)
        };
        let run = if let Ok(own) = estimator.cast::<Rls>() {
            learn(Learner::Estimator(&mut *own.get().estimator.lock(py)?))
        } else if let Ok(own) = estimator.cast::<Bank>() {
            learn(Learner::Bank(&mut *own.get().bank.lock(py)?))
        } else {
            Err(invalid(format!("estimator = {estimator:?}, allowed: an RLS or a Bank")))
        }?;
        let kept = PyDict::new(py);
        kept.set_item("used", run.used)?;
        for (name, array) in run.outputs {
            kept.set_item(name, output(py, array)?)?;
        }
        Ok(kept)
    }

    /// Predict each y (T,) one sample ahead with theta as it is, from rest or going on from the last
    /// sample; where y is NaN its prediction stands for it.
    #[pyo3(signature = (u, y, *, from_rest=true))]
    fn predict<'py>(
        &self,
        py: Python<'py>,
        u: &Bound<'py, PyAny>,
        y: &Bound<'py, PyAny>,
        from_rest: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let u = Input::read("u", u, NumberType::F64)?;
        let y = Input::read("y", y, NumberType::F64)?;
        let record = (u.view("u")?, y.view("y")?);
        output(py, self.0.lock(py)?.predict(record, from_rest).map_err(raise)?)
    }

    /// The estimate, (n,): that of the estimator, or as far on the way there as C and F are stable.
    #[getter]
    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        output(py, self.0.lock(py)?.theta())
    }

    /// Number of parameters: a, b of each input, c, d, f of each input, the constant.
    #[getter]
    fn parameters(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.0.lock(py)?.orders().parameters())
    }

    /// Samples so far.
    #[getter]
    fn samples(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.0.lock(py)?.samples())
    }

    /// The model, orders and state, as bytes: portable, versioned and checked.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &self.0.lock(py)?.to_bytes()))
    }

    /// The model that `to_bytes` saved, bit for bit.
    #[classmethod]
    fn from_bytes(_: &Bound<'_, PyType>, state: &[u8]) -> PyResult<Self> {
        Ok(Self(Shared::new(Model::from_bytes(state).map_err(raise)?)))
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = slf.getattr("from_bytes")?;
        Ok((restore, (slf.get().to_bytes(slf.py())?,)))
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        Ok(Self(Shared::new(self.0.lock(py)?.clone())))
    }

    fn __deepcopy__(&self, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.__copy__(memo.py())
    }
}

/// The structures that have a name: each with its title, the orders that are chosen, and its purpose.
#[pyfunction]
pub fn structures(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let all = PyDict::new(py);
    for structure in STRUCTURES {
        let about = (structure.title, structure.orders, structure.purpose);
        all.set_item(structure.name, about)?;
    }
    Ok(all)
}

/// An order as a size; what is below 0 is refused here, what is too large by the model.
fn order(name: &'static str, Whole(order): Whole) -> PyResult<usize> {
    usize::try_from(order)
        .map_err(|_| invalid(format!("{name} = {order}, allowed: whole numbers from 0 to 4096")))
}
