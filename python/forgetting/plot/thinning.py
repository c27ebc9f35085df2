"""Thin long lines to what a screen can show, without losing a peak."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

POINTS = 1600
"""Points kept of a line; a report is about 900 pixels wide."""


def line(x: NDArray[Any], y: Array, points: int = POINTS) -> tuple[NDArray[Any], Array]:
    """Keep the smallest and the largest value of every stretch, in their order.

    Examples
    --------
    >>> import numpy as np
    >>> x, y = line(np.arange(1000), np.eye(1, 1000, 500).ravel(), points=20)
    >>> len(x) <= 22, float(y.max())
    (True, 1.0)
    """
    if len(y) <= points:
        return x, y
    rows = stretches(y, points // 2)
    low = np.where(np.isnan(rows), np.inf, rows).argmin(axis=1)
    high = np.where(np.isnan(rows), -np.inf, rows).argmax(axis=1)
    start = np.arange(len(rows)) * rows.shape[1]
    keep = np.sort(np.column_stack([low, high]), axis=1) + start[:, None]
    index = np.unique(np.minimum(keep.ravel(), len(y) - 1))
    return x[index], y[index]


def band(
    x: NDArray[Any], low: Array, high: Array, points: int = POINTS // 2
) -> tuple[NDArray[Any], Array, Array]:
    """Keep the lowest `low` and the highest `high` of every stretch."""
    if len(x) <= points:
        return x, low, high
    lows, highs = stretches(low, points), stretches(high, points)
    middle = np.minimum(np.arange(len(lows)) * lows.shape[1] + lows.shape[1] // 2, len(x) - 1)
    lowest = np.where(np.isnan(lows), np.inf, lows).min(axis=1)
    highest = np.where(np.isnan(highs), -np.inf, highs).max(axis=1)
    empty = ~np.isfinite(lowest) | ~np.isfinite(highest)
    return x[middle], np.where(empty, np.nan, lowest), np.where(empty, np.nan, highest)


def stretches(y: Array, count: int) -> Array:
    """Cut y into about `count` rows of equal length; the last is filled up with NaN."""
    length = math.ceil(len(y) / count)
    filled = np.full(math.ceil(len(y) / length) * length, np.nan)
    filled[: len(y)] = y
    return filled.reshape(-1, length)
