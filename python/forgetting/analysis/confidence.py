"""Standard errors and prediction intervals, and how often they are right.

What P means
------------
σ² P is the covariance of θ̃ if, and only if, the parameters move the way the rule supposes:
every proper rule is the Kalman filter of a random walk with steps of covariance
σ² Q_k, Q_k = P̄_k - P_k, and P is its posterior. In particular

* no forgetting: Q = 0, P is the covariance for fixed parameters;
* exponential forgetting: the walk has steps proportional to P itself; for fixed parameters P
  is about twice the true covariance, and without excitation it grows without saying
  anything about the error, which stays where it is;
* directional, variable-direction and subspace forgetting: the parameters are supposed to
  move only along what the sample excites; elsewhere P is what it was at the last
  excitation, which is honest only if the parameters stood still there meanwhile;
* resetting: after a reset P is the matrix that the user declared, whatever the data; it is
  meant to be larger than the error, and intervals are then wide.

For parameters that are fixed the covariance C of the error follows from the gains alone,

    C_{k+1} = M_k C_k M_kᵀ + G_k G_kᵀ,   G_k = P_{k+1} φ̄_kᵀ,   M_k = I - G_k φ̄_k,   C_0 = P_0

and C <= P for every proper rule. Both readings are returned; their coverage shows
which of them, if any, the record supports.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .trajectory import Trajectory, trajectory_of
from .validation import Array, numbers, present, real, refuse, whole


@dataclass(frozen=True, eq=False)
class Confidence:
    """Standard errors and intervals. See `confidence`.

    Attributes
    ----------
    level : float
        Nominal coverage.
    noise_variance, fixed_noise_variance : (T, targets)
        σ² used at each sample in either reading: the one given, or the estimate from the
        samples before.
    standard_error, fixed_standard_error : (T, n, targets)
        √(σ² P_ii), and √(σ² C_ii) for fixed parameters, after each sample.
    half_width, fixed_half_width : (T, rows, targets)
        Half of the prediction interval of y_k, known before y_k.
    error : (T, rows, targets)
        y_k - φ_k θ_k.
    counted : (T, rows, targets) bool
        Samples that count: used by the estimator and after the warm-up.
    """

    level: float
    noise_variance: Array = field(repr=False)
    fixed_noise_variance: Array = field(repr=False)
    standard_error: Array = field(repr=False)
    fixed_standard_error: Array = field(repr=False)
    half_width: Array = field(repr=False)
    fixed_half_width: Array = field(repr=False)
    error: Array = field(repr=False)
    counted: NDArray[np.bool_] = field(repr=False)

    @property
    def coverage(self) -> float:
        """Share of the counted samples inside the interval from P; NaN if none counts."""
        return self._share(self.half_width)

    @property
    def fixed_coverage(self) -> float:
        """Share of the counted samples inside the interval for fixed parameters."""
        return self._share(self.fixed_half_width)

    @property
    def uncertainty(self) -> float:
        """Standard error of the coverage, were the samples independent."""
        count = int(self.counted.sum())
        return float("nan") if count == 0 else (self.level * (1 - self.level) / count) ** 0.5

    def _share(self, half: Array) -> float:
        inside = np.abs(self.error[self.counted]) <= half[self.counted]
        return float(inside.mean()) if inside.size else float("nan")

    def __str__(self) -> str:
        """The coverage in a sentence."""
        if not self.counted.any():
            return "The record is too short to measure the coverage of the intervals."
        return (
            f"Of the {int(self.counted.sum())} counted outputs {self.coverage:.1%} fell into "
            f"their {self.level:.0%} prediction interval ({self.fixed_coverage:.1%} for fixed "
            f"parameters; {self.uncertainty:.1%} of chance)."
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the scalars, ready for JSON."""
        some = bool(self.counted.any())
        last, fixed = self.noise_variance[-1], self.fixed_noise_variance[-1]
        return {
            "level": self.level,
            "coverage": self.coverage if some else None,
            "fixed_coverage": self.fixed_coverage if some else None,
            "uncertainty": self.uncertainty if some else None,
            "counted": int(self.counted.sum()),
            "noise_variance": last.tolist() if np.isfinite(last).all() else None,
            "fixed_noise_variance": fixed.tolist() if np.isfinite(fixed).all() else None,
        }


