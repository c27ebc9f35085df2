"""Stabilised linear forgetting (Kulhavy & Kraus 1996; Parkum, Poulsen & Holst 1992).

    Pbar = lambda_k P + (1 - lambda_k) P_inf,   F = R - Pbar^-1
    published: P+ = Pbar - K phi Pbar,  K = Pbar phi^T (I + phi Pbar phi^T)^-1,  theta + K e

``covariance`` is P_inf: a scalar, a diagonal (n,) or a full (n, n) matrix, positive definite.
Proper iff P <= P_inf, which holds for ever if P_0 <= P_inf. The source measures first and forgets
afterwards; here every sample forgets first, which is the same from the first Pbar on.
"""

from __future__ import annotations

import numpy as np

from ..linalg import Matrix, Real, inverse, symmetric, symmetric_parameter
from ..step import Rule, Step
from .form import PublishedForm, gain, measured

RATED = True


def average(p: Matrix, target: Matrix, factor: Real) -> Matrix:
    """lambda P + (1 - lambda) P_inf."""
    return symmetric(factor * p + (1 - factor) * target)


class Dense(Rule):
    def __init__(self, n: int, covariance: object) -> None:
        self.target = symmetric_parameter(covariance, n)

    def forgetting(self, step: Step) -> Matrix:
        wider = average(step.covariance, self.target, step.factor)
        return (step.information - inverse(wider)).mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, start: Matrix, covariance: object) -> None:
        super().__init__(theta, start)
        self.target = symmetric_parameter(covariance, theta.nrows())

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        wider = average(self.covariance, self.target, factor)
        self.theta = (self.theta + gain(wider, phi) * (y - phi * self.theta)).mid()
        self.covariance = measured(wider, phi)


def cases(n: int) -> list[dict[str, object]]:
    """P_0 = P_inf, P_0 above it (improper), a diagonal and a full one."""
    w = np.cos(np.arange(1.0, n + 1))
    return [
        {"covariance": 100.0},
        {"covariance": 0.5},
        {"covariance": np.linspace(20.0, 200.0, n)},
        {"covariance": np.diag(np.linspace(10.0, 50.0, n)) + 20.0 * np.outer(w, w)},
    ]
