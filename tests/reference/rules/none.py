"""Recursive least squares without forgetting. GF-RLS V-A, (33)-(36).

F = 0
published: P_{k+1}^-1 = P_k^-1 + phi^T phi (34), theta_{k+1} = theta_k + P_{k+1} phi^T e (35)
"""

from __future__ import annotations

from ..linalg import Matrix, Real
from ..step import Rule, Step
from .form import PublishedForm, measured

RATED = False


class Dense(Rule):
    def __init__(self, n: int) -> None:
        self.zero = Matrix(n, n)

    def forgetting(self, step: Step) -> Matrix:
        return self.zero


class Published(PublishedForm):
    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        self.covariance = measured(self.covariance, phi)
        self.correct(phi, y)


def cases(n: int) -> list[dict[str, object]]:
    return [{}]
