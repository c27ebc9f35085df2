"""The samples of one model, and which of them choose and which report."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.tuning.baseline import last_measured

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

FEWEST_CHOOSING, FEWEST_REPORTING = 50, 30
"""Scored samples below which a choice, or a report on it, would be of noise."""


class Problem(Protocol):
    """The samples of one model.

    Attributes
    ----------
    y : ndarray, shape (T, m)
        Outputs as they were measured, NaN where missing.
    parameters : int
        Number n of parameters of each output.
    """

    @property
    def y(self) -> Array:
        """See the class."""
        ...

    @property
    def parameters(self) -> int:
        """See the class."""
        ...

    @property
    def complete(self) -> Mask:
        """Samples that the model can predict, (T,)."""
        ...

    def errors(self, estimator: Any, stop: int | None = None, follows: bool = True) -> Array:
        """One-step errors (stop, m) of a new estimator on the rows before `stop`.

        `follows` says that its prior follows the data. NaN where a sample is not complete.
        """
        ...

    def mean_squares(self, stop: int) -> Array:
        """Of the regressors of the rows before `stop`, (n,)."""
        ...

    def part(self, rows: slice) -> Problem:
        """Some rows, in place of all."""
        ...


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
    start = max(2 * problem.parameters, first // 10)
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
