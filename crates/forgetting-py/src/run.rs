//! The results of a record, for Python.

use crate::arrays::optional;
use crate::pickle::{reduce, Reduced};
use pyo3::prelude::*;

/// Declares the class with an attribute for each output, so that their names stand once.
macro_rules! outputs {
    ($(#[$about:meta])* pub struct $Run:ident { $($name:ident,)* }) => {
        $(#[$about])*
        pub struct $Run {
            $($name: Option<Py<PyAny>>,)*
            samples: usize,
            used: usize,
            skipped_count: usize,
            reweighted: bool,
        }

        /// The outputs, as the attributes are called.
        const OUTPUTS: &[&str] = &[$(stringify!($name)),*];

        impl $Run {
            /// With the output that `take` has for each name.
            fn of(
                mut take: impl FnMut(&str) -> PyResult<Option<Py<PyAny>>>,
                (samples, used, reweighted): (usize, usize, bool),
            ) -> PyResult<Self> {
                $(let $name = take(stringify!($name))?;)*
                Ok(Self { $($name,)* samples, used, skipped_count: samples - used, reweighted })
            }
        }
    };
}

outputs! {
/// Results of `RLS.run` and `Bank.run`, one entry a sample; an output that was not asked for is None.
///
/// Attributes
/// ----------
/// theta : ndarray (T, n) or (T, n, targets)
///     Estimate after each sample.
/// error : ndarray (T, rows) or (T, rows, targets)
///     y - phi @ theta with the theta of before, in units of y; NaN where a value is missing.
/// leverage : ndarray (T,)
///     Variance of the prediction in units of the noise variance.
/// forgetting_factor : ndarray (T,)
///     Forgetting factor used; 1 where the sample was skipped as missing.
/// rank : ndarray (T,) of int64
///     Number of directions that lost information.
/// skipped : ndarray (T,) of uint8
///     Code of the reason, see `forgetting.SKIPPED`; 0 where the sample was used.
/// gate : ndarray (T,) of uint8
///     Code of what the gate said, see `forgetting.GATE`; 0 where it was open.
/// windup : ndarray (T,) of bool
///     Whether the covariance has grown to more than ten times its first value.
/// whitened_innovation : ndarray (T, rows) or (T, rows, targets)
///     solve(L, error) with L @ L.T = gamma + phi @ P @ phi.T, L lower triangular and P that after
///     forgetting; NaN where a value is missing. See `Update`.
/// variance : ndarray (T, n)
///     Diagonal of P after each sample.
/// covariance : ndarray (T, n, n)
///     P after each sample.
/// prior_covariance : ndarray (T, n, n)
///     P after forgetting and before the data of each sample.
/// weights : ndarray (T, members)
///     Of a bank: how far each member was believed in the prediction of the sample.
/// memory : ndarray (T,)
///     Of a bank: over how many samples it remembers, after the sample.
/// weight : ndarray (T,)
///     Gamma of each sample was divided by this: by the weight of the weighting, and by what the rule
///     made of the sample (`data_dependent`, `efra`).
/// reweighted : bool
///     Whether any weight is not 1, also where they are not kept.
/// samples, used, skipped_count : int
///     Number of samples in the record, used, and left out.
#[pyclass(frozen, get_all, module = "forgetting")]
pub struct Run {
    theta,
    error,
    leverage,
    forgetting_factor,
    rank,
    skipped,
    gate,
    windup,
    whitened_innovation,
    variance,
    covariance,
    prior_covariance,
    weight,
    weights,
    memory,
}
}

impl Run {
    /// From the results of the run time.
    pub fn new(py: Python<'_>, mut run: forgetting_runtime::Run) -> PyResult<Self> {
        let counts = (run.samples, run.used, run.reweighted);
        Self::of(|name| optional(py, run.take(name)), counts)
    }
}

#[pymethods]
impl Run {
    /// Names of all outputs.
    #[classattr]
    fn _outputs() -> Vec<&'static str> {
        OUTPUTS.to_vec()
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let Self { samples, used, .. } = slf.get();
        let mut kept = Vec::new();
        for name in OUTPUTS {
            let output = slf.getattr(*name)?;
            if !output.is_none() {
                kept.push(format!("{name} {}", output.getattr("shape")?));
            }
        }
        Ok(format!("Run({samples} samples, {used} used; {})", kept.join(", ")))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (make, outputs) = reduce(slf, OUTPUTS)?;
        let Self { samples, used, reweighted, .. } = slf.get();
        let values = (outputs, *samples, *used, *reweighted).into_pyobject(slf.py())?;
        Ok((make, values))
    }

    #[staticmethod]
    fn _of(
        outputs: [Option<Py<PyAny>>; OUTPUTS.len()],
        samples: usize,
        used: usize,
        reweighted: bool,
    ) -> PyResult<Self> {
        let mut outputs = outputs.into_iter();
        Self::of(|_| Ok(outputs.next().flatten()), (samples, used, reweighted))
    }
}
