"""What a model would have forecast at every sample of a record, and how far it was off."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from forgetting._core import InvalidInput
from forgetting.delayed import DelayedIntervals
from forgetting.models.arx import ARX
from forgetting.models.foreseen import Foreseen, of_arx, of_signals
from forgetting.models.orders import whole
from forgetting.models.polynomial import Polynomial
from forgetting.prediction import Prediction, check_level, quantile

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Forecasts:
    """Forecasts of every sample of a record, by how many samples before they were made.

    Attributes
    ----------
    horizons : tuple of int
        H numbers of samples ahead.
    level : float
        Share of outputs that both intervals are to hold.
    measured : ndarray, shape (T,)
    value : ndarray, shape (T, H)
        What was forecast of each sample, so many samples before it. NaN where a lag was missing.
    deviation : ndarray, shape (T, H)
        Standard deviation of the noise in each, by the variance of e and the model of that time.
    skip : int
        Errors at first that do not count.
    """

    horizons: tuple[int, ...]
    level: float
    measured: Array
    value: Array
    deviation: Array
    skip: int

    @property
    def error(self) -> Array:
        """What was measured less what was forecast, (T, H)."""
        return np.asarray(self.measured[:, None] - self.value)

    @cached_property
    def trackers(self) -> tuple[DelayedIntervals, ...]:
        """The tracker of each horizon after the record, with the half-width of a forecast now."""
        return tuple(tracker for tracker, _ in self._tracked)

    @cached_property
    def half_width(self) -> Array:
        """Of the conformal interval that each forecast had, (T, H)."""
        return np.column_stack([had for _, had in self._tracked])

    @cached_property
    def _tracked(self) -> list[tuple[DelayedIntervals, Array]]:
        made = [DelayedIntervals(h, self.level, skip=self.skip) for h in self.horizons]
        errors = np.where(np.isfinite(self.error), self.error, np.nan)
        return [(own, own.run(each)) for own, each in zip(made, errors.T, strict=True)]

    @property
    def noise_half_width(self) -> Array:
        """Of the interval by the noise, as normal as it is large, (T, H)."""
        return np.asarray(quantile(self.level) * self.deviation)

    @property
    def interval(self) -> Prediction:
        """The conformal interval: value, lower and upper, (T, H) each."""
        half = self.half_width
        return Prediction(self.value, self.value - half, self.value + half)

    def coverage(self) -> dict[int, dict[str, float]]:
        """Share of the errors of each horizon inside both intervals, on the same samples.

        "conformal" and "noise", and "root_mean_square", the size of the errors.
        """
        known = np.isfinite(self.half_width) & np.isfinite(self.deviation)
        known &= np.isfinite(self.error)
        return {
            horizon: self._held(i, np.asarray(known[:, i]))
            for i, horizon in enumerate(self.horizons)
        }

    def _held(self, i: int, rows: NDArray[np.bool_]) -> dict[str, float]:
        error = np.abs(self.error[rows, i])
        shares = {"conformal": self.half_width, "noise": self.noise_half_width}
        nothing = float("nan")
        held = {
            name: float(np.mean(error <= half[rows, i])) if len(error) else nothing
            for name, half in shares.items()
        }
        size = float(np.sqrt(np.mean(error**2))) if len(error) else nothing
        return held | {"root_mean_square": size}

    def __repr__(self) -> str:
        lines = [
            f"{horizon} ahead: {held['conformal']:.1%} within the interval that follows the "
            f"errors, {held['noise']:.1%} within that of the noise, "
            f"rms error {held['root_mean_square']:.4g}"
            for horizon, held in self.coverage().items()
        ]
        return "\n".join(
            [f"Forecasts of {len(self.measured)} samples, level {self.level:.4g}", *lines]
        )


def forecasts(
    model: ARX | Polynomial,
    u: ArrayLike | None,
    y: ArrayLike,
    horizons: int | Sequence[int] = (1, 5, 20),
    level: float = 0.95,
) -> Forecasts:
    """Identify from a record as `fit` does, and forecast at every sample what is to come.

    Parameters
    ----------
    model : ARX, FIR, AR, ARMA, ARMAX, OE or BJ
        Of one output. It does not change: what it has learned is not used.
    u : array_like or data frame, shape (T,) or (T, inputs), or None
        Inputs; those to come are taken from the record, as if they were known.
    y : array_like or data frame, shape (T,) or (T, 1)
        The output. NaN is a missing value.
    horizons : int or sequence of int
        How many samples ahead, each >= 1.
    level : float, default 0.95
        Share of outputs that intervals are to hold, between 0 and 1.

    Returns
    -------
    Forecasts
        With intervals in two readings: conformal ones (`DelayedIntervals`, one tracker a horizon),
        which suppose nothing of the errors, and those of the noise, σ² through C/(A D) as both were
        estimated at that time.

    Raises
    ------
    InvalidInput
        Names the argument and what is allowed.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> rng = np.random.default_rng(0)
    >>> y = np.zeros(3000)
    >>> for k in range(1, 3000):
    ...     y[k] = 0.9 * y[k - 1] + (1 + (k > 1500)) * rng.normal()
    >>> found = fg.forecasts(fg.AR(1, rule="none"), None, y, horizons=[1, 10], level=0.9)
    >>> [round(held["conformal"], 2) for held in found.coverage().values()]
    [0.9, 0.9]
    """
    if not isinstance(model, ARX | Polynomial):
        raise InvalidInput(f"model = {model!r}, allowed: ARX, FIR, AR, ARMA, ARMAX, OE or BJ")
    ahead = checked(horizons, level)
    find: Any = of_arx if isinstance(model, ARX) else of_signals
    return aligned([find(model, u, y, max(ahead))], ahead, level)


def checked(horizons: int | Sequence[int], level: float) -> tuple[int, ...]:
    """The horizons, if they and the level are allowed.

    Examples
    --------
    >>> checked([1, 24], 0.9), checked(3, 0.9)
    ((1, 24), (3,))
    """
    check_level(level)
    given = list(horizons) if isinstance(horizons, Sequence | np.ndarray) else [horizons]
    ahead = tuple(whole("horizons", each) for each in given)
    if not ahead or min(ahead) < 1 or len(set(ahead)) < len(ahead):
        raise InvalidInput(f"horizons = {given}, allowed: whole numbers from 1 on, each once")
    return ahead


def aligned(parts: Sequence[Foreseen], horizons: tuple[int, ...], level: float) -> Forecasts:
    """What was foreseen of each sample, in stretches that do not see one another."""
    at = [h - 1 for h in horizons]
    return Forecasts(
        horizons=horizons,
        level=level,
        measured=np.concatenate([part.measured for part in parts]),
        value=np.vstack([later(part.value[:, at], horizons) for part in parts]),
        deviation=np.vstack([later(part.deviation[:, at], horizons) for part in parts]),
        skip=3 * parts[0].parameters,
    )


def later(made: Array, horizons: tuple[int, ...]) -> Array:
    """What was made at each sample (T, H), at the samples that it is about.

    Examples
    --------
    >>> later(np.array([[1.0, 10.0], [2.0, 20.0], [3.0, 30.0]]), (1, 2)).tolist()
    [[nan, nan], [1.0, nan], [2.0, 10.0]]
    """
    columns = zip(made.T, horizons, strict=True)
    each = [np.r_[np.full(h, np.nan), column][: len(made)] for column, h in columns]
    return np.column_stack(each)
