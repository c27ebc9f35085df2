"""A function of the user's; here one of the number of used samples.

    lambda_k = min(1, start + step k)
"""

from __future__ import annotations

from ..linalg import Real
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(self, start: float, step: float) -> None:
        super().__init__(start, 1.0)
        self.start, self.slope = Real(start), Real(step)

    def factor(self, step: Step) -> Real:
        return self.clip(self.start + self.slope * step.k)


# exact in single precision too, so that both sides add the same numbers
CASES = [{"start": 0.875, "step": 2.0**-11}]
