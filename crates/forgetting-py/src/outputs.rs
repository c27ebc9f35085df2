//! The results of a record: each output grows sample by sample, if it was asked for.

use crate::arrays::{shaped, Number, Stored};
use crate::errors::invalid;
use forgetting::gates::Answer;
use forgetting::saved::AnyEstimator;
use forgetting::Outcome;
use forgetting::{Dynamic, Factor, Memory, Skip, Update};
use pyo3::prelude::*;

/// Results of `RLS.run`, one entry a sample; an output that was not asked for is None.
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
/// samples, used, skipped_count : int
///     Number of samples in the record, used, and left out.
#[pyclass(frozen, get_all, module = "forgetting")]
pub struct Run {
    theta: Option<Py<PyAny>>,
    error: Option<Py<PyAny>>,
    leverage: Option<Py<PyAny>>,
    forgetting_factor: Option<Py<PyAny>>,
    rank: Option<Py<PyAny>>,
    skipped: Option<Py<PyAny>>,
    gate: Option<Py<PyAny>>,
    windup: Option<Py<PyAny>>,
    whitened_innovation: Option<Py<PyAny>>,
    variance: Option<Py<PyAny>>,
    covariance: Option<Py<PyAny>>,
    prior_covariance: Option<Py<PyAny>>,
    samples: usize,
    used: usize,
    skipped_count: usize,
}

/// Names of the outputs that are kept when none are named.
pub const DEFAULT_OUTPUTS: [&str; 6] =
    ["theta", "error", "leverage", "forgetting_factor", "rank", "skipped"];
const ALL_OUTPUTS: [&str; 12] = [
    "theta",
    "error",
    "leverage",
    "forgetting_factor",
    "rank",
    "skipped",
    "gate",
    "windup",
    "whitened_innovation",
    "variance",
    "covariance",
    "prior_covariance",
];

/// The outputs as they grow.
pub struct Outputs<T> {
    theta: Option<Vec<T>>,
    error: Option<Vec<T>>,
    leverage: Option<Vec<T>>,
    forgetting_factor: Option<Vec<T>>,
    rank: Option<Vec<i64>>,
    skipped: Option<Vec<u8>>,
    gate: Option<Vec<u8>>,
    windup: Option<Vec<bool>>,
    whitened_innovation: Option<Vec<T>>,
    variance: Option<Vec<T>>,
    covariance: Option<Vec<T>>,
    prior_covariance: Option<Vec<T>>,
    used: usize,
}

/// Sizes of a record.
#[derive(Clone, Copy)]
pub struct Sizes {
    pub samples: usize,
    pub parameters: usize,
    pub rows: usize,
    pub targets: usize,
}

impl<T: Number> Outputs<T> {
    /// Room for the outputs of these names.
    ///
    /// # Errors
    /// `InvalidInput` for an unknown name.
    pub fn named(names: &[String], sizes: Sizes) -> PyResult<Self> {
        if let Some(name) = names.iter().find(|name| !ALL_OUTPUTS.contains(&name.as_str())) {
            return Err(invalid(format!(
                "outputs has {name:?}, allowed: {}",
                ALL_OUTPUTS.join(", ")
            )));
        }
        let wanted = |name: &str| names.iter().any(|n| n == name);
        let Sizes { samples, parameters: n, rows: p, targets: m } = sizes;
        let room = |name, width: usize| wanted(name).then(|| Vec::with_capacity(samples * width));
        Ok(Self {
            theta: room("theta", n * m),
            error: room("error", p * m),
            leverage: room("leverage", 1),
            forgetting_factor: room("forgetting_factor", 1),
            rank: wanted("rank").then(|| Vec::with_capacity(samples)),
            skipped: wanted("skipped").then(|| Vec::with_capacity(samples)),
            gate: wanted("gate").then(|| Vec::with_capacity(samples)),
            windup: wanted("windup").then(|| Vec::with_capacity(samples)),
            whitened_innovation: room("whitened_innovation", p * m),
            variance: room("variance", n),
            covariance: room("covariance", n * n),
            prior_covariance: room("prior_covariance", n * n),
            used: 0,
        })
    }

    /// Makes `estimator` keep what the outputs need beside what it keeps anyway.
    pub fn prepare(&self, estimator: &mut AnyEstimator<T>) {
        estimator.keep_innovations(self.whitened_innovation.is_some());
        estimator.keep_prior(self.prior_covariance.is_some());
    }

    /// What a sample told.
    #[inline(always)]
    pub fn note(&mut self, update: &Update<'_, T>) {
        if let Some(error) = &mut self.error {
            error.extend_from_slice(update.error);
        }
        push(&mut self.leverage, update.leverage);
        self.note_rest(update);
    }

    /// What samples of one row and one target told.
    pub fn note_all(&mut self, estimator: &AnyEstimator<T>, told: &[Outcome<T>]) {
        if let Some(error) = &mut self.error {
            error.extend(told.iter().map(|told| told.error));
        }
        if let Some(leverage) = &mut self.leverage {
            leverage.extend(told.iter().map(|told| told.leverage));
        }
        for told in told {
            self.note_rest(&estimator.report(told));
        }
    }

