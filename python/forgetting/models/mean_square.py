"""A running mean of squares: the variance of errors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

MEMORY = 1000
"""Samples over which the variance of the noise of one rule is averaged."""


class MeanSquare:
    """The mean of squares over up to so many samples, the later ones once there are more.

    Parameters
    ----------
    targets : int
        Number m of squares a sample.
    memory : int
        Samples over which they are averaged.
    skip : int
        Samples at first that are not counted: n parameters fit n samples whatever the noise.

    Attributes
    ----------
    value : ndarray, shape (m,)
        NaN until a sample is counted.

    Examples
    --------
    >>> mean = MeanSquare(1, memory=1000, skip=1)
    >>> mean.add(np.array([[9.0], [1.0], [3.0]]))
    >>> mean.value.tolist()
    [2.0]
    """

    def __init__(self, targets: int, memory: int, skip: int) -> None:
        self.value = np.full(targets, np.nan)
        self._memory, self._seen, self._weight = memory, -skip, 0.0

    def add(self, squares: Array, weights: Array | None = None) -> None:
        """Take note of the squares of some samples, (T, m), and of what they count, (T,) in (0, 1].

        One that counts less than 1 is as much less of a sample.
        """
        first = max(0, -self._seen)
        counted = squares[first:]
        if len(counted):
            each = np.ones(len(counted)) if weights is None else weights[first:]
            before = self._weight
            counts = np.minimum(before + np.cumsum(each), self._memory)
            # what is left of the mean before each sample once all later ones have come
            left = np.cumprod(1.0 - each[::-1] / counts[::-1])[::-1]
            shares = np.append(left[1:], 1.0) * each / counts
            self.value = shares @ counted + (left[0] * self.value if before else 0.0)
            self._weight = counts[-1]
        self._seen += len(squares)
