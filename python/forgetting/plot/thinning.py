"""Thin long lines to what a screen can show, without losing a peak."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
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
    keep: list[int] = []
    for part in stretches(len(y), points // 2):
        values = y[part]
        missing = np.isnan(values)
        keep.append(part.start + int(np.where(missing, np.inf, values).argmin()))
        keep.append(part.start + int(np.where(missing, -np.inf, values).argmax()))
    index = np.unique(keep)
    return x[index], y[index]


def band(
    x: NDArray[Any], limits: Callable[[slice], tuple[Array, Array]], points: int = POINTS // 2
) -> tuple[NDArray[Any], Array, Array]:
    """Keep the lowest and the highest of every stretch, of limits that are asked for by rows."""
    if len(x) <= points:
        return x, *limits(slice(0, len(x)))
    parts = list(stretches(len(x), points))
    length = parts[0].stop
    middle = [min(part.start + length // 2, len(x) - 1) for part in parts]
    ends = np.array([outermost(*limits(part)) for part in parts])
    ends[~np.isfinite(ends).all(axis=1)] = np.nan
    return x[middle], ends[:, 0], ends[:, 1]


def outermost(low: Array, high: Array) -> tuple[float, float]:
    """The least and the largest that are known; infinite without any."""
    return float(np.fmin.reduce(low, initial=np.inf)), float(np.fmax.reduce(high, initial=-np.inf))


def stretches(total: int, count: int) -> Iterator[slice]:
    """Cut `total` rows into about `count` stretches of equal length."""
    length = math.ceil(total / count)
    for start in range(0, total, length):
        yield slice(start, min(start + length, total))
