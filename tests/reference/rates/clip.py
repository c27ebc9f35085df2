"""Clipping to the stated range, and the base of all rates."""

from __future__ import annotations

from ..linalg import Matrix, Real
from ..step import Step


class ClippedRate:
    """Keeps [smallest, largest]; the default rate never adapts."""

    def __init__(self, smallest: float, largest: float) -> None:
        self.smallest, self.largest = Real(smallest), Real(largest)

    def clip(self, value: Real) -> Real:
        if value >= self.largest:
            return self.largest
        return self.smallest if value <= self.smallest else value.mid()

    def factor(self, step: Step) -> Real:
        raise NotImplementedError

    def after(self, step: Step, covariance: Matrix) -> None:
        """Told the algorithm's own P_{k+1} at the end of the step."""
