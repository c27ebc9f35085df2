"""Park, Jun & Kim (1991): fast tracking with a unity zone. Uses this sample.

    lambda_k = clip(lambda_min + (1 - lambda_min) 2^-L),   L = round(rho |e|^2 / p)

round: to the nearest whole number, halves up; lambda_min = ``smallest``, rho = ``sensitivity``. One
row is the printed form. While rho e^2 < 1/2 lambda is 1 (then clipped to ``largest``).
"""

from __future__ import annotations

from ..linalg import Real
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(self, sensitivity: float, smallest: float, largest: float) -> None:
        super().__init__(smallest, largest)
        self.sensitivity = Real(sensitivity)

    def factor(self, step: Step) -> Real:
        level = (self.sensitivity * step.square / step.rows + Real(1) / 2).mid().floor()
        return self.clip(self.smallest + (1 - self.smallest) * Real(2) ** -level)


CASES = [
    {"sensitivity": 20.0, "smallest": 0.9, "largest": 1.0},
    {"sensitivity": 2.0, "smallest": 0.5, "largest": 0.999},
]
