"""Regressors and outputs of one model, and which samples choose and which report."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.tuning.baseline import last_measured

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

FEWEST_CHOOSING, FEWEST_REPORTING = 50, 30
"""Scored samples below which a choice, or a report on it, would be of noise."""


@dataclass(frozen=True)
class Problem:
    """The samples of one model, NaN where a value is missing.

    Attributes
    ----------
    phi : ndarray, shape (T, n)
        Regressors as they are.
    y : ndarray, shape (T, m)
        Outputs as they are.
    moved : tuple of two ndarrays
        Both as an estimator gets them whose prior follows the data: measured from the first sample
        where the model has a constant, see `forgetting.record.identify`.
    """

    phi: Array
    y: Array
    moved: tuple[Array, Array]

    @property
    def complete(self) -> Mask:
        """Rows without a missing value, (T,)."""
        missing = np.isnan(self.phi).any(axis=1) | np.isnan(self.y).any(axis=1)
        return np.asarray(~missing, dtype=np.bool_)

    def part(self, rows: slice) -> Problem:
        """Some rows, in place of all."""
        phi, y = self.moved
        return Problem(self.phi[rows], self.y[rows], (phi[rows], y[rows]))


@dataclass(frozen=True)
class Split:
    """The two parts of a record, the same for all models.

    Attributes
    ----------
    row : int
        The first row of the rest: all before it is the first part.
    choosing, reporting : ndarray of bool, shape (T,)
        Samples of the first part, and of the rest, that are scored.
    """

    row: int
    choosing: Mask
    reporting: Mask

    @property
    def counts(self) -> tuple[int, int]:
        """Scored samples of the two parts."""
        return int(self.choosing.sum()), int(self.reporting.sum())

    @property
    def is_enough(self) -> bool:
        """Whether a choice, and a report on it, would be of more than noise."""
        return self.counts[0] >= FEWEST_CHOOSING and self.counts[1] >= FEWEST_REPORTING


def split(problem: Problem, share: float) -> Split:
    """Cut a record in two, with `share` of its complete samples in the first part.

    Scored are samples that the model with the most lags can predict, all models the same. The start
    of the first part is not: a tenth of it, and at least twice as many samples as regressors, as
    before that every estimator shows its prior.

    Raises
    ------
    InvalidInput
        When `share` is not between 0 and 1.
    """
    if not 0 < share < 1:
        raise InvalidInput(f"share = {share:g}, allowed: between 0 and 1, both excluded")
    complete = problem.complete
    known = complete & ~np.isnan(last_measured(problem.y)).any(axis=1)
    count = np.cumsum(complete)
    first = int(share * count[-1]) if len(count) else 0
    row = int(np.searchsorted(count, first, side="right")) if first else 0
    before = np.arange(len(complete)) < row
    start = max(2 * problem.phi.shape[1], first // 10)
    return Split(row, known & before & (count > start), known & ~before)


def check(parts: Split, share: float) -> Split:
    """The parts, if they have enough samples.

    Raises
    ------
    InvalidInput
        With the counts.
    """
    if not parts.is_enough:
        raise InvalidInput(
            f"with share = {share:g} there are {parts.counts[0]} samples to choose by and "
            f"{parts.counts[1]} to report on; at least {FEWEST_CHOOSING} and {FEWEST_REPORTING} "
            "are needed"
        )
    return parts