def confidence(
    run: Any,
    regressors: ArrayLike | None = None,
    *,
    gamma: ArrayLike | None = None,
    initial_covariance: ArrayLike | None = None,
    errors: ArrayLike | None = None,
    level: float = 0.95,
    noise_variance: float | None = None,
    warm_up: int | None = None,
) -> Confidence:
    """Standard errors, prediction intervals and their coverage on the record.

    Parameters
    ----------
    run : Run or Trajectory
        A Run needs ``outputs=(..., "error", "covariance")``.
    regressors, gamma, initial_covariance : optional
        As given to the run.
    errors : (T,), (T, rows) or (T, rows, targets), optional
        One-step errors y_k - φ_k θ_k; needed with a Trajectory.
    level : float in (0, 1)
        Nominal coverage.
    noise_variance : float > 0, optional
        σ², the noise covariance being σ² Γ. Default: estimated on the way from the
        innovations, E e² = σ² (Γ + φ P̄ φᵀ), with C for P̄ where parameters are taken as
        fixed, using only the samples before.
    warm_up : int >= 1, optional
        Samples left out of that estimate at the start, and twice as many left out of the
        coverage. Default: 5 n + 20.

    Returns
    -------
    Confidence

    Notes
    -----
    The intervals are Gaussian. What P means under each rule stands at the head of this module.

    Examples
    --------
    >>> import numpy as np
    >>> from forgetting.analysis import Trajectory
    >>> variance = 1 / np.arange(1.0, 402)  # RLS of a constant, P_0 = 1
    >>> trajectory = Trajectory.from_arrays(np.ones((400, 1)), variance[:, None, None])
    >>> errors = np.random.default_rng(0).normal(size=400) * np.sqrt(1 + variance[:-1])
    >>> found = confidence(trajectory, errors=errors, noise_variance=1.0)
    >>> bool(abs(found.coverage - 0.95) < 3 * found.uncertainty)
    True
    """
    level = real("level", level, 0.0, 1.0 - 1e-15, open_low=True)
    skipped = getattr(run, "skipped", None)
    if errors is None:
        errors = np.asarray(present(run, "error"))
    trajectory = trajectory_of(run, regressors, gamma, initial_covariance)
    error = _errors(trajectory, errors)
    used = np.isfinite(error)
    if skipped is not None:
        used &= (np.asarray(skipped)[trajectory.first :] == 0)[:, np.newaxis, np.newaxis]
    warm_up = 5 * trajectory.parameters + 20 if warm_up is None else whole("warm_up", warm_up, 1)
    fixed = _fixed_covariance(trajectory)
    spread = _innovation(trajectory, trajectory.prior)
    fixed_spread = _innovation(trajectory, fixed[:-1])
    variance, fixed_variance = (
        _noise(error**2 / each[:, :, np.newaxis], used, noise_variance, warm_up)
        for each in (spread, fixed_spread)
    )
    counted = used & np.isfinite(variance)[:, np.newaxis, :]
    counted[: 2 * warm_up] = False
    quantile = NormalDist().inv_cdf(0.5 + level / 2)
    return Confidence(
        level,
        variance,
        fixed_variance,
        _root(np.diagonal(trajectory.after, axis1=1, axis2=2), variance),
        _root(np.diagonal(fixed[1:], axis1=1, axis2=2), fixed_variance),
        quantile * _root(spread, variance),
        quantile * _root(fixed_spread, fixed_variance),
        error,
        counted,
    )


def _errors(trajectory: Trajectory, errors: ArrayLike) -> Array:
    """Errors as (T, rows, targets)."""
    values = numbers("errors", errors)
    samples = trajectory.samples + trajectory.first
    if values.ndim == 1:
        values = values[:, np.newaxis]
    if values.ndim == 2:
        values = values[:, :, np.newaxis]
    if values.ndim != 3 or values.shape[:2] != (samples, trajectory.rows):
        raise refuse("errors", values.shape, f"shape {(samples, trajectory.rows)} or with targets")
    return values[trajectory.first :]


def _innovation(trajectory: Trajectory, covariance: Array) -> Array:
    """Diagonal of Γ + φ P φᵀ for each sample, (T, rows)."""
    root = np.linalg.cholesky(trajectory.weight)
    phi = root @ trajectory.phibar
    # the noise is that of Γ as given, however far the sample was trusted
    gamma = np.diagonal(trajectory.weight, axis1=1, axis2=2)
    if trajectory.trust is not None:
        gamma = gamma * trajectory.trust[:, np.newaxis]
    added = np.einsum("tpi,tij,tpj->tp", phi, covariance, phi)
    return np.asarray(gamma + added, dtype=np.float64)


def _noise(squares: Array, used: NDArray[np.bool_], given: float | None, warm_up: int) -> Array:
    """σ² known before each sample, (T, targets): given, or the mean of the squares so far."""
    samples, rows, targets = squares.shape
    if given is not None:
        value = real("noise_variance", given, 0.0, float("inf"), open_low=True)
        return np.full((samples, targets), value)
    counts = used.copy()
    counts[:warm_up] = False
    total = np.cumsum(np.where(counts, squares, 0.0).sum(axis=1), axis=0)
    number = np.cumsum(counts.sum(axis=1), axis=0)
    before = np.full((samples, targets), np.nan)
    enough = number[:-1] >= 2 * rows
    before[1:][enough] = (total[:-1] / np.maximum(number[:-1], 1))[enough]
    return before


def _fixed_covariance(trajectory: Trajectory) -> Array:
    """C_0 ... C_T, the covariance of the error for fixed parameters, σ² apart."""
    path = np.empty((trajectory.samples + 1, trajectory.parameters, trajectory.parameters))
    path[0] = trajectory.before[0]
    gains = np.einsum("tij,tpj->tip", trajectory.after, trajectory.phibar)
    moves = np.eye(trajectory.parameters) - gains @ trajectory.phibar
    fresh = gains @ np.swapaxes(gains, 1, 2)
    if trajectory.trust is not None:
        fresh = fresh * trajectory.trust[:, np.newaxis, np.newaxis]
    for k, (move, noise) in enumerate(zip(moves, fresh, strict=True)):
        path[k + 1] = move @ path[k] @ move.T + noise
    return path


def _root(values: Array, variance: Array) -> Array:
    """√(σ² v), (T, ..., targets), without complaint about rounding below zero."""
    product = np.maximum(values, 0.0)[:, :, np.newaxis] * variance[:, np.newaxis, :]
    return np.asarray(np.sqrt(product))
