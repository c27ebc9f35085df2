"""Fortescue, Kershenbaum & Ydstie (1981). For the next sample.

    lambda_{k+1} = clip(1 - tr(e^T (I + S)^-1 e) / (targets N_0 sigma^2)),   lambda_0 = largest

``memory`` = N_0 (the nominal memory for one row), ``noise_variance`` = sigma^2 in whitened units.
The original divides P+ by this factor after the update of sample k, which is forgetting it before
the data of sample k + 1; one row: 1 - e^2 / (N_0 sigma^2 (1 + s)). It keeps the discounted sum of
squared a-posteriori errors at N_0 sigma^2. p rows (derived) make the nominal memory N_0 / p.
"""

from __future__ import annotations

from ..linalg import Matrix, Real, identity, inverse, trace, transpose
from ..step import Step
from .clip import ClippedRate


class Rate(ClippedRate):
    def __init__(
        self, memory: float, noise_variance: float, smallest: float, largest: float
    ) -> None:
        super().__init__(smallest, largest)
        self.total = Real(memory) * Real(noise_variance)
        self.next = self.largest

    def factor(self, step: Step) -> Real:
        return self.next

    def after(self, step: Step, covariance: Matrix) -> None:
        weight = inverse(identity(step.rows) + step.spread)
        energy = trace(transpose(step.error) * weight * step.error) / step.targets
        self.next = self.clip(1 - energy / self.total)


CASES = [
    {"memory": 100.0, "noise_variance": 0.01, "smallest": 0.9, "largest": 1.0},
    {"memory": 20.0, "noise_variance": 0.05, "smallest": 0.5, "largest": 0.99},
]
