"""What a model is measured against that knows nothing: the output stays as it is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def last_measured(y: Array) -> Array:
    """For each row the latest value measured before it, (T, m); NaN when there is none.

    Examples
    --------
    >>> last_measured(np.array([[1.0], [np.nan], [3.0]])).ravel().tolist()
    [nan, 1.0, 1.0]
    """
    rows = np.arange(len(y))[:, None]
    latest = np.maximum.accumulate(np.where(np.isnan(y), -1, rows), axis=0)
    before = np.vstack([np.full((1, y.shape[1]), -1), latest[:-1]])
    known = np.take_along_axis(y, np.maximum(before, 0), axis=0)
    return np.where(before >= 0, known, np.nan)


def rms(error: Array) -> tuple[float, ...]:
    """Root mean square of each column; NaN without samples."""
    if len(error) == 0:
        return (float("nan"),) * int(error.shape[1])
    squares = np.mean(error**2, axis=0)
    return tuple(float(value) for value in np.sqrt(squares))


def typical(errors: tuple[float, ...]) -> float:
    """One number for the errors of several outputs: their geometric mean.

    A change of the unit of an output multiplies it by the same number for every candidate, so that
    no order between candidates depends on units.

    Examples
    --------
    >>> typical((1.0, 100.0))
    10.0
    """
    values = np.asarray(errors)
    if not np.isfinite(values).all():
        return float("inf")
    return float(np.prod(values ** (1 / len(values))))
