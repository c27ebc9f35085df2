"""Exponential forgetting, with any rate. GF-RLS V-B (37)-(40) and V-C (41)-(44).

F = (1 - lambda_k) R

published: P_{k+1} = (P - P phi^T (lambda I + phi P phi^T)^-1 phi P) / lambda   [tutorial (8)]
"""

from __future__ import annotations

from ..linalg import Matrix, Real, diagonal, inverse, symmetric, transpose
from ..step import Rule, Step
from .form import PublishedForm

RATED = True


class Dense(Rule):
    def __init__(self, n: int) -> None:
        pass

    def forgetting(self, step: Step) -> Matrix:
        return ((1 - step.factor) * step.information).mid()


class Published(PublishedForm):
    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        p = self.covariance
        spread = diagonal([factor] * phi.nrows()) + phi * p * transpose(phi)
        lost = p * transpose(phi) * inverse(spread) * phi * p
        self.covariance = symmetric((p - lost) / factor)
        self.correct(phi, y)


def cases(n: int) -> list[dict[str, object]]:
    return [{}]
