"""The ways in which noise and parameters of a record may go on, weighed by their likelihood."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.moved import Moved, as_run
from forgetting.record.trace import USED

Array = NDArray[np.float64]

CORRELATIONS = (0.0, 0.3, 0.6, 0.8, 0.9, 0.95, 0.98)
"""r of the grid."""
LEAST, MOST = 10.0, 1.0
"""q of the grid: 0, and powers of ten from LEAST/T² to MOST; 1/T² is what T samples just show."""
SAMPLES = 20_000
"""Samples at the end of the record by which r and q are weighed."""
FREEDOM, ROUNDS = 5.0, 10
"""ν, and rounds of reweighting to find σ²."""
COST = 100_000_000
"""Samples times n² that a course may cost while they are weighed."""
OUTPUTS = ("error", "leverage", "skipped")
COUNTS = 0.02
"""Weight below which a course is left out."""
FEW = 10
"""Parameters up to which every direction walks at every sample; above, one after the other."""


@dataclass(frozen=True)
class Course:
    """One of the ways in which noise and parameters may go on: r, q and its weight."""

    correlation: float
    process_noise: float
    weight: float


def weigh(samples: Moved, settings: dict[str, Any]) -> tuple[Course, ...]:
    """The courses by their likelihood on the last samples."""
    n = samples.parameters
    rows = min(len(samples), SAMPLES, COST // n**2)
    part = samples.last(rows)
    if rows < 2 * n or part.complete.sum() < n + 3:
        return ()
    grid = [(r, q) for r in CORRELATIONS for q in walks(int(part.complete.sum()))]
    logs = np.array([likelihood(part, r, q, settings) for r, q in grid])
    if not np.isfinite(logs).any():
        return (Course(0.0, 0.0, 1.0),)
    weights = np.exp(logs - logs.max())
    weights /= weights.sum()
    weights[weights < min(COUNTS, weights.max())] = 0.0
    order = [i for i in np.argsort(-weights) if weights[i] > 0]
    total = weights.sum()
    return tuple(Course(grid[i][0], grid[i][1], float(weights[i] / total)) for i in order)


def walks(samples: int) -> list[float]:
    """q of the grid.

    Examples
    --------
    >>> walks(1000)
    [0.0, 1e-05, 0.0001, 0.001, 0.01, 0.1, 1.0]
    """
    found, q = [0.0], LEAST / samples**2
    while q < MOST * 1.001:
        found.append(q)
        q *= 10
    return found


def differenced(phi: Array, y: Array, correlation: float) -> tuple[Array, Array]:
    """Rows less `correlation` times the one before; the first is missing."""
    if not correlation:
        return phi, y
    made = tuple(np.full_like(each, np.nan) for each in (phi, y))
    for new, old in zip(made, (phi, y), strict=True):
        new[1:] = old[1:] - correlation * old[:-1]
    return made[0], made[1]


def walk(samples: Moved, noise: float, settings: dict[str, Any]) -> Any:
    """The estimator for parameters that walk by `noise`, in units of the regressors."""
    n = samples.parameters
    if not noise:
        return fg.RLS(n, rule=fg.rule("none"), **settings)
    steps: Any = noise
    if settings["initial_covariance"] is not None:  # then noises are in the units of the record
        squares = samples.mean_squares
        steps = noise / np.where(squares > 0, squares, 1.0)
    schedule = "every_sample" if n <= FEW else "cyclic"
    rule = fg.rule("random_walk", process_noise=steps, schedule=schedule)
    return fg.RLS(n, rule=rule, **settings)


def likelihood(samples: Moved, r: float, q: float, settings: dict[str, Any]) -> float:
    """log L of a course; minus infinity where it cannot be computed."""
    estimator, learning = walk(samples, q, settings), start(samples)
    phi, y = as_run(*differenced(*samples.rows(slice(None)), r), settings["dtype"])
    try:
        found = estimator.run(phi, y, outputs=OUTPUTS, missing="skip")
    except (fg.NumericalRange, fg.InvalidInput):
        return -np.inf
    used = (found.skipped == USED) & (np.cumsum(samples.complete) > learning)
    error = np.asarray(found.error, dtype=np.float64).reshape(len(samples), -1)[used]
    spread = 1 + np.asarray(found.leverage, dtype=np.float64)[used, None]
    if not len(error):
        return -np.inf
    squares = error**2 / spread
    mean = student_scale(squares)
    if not (mean > 0).all():
        return -np.inf
    # where gaps cost a difference more samples than another, the mean is what compares
    whole = int((np.cumsum(samples.complete) > learning).sum()) / len(error)
    value = len(error) * np.log(mean).sum() + error.shape[1] * np.log(spread).sum()
    value += (FREEDOM + 1) * np.log1p(squares / (FREEDOM * mean)).sum()
    return float(-0.5 * value * whole)


def start(samples: Moved) -> int:
    """Complete samples whose errors show the initial guess; fewer in a short record."""
    n, total = samples.parameters, int(samples.complete.sum())
    return 5 * n + 20 if total >= 2 * (5 * n + 20) else n + 1


def student_scale(squares: Array) -> Array:
    """σ² of the t distribution that squares (T, m) are most likely of, by reweighting."""
    mean = np.mean(squares, axis=0)
    for _ in range(ROUNDS):
        weights = (FREEDOM + 1) / (FREEDOM + squares / np.where(mean > 0, mean, 1.0))
        mean = np.mean(weights * squares, axis=0)
    return np.asarray(mean)
