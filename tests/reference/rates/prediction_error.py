"""Zhu, Yu & Wan (2022), (21), after Bertin, Bittanti & Bolzern; with a cap. Uses this sample.

    lambda_k = clip(1 - |e|^2 / ((eta + |e|^2) (p + tr S)))

``sensitivity`` = eta > 0, in units of |e|^2 (small: sensitive). Without the clip the range is
(1 - 1/p, 1], so ``smallest`` < 1 - 1/p never acts, and lambda = 1 at e = 0: ``largest`` < 1 is
what bounds R.
"""

from __future__ import annotations

from ..linalg import Real, trace
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(self, sensitivity: float, smallest: float, largest: float) -> None:
        super().__init__(smallest, largest)
        self.sensitivity = Real(sensitivity)

    def factor(self, step: Step) -> Real:
        spread = step.rows + trace(step.spread)
        return self.clip(1 - step.square / (self.sensitivity + step.square) / spread)


CASES = [
    {"sensitivity": 0.1, "smallest": 0.5, "largest": 0.999},
    {"sensitivity": 0.5, "smallest": 0.95, "largest": 0.99},
]
