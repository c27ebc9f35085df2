"""lambda_k = forgetting_factor for every k (GF-RLS V-B)."""

from __future__ import annotations

from ..linalg import Real
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(self, forgetting_factor: float) -> None:
        super().__init__(forgetting_factor, forgetting_factor)
        self.value = Real(forgetting_factor)

    def factor(self, step: Step) -> Real:
        return self.value


CASES = [{"forgetting_factor": 0.98}]
