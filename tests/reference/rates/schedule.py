"""The factors of a list, one a used sample; then the last one for ever, or the list again.

    lambda_k = factors[min(k, N - 1)]   (end = "hold"),   factors[k mod N]   (end = "repeat")
"""

from __future__ import annotations

from ..linalg import Real
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(self, factors: list[float], end: str) -> None:
        super().__init__(min(factors), max(factors))
        self.factors, self.end = [Real(factor) for factor in factors], end

    def factor(self, step: Step) -> Real:
        last = len(self.factors) - 1
        k = min(step.k, last) if self.end == "hold" else step.k % (last + 1)
        return self.factors[k]


CASES = [
    {"factors": [0.75, 0.875, 0.9375, 0.984375], "end": "hold"},
    {"factors": [0.96875, 1.0, 0.9375], "end": "repeat"},
]
