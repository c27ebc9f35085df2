"""Bruce, Goel & Bernstein (2020): ratio of two moving RMS values of the error. Uses this sample.

    g = sqrt(mean of |e|^2 over the last tau_n / mean over the last tau_d) - 1
    lambda_k = clip(1 / (1 + eta max(0, g)))

``sensitivity`` = eta >= 0, ``short_window`` = tau_n < ``long_window`` = tau_d samples, both windows
include this sample. Until tau_d errors were seen, and when the long mean is 0: lambda = largest.
"""

from __future__ import annotations

from ..linalg import Real
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(
        self,
        sensitivity: float,
        short_window: int,
        long_window: int,
        smallest: float,
        largest: float,
    ) -> None:
        super().__init__(smallest, largest)
        self.sensitivity, self.short, self.long = Real(sensitivity), short_window, long_window
        self.squares: list[Real] = []

    def factor(self, step: Step) -> Real:
        self.squares = [*self.squares, step.square][-self.long :]
        total = sum(self.squares)
        if len(self.squares) < self.long or total == 0:
            return self.largest
        ratio = (sum(self.squares[-self.short :]) / self.short) / (total / self.long)
        excess = ratio.sqrt() - 1
        return self.clip(1 / (1 + self.sensitivity * excess)) if excess > 0 else self.largest


CASES = [
    {"sensitivity": 0.1, "short_window": 5, "long_window": 40, "smallest": 0.8, "largest": 1.0},
    {"sensitivity": 1.0, "short_window": 1, "long_window": 8, "smallest": 0.9, "largest": 0.99},
]
