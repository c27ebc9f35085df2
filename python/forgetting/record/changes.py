"""Changes: when the errors become larger than those before allow, as events.

An estimator that forgets only where it is informed has an F-test for its rate (Mohseni and
Bernstein 2022): a change begins where the errors of the last 10 rows are larger than those of the
last 100 by more than chance allows, and ends when the test has found nothing more for 100 rows.
Neither units nor the rule that is followed beside it matter.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.moved import Moved, as_run
from forgetting.record.samples import Samples, pieces
from forgetting.record.trace import USED

FACTOR = 0.99
SHORT, LONG = 10, 100
"""Rows of the two windows of the F-test."""
SIGNIFICANCE = 1e-6
"""A false alarm in about a million rows of independent, normal errors."""
TEST = ("forgetting_factor", "skipped")
"""What a run of the estimator must give."""


class Detector:
    """Follows the rows of a model and says when changes begin and end.

    Parameters
    ----------
    parameters, outputs : int

    Attributes
    ----------
    estimator : RLS
        Is given every row; what its run brings is given to `take`.
    changing : bool
        Whether a change goes on.
    steady : int
        Rows since the test last found one, while it goes on.
    """

    def __init__(self, parameters: int, outputs: int) -> None:
        test = fg.FTest(
            short_window=SHORT,
            long_window=max(LONG, outputs + SHORT),
            significance=SIGNIFICANCE,
            largest=FACTOR,
        )
        self.estimator = fg.RLS(parameters, rule=fg.Subspace(test), targets=outputs)
        self.changing = False
        self.steady = 0

    def take(self, factors: NDArray[Any], skipped: NDArray[Any]) -> Iterator[tuple[int, bool]]:
        """Which of some rows (T,) begin a change (True) or end it, by their factors."""
        changed = (factors < FACTOR) & (skipped == USED)
        if not self.changing and not changed.any():
            return
        for place, now in enumerate(changed.tolist()):
            if now:
                self.steady = 0
                if not self.changing:
                    self.changing = True
                    yield place, True
            elif self.changing:
                self.steady += 1
                if self.steady == LONG:
                    self.changing, self.steady = False, 0
                    yield place, False


@dataclass(frozen=True)
class Change:
    """A change in a record.

    Attributes
    ----------
    row : int
        Where it begins, counted from 1.
    time : str or None
        That of the row; None without a clock.
    until : int or None
        The row where it ends; None where the record ends before.
    """

    row: int
    time: str | None
    until: int | None

    def __str__(self) -> str:
        """In words."""
        time = "" if self.time is None else f" ({self.time})"
        end = "the end of the record" if self.until is None else f"row {self.until}"
        return f"change at row {self.row}{time}, until {end}"


def changes(moved: Moved) -> list[Change]:
    """The changes of a record, whose samples are `moved` to where a model measures from."""
    detector = Detector(moved.parameters, moved.targets)
    events: list[tuple[int, bool]] = []
    for part in pieces(len(moved)):
        phi, y = as_run(*moved.rows(part), np.float64)
        try:
            found = detector.estimator.run(phi, y, outputs=TEST, missing="skip")
        except fg.NumericalRange:  # what has been found is told
            break
        told = detector.take(np.asarray(found.forgetting_factor), np.asarray(found.skipped))
        events += [(part.start + place + 1, begins) for place, begins in told]
    ends = [row for row, begins in events if not begins]
    begun = [row for row, begins in events if begins]
    return [
        Change(row, time_of(moved.samples, row), ends[i] if i < len(ends) else None)
        for i, row in enumerate(begun)
    ]


def time_of(samples: Samples, row: int) -> str | None:
    """The time of a row, counted from 1, as the record has it; None without a clock."""
    return None if samples.clock is None else str(samples.clock.values.iloc[row - 1])
