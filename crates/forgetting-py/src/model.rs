//! The class `SignalModel`, on which the model classes of the package stand.

use crate::arrays::{output, Input};
use crate::bank::Bank;
use crate::bounds::{BoundsInput, Pair};
use crate::errors::{heed_signals, invalid, raise};
use crate::pickle::bytes;
use crate::rls::Rls;
use crate::settings::{names, Names, Whole};
use crate::shared::Shared;
use forgetting_runtime::{Given, InputOrders, Learner, Model, NumberType, Orders, STRUCTURES};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyType};
use std::collections::HashMap;

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
/// fixed, prior : dict of int to float, optional
///     What is known of parameters, by their places: values that are exact, which the estimator does not
///     have, and values from which it says how far the parameters are. A constant of which something is
///     known is that of signals measured from zero; of others from their first values.
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
        method="prediction_error", fixed=None, prior=None),
        text_signature = "(*, na=0, nc=0, nd=0, inputs=(), constant=False, \
        method='prediction_error', fixed=None, prior=None)")]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        na: Whole,
        nc: Whole,
        nd: Whole,
        inputs: Vec<(Whole, Whole, Whole)>,
        constant: bool,
        method: &str,
        fixed: Option<HashMap<usize, f64>>,
        prior: Option<HashMap<usize, f64>>,
    ) -> PyResult<Self> {
        let of_input = |(nb, nf, nk)| -> PyResult<InputOrders> {
            Ok(InputOrders { nb: order("nb", nb)?, nf: order("nf", nf)?, nk: order("nk", nk)? })
        };
        let inputs: PyResult<Vec<_>> = inputs.into_iter().map(of_input).collect();
        let (na, nc, nd) = (order("na", na)?, order("nc", nc)?, order("nd", nd)?);
        let orders = Orders { na, nc, nd, inputs: inputs?, constant };
        let model = Model::new(orders, method).map_err(raise)?;
        let (fixed, prior) = (fixed.unwrap_or_default(), prior.unwrap_or_default());
        let given = given(model.orders().parameters(), &fixed, &prior)?;
        let informed = !(fixed.is_empty() && prior.is_empty());
        let model = if informed { model.knowing(&given).map_err(raise)? } else { model };
        Ok(Self(Shared::new(model)))
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
    ///     "skipped"; and outputs of the estimator, names of attributes of `Run`, for the parameters that
    ///     are estimated.
    /// bounds : pair of (estimated,) array, optional
    ///     As of `RLS.run`, for the parameters that are estimated, less their priors.
    ///
    /// Returns
    /// -------
    /// dict of str to ndarray, with "used": the number of samples that the estimator used
    ///
    /// Raises
    /// ------
    /// InvalidInput, NumericalRange
    ///     Names the sample and what is wrong with it; nothing has changed.
    #[pyo3(signature = (estimator, u, y, outputs=None, *, bounds=None))]
    fn learn<'py>(
        &self,
        py: Python<'py>,
        estimator: &Bound<'py, PyAny>,
        u: &Bound<'py, PyAny>,
        y: &Bound<'py, PyAny>,
        outputs: Option<Names>,
        bounds: Option<Pair<'py>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let bounds = BoundsInput::read(bounds.as_ref())?;
        let bounds = bounds.as_ref().map(BoundsInput::view).transpose()?;
        let u = Input::read("u", u, NumberType::F64)?;
        let y = Input::read("y", y, NumberType::F64)?;
        let record = (u.view("u")?, y.view("y")?);
        let outputs = names(outputs.as_ref()).unwrap_or_default();
        let mut held = self.0.lock(py)?;
        let model = &mut *held;
        let mut learn = |learner: Learner<'_>| {
            let how = (&outputs[..], bounds);
            py.detach(|| model.learn(learner, record, how, &mut heed_signals)).map_err(raise)
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

    /// Number of parameters that are estimated: all but those that are fixed.
    #[getter]
    fn estimated(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.0.lock(py)?.estimated())
    }

    /// Samples so far.
    #[getter]
    fn samples(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.0.lock(py)?.samples())
    }

    /// The model, orders and state, as bytes: portable, versioned and checked.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        bytes(py, &self.0.lock(py)?.to_bytes())
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

/// What is known of each of n parameters.
fn given(
    n: usize,
    fixed: &HashMap<usize, f64>,
    prior: &HashMap<usize, f64>,
) -> PyResult<Vec<Given>> {
    let places = fixed.keys().chain(prior.keys());
    if let Some(place) = places.copied().find(|&place| place >= n) {
        let last = n - 1;
        return Err(invalid(format!("place {place} of what is known, allowed: 0 to {last}")));
    }
    let of = |place| match (fixed.get(&place), prior.get(&place)) {
        (Some(&value), _) => Given::Fixed(value),
        (None, Some(&value)) => Given::Prior(value),
        (None, None) => Given::Nothing,
    };
    Ok((0..n).map(of).collect())
}

/// An order as a size; what is below 0 is refused here, what is too large by the model.
fn order(name: &'static str, Whole(order): Whole) -> PyResult<usize> {
    usize::try_from(order)
        .map_err(|_| invalid(format!("{name} = {order}, allowed: whole numbers from 0 to 4096")))
}
