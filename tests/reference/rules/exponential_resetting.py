"""Exponential resetting (Lai & Bernstein 2023). GF-RLS V-E, (51)-(53).

    F = (1 - lambda_k) (R - R_inf)
    published: P_{k+1}^-1 = lambda_k P_k^-1 + (1 - lambda_k) R_inf + phi^T phi   (51)

``information`` is R_inf: a scalar, a diagonal (n,) or a full (n, n) matrix, positive semidefinite.
"""

from __future__ import annotations

import numpy as np

from ..linalg import Matrix, Real, inverse, symmetric, symmetric_parameter, transpose
from ..step import Rule, Step
from .form import PublishedForm

RATED = True


class Dense(Rule):
    def __init__(self, n: int, information: object) -> None:
        self.target = symmetric_parameter(information, n)

    def forgetting(self, step: Step) -> Matrix:
        return ((1 - step.factor) * (step.information - self.target)).mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, information: object) -> None:
        super().__init__(theta, covariance)
        self.target = symmetric_parameter(information, theta.nrows())

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        before = inverse(self.covariance)
        after = factor * before + (1 - factor) * self.target + transpose(phi) * phi
        self.covariance = symmetric(inverse(after))
        self.correct(phi, y)


def cases(n: int) -> list[dict[str, object]]:
    """Proper scalar, improper scalar (R_0 < R_inf), diagonal, full and rank-one R_inf."""
    w = np.cos(np.arange(1.0, n + 1))
    full = np.diag(np.linspace(0.01, 0.05, n)) + 0.02 * np.outer(w, w)
    return [
        {"information": 0.01},
        {"information": 0.5},
        {"information": np.linspace(0.005, 0.02, n)},
        {"information": full},
        {"information": np.outer(w, w)},
    ]
