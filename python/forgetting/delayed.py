"""Intervals about forecasts many steps ahead that hold what they promise, whatever the errors are.

A forecast made h samples ahead is known to be wrong only h samples later. So each error is judged
by the interval that its own forecast was given. The half-width is c σ, σ² the mean square of the
last hundred errors, and c follows them,

    ln c ← ln c + η (level)      if the error was outside,
    ln c ← ln c - η (1 - level)  if it was inside:

over T errors the share inside differs from the level by |ln c_T - ln c_0|/(η T), as it does one
step ahead (`forgetting.Intervals`), under any drift, any distribution, and in any unit.
"""

from __future__ import annotations

import math
from collections import deque
from typing import SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import InvalidInput, numbers
from .prediction import check_level, quantile

Array = NDArray[np.float64]

MEMORY = 100
"""Errors whose squares are averaged, as for one step."""
RATE = 0.1
"""η for one step."""
FOR_STEPS = 0.25
"""Power of 1/h in η: h errors that go together must not move c as far as h of their own."""
LARGEST = 40.0
"""ln c stays within this."""
LARGEST_SQUARE = 1e300
"""Squares are cut here, so that their mean is finite."""


class DelayedIntervals:
    """Half-widths about forecasts of one horizon that hold this share of the errors.

    Use one for each horizon. With ``steps=1`` it does what `Intervals` does.

    Parameters
    ----------
    steps : int
        h >= 1: the forecast of the sample k + h is made after the sample k.
    level : float, default 0.95
        Share of errors inside, between 0 and 1.
    rate : float, optional
        η, between 0 and 1; 0.1/h^¼ if not given.
    skip : int, default 0
        Errors at first that do not count: n parameters fit n samples whatever the noise.

    Raises
    ------
    InvalidInput
        Names the parameter and what is allowed.

    Notes
    -----
    Adaptive conformal inference (Gibbs and Candès 2021) as quantile tracking (Angelopoulos, Candès
    and Tibshirani 2023), with feedback that comes late.

    Examples
    --------
    >>> import numpy as np
    >>> rng = np.random.default_rng(0)
    >>> noise = np.convolve(rng.normal(size=5000), 0.9 ** np.arange(5))[:5000]
    >>> intervals = DelayedIntervals(5, level=0.9)
    >>> half_widths = intervals.run(noise)
    >>> round(intervals.coverage, 2), len(half_widths)
    (0.9, 5000)
    """

    def __init__(
        self,
        steps: SupportsIndex,
        level: float = 0.95,
        *,
        rate: float | None = None,
        skip: int = 0,
    ) -> None:
        try:
            self.steps = steps.__index__()
        except AttributeError:
            self.steps = 0
        if self.steps < 1:
            raise InvalidInput(f"steps = {steps!r}, allowed: whole numbers from 1 on")
        check_level(level)
        if rate is not None and not 0.0 < rate < 1.0:
            raise InvalidInput(f"rate = {rate}, allowed: between 0 and 1")
        if skip < 0:
            raise InvalidInput(f"skip = {skip}, allowed: whole numbers from 0 on")
        self.level = level
        self.rate = RATE / self.steps**FOR_STEPS if rate is None else rate
        self._logarithm = math.log(quantile(level))
        self._judged, self._inside, self._skip = 0, 0, skip
        self._squares: deque[float] = deque(maxlen=MEMORY)
        self._issued: deque[float] = deque([math.nan] * self.steps)

    @property
    def half_width(self) -> float:
        """Of the interval about the forecast that is made now; NaN before an error counted."""
        return self._issued[-1]

    @property
    def coverage(self) -> float:
        """Share of the errors inside that had an interval; NaN before the first."""
        return self._inside / self._judged if self._judged else math.nan

    def update(self, error: float) -> None:
        """Take the error of the forecast that was made of this sample; NaN where there is none.

        Raises
        ------
        InvalidInput
            For an infinite error; nothing has changed.
        """
        if math.isinf(error):
            raise InvalidInput(f"error = {error}, allowed: finite, or NaN for none")
        issued = self._issued.popleft()
        if not math.isnan(error):
            self._take(error, issued)
        squares = self._squares
        deviation = math.sqrt(math.fsum(squares) / len(squares)) if squares else math.nan
        self._issued.append(math.exp(self._logarithm) * deviation)

    def _take(self, error: float, issued: float) -> None:
        if self._skip:
            self._skip -= 1
            return
        if not math.isnan(issued):
            inside = abs(error) <= issued
            self._judged, self._inside = self._judged + 1, self._inside + inside
            moved = self._logarithm + self.rate * (self.level - inside)
            self._logarithm = min(max(moved, -LARGEST), LARGEST)
        self._squares.append(min(error * error, LARGEST_SQUARE))

    def run(self, errors: ArrayLike) -> Array:
        """Take the errors of a record and return the half-width that each forecast had.

        Parameters
        ----------
        errors : (T,) array
            Of each sample, that of the forecast made of it; NaN where there is none.

        Returns
        -------
        (T,) ndarray
            NaN where a forecast was made before an error counted.

        Raises
        ------
        InvalidInput
            For another shape, or an infinite error; nothing has changed.
        """
        given = np.asarray(numbers("errors", errors), dtype=np.float64)
        if given.ndim != 1:
            raise InvalidInput(f"errors has shape {given.shape}, allowed: (T,)")
        if np.isinf(given).any():
            sample = int(np.argmax(np.isinf(given)))
            raise InvalidInput(f"sample {sample}: error = {given[sample]}, allowed: finite, or NaN")
        had = np.empty(len(given))
        for k, error in enumerate(given.tolist()):
            had[k] = self._issued[0]
            self.update(error)
        return had

    def __repr__(self) -> str:
        return f"DelayedIntervals(steps={self.steps}, level={self.level})"