    /// All but errors and leverages.
    #[inline(always)]
    fn note_rest(&mut self, update: &Update<'_, T>) {
        push(&mut self.forgetting_factor, update.forgetting_factor);
        push(&mut self.rank, update.rank as i64);
        push(&mut self.skipped, update.skipped.map_or(0, Skip::code));
        push(&mut self.gate, update.gate.code());
        push(&mut self.windup, update.windup);
        if let Some(whitened) = &mut self.whitened_innovation {
            let start = whitened.len();
            whitened.resize(start + update.error.len(), T::ZERO);
            let kept = update.whiten(&mut whitened[start..]);
            debug_assert!(kept.is_ok(), "prepared for");
        }
        self.used += usize::from(update.skipped.is_none());
    }

    /// A sample that never reached the estimator, which stays as it is.
    pub fn note_missing(&mut self, width: usize) {
        let nothing = T::from_f64(f64::NAN);
        for output in [&mut self.error, &mut self.whitened_innovation].into_iter().flatten() {
            output.extend(std::iter::repeat_n(nothing, width));
        }
        push(&mut self.leverage, nothing);
        push(&mut self.forgetting_factor, T::ONE);
        push(&mut self.rank, 0);
        push(&mut self.skipped, Skip::Missing.code());
        push(&mut self.gate, Answer::Update.code());
        push(&mut self.windup, false);
    }

    /// Whether an output is taken from the estimator after each sample, other than θ.
    pub fn need_every_state(&self) -> bool {
        [&self.variance, &self.covariance, &self.prior_covariance].into_iter().any(Option::is_some)
    }

    /// Lets `update_many` write θ after each of at most `most` samples of n numbers, if θ is kept, and
    /// keeps those of as many samples as it says it took.
    pub fn with_thetas(
        &mut self,
        (most, n): (usize, usize),
        update_many: impl FnOnce(&mut [T]) -> usize,
    ) -> usize {
        let Some(theta) = &mut self.theta else { return update_many(&mut []) };
        let before = theta.len();
        theta.resize(before + most * n, T::ZERO);
        let taken = update_many(&mut theta[before..]);
        theta.truncate(before + taken * n);
        taken
    }

    /// P̄ of a sample, which is P where it was `missing`.
    #[inline(always)]
    pub fn note_prior(&mut self, estimator: &AnyEstimator<T>, missing: bool) {
        if let Some(covariance) = &mut self.prior_covariance {
            let prior = estimator.prior_factor().filter(|_| !missing);
            reconstruct(covariance, prior.unwrap_or(estimator.factor()));
        }
    }

    /// The state after a sample.
    #[inline(always)]
    pub fn note_state(&mut self, estimator: &AnyEstimator<T>) {
        let memory = estimator.prior().memory();
        let (n, m) = (memory.parameters(), memory.targets());
        if let Some(theta) = &mut self.theta {
            let now = estimator.theta();
            if m == 1 {
                theta.extend_from_slice(now);
            } else {
                theta.extend((0..n).flat_map(|i| (0..m).map(move |t| now[t * n + i])));
            }
        }
        if let Some(variance) = &mut self.variance {
            let start = variance.len();
            variance.resize(start + n, T::ZERO);
            estimator.factor().variances(&mut variance[start..]);
        }
        if let Some(covariance) = &mut self.covariance {
            reconstruct(covariance, estimator.factor());
        }
    }

    /// The outputs as arrays.
    pub fn finish(self, py: Python<'_>, sizes: Sizes) -> PyResult<Run> {
        let Sizes { samples, parameters: n, rows: p, targets: m } = sizes;
        let single = |shape: &[usize]| shape[..shape.len() - usize::from(m == 1)].to_vec();
        Ok(Run {
            theta: array(py, self.theta, &single(&[samples, n, m]))?,
            error: array(py, self.error, &single(&[samples, p, m]))?,
            leverage: array(py, self.leverage, &[samples])?,
            forgetting_factor: array(py, self.forgetting_factor, &[samples])?,
            rank: array(py, self.rank, &[samples])?,
            skipped: array(py, self.skipped, &[samples])?,
            gate: array(py, self.gate, &[samples])?,
            windup: array(py, self.windup, &[samples])?,
            whitened_innovation: array(py, self.whitened_innovation, &single(&[samples, p, m]))?,
            variance: array(py, self.variance, &[samples, n])?,
            covariance: array(py, self.covariance, &[samples, n, n])?,
            prior_covariance: array(py, self.prior_covariance, &[samples, n, n])?,
            samples,
            used: self.used,
            skipped_count: samples - self.used,
        })
    }
}

/// Appends the n x n numbers of P.
fn reconstruct<T: Number>(covariances: &mut Vec<T>, factor: &Factor<Dynamic<T>>) {
    let (start, n) = (covariances.len(), factor.parameters());
    covariances.resize(start + n * n, T::ZERO);
    factor.reconstruct(&mut covariances[start..]);
}

#[inline(always)]
fn push<T>(values: &mut Option<Vec<T>>, value: T) {
    if let Some(values) = values {
        values.push(value);
    }
}

fn array<T: Stored>(
    py: Python<'_>,
    values: Option<Vec<T>>,
    shape: &[usize],
) -> PyResult<Option<Py<PyAny>>> {
    values.map(|values| shaped(py, values, shape).map(Bound::unbind)).transpose()
}
