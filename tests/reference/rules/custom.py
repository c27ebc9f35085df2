"""Theorem 1 itself: the user's F_k. (9)-(10), admissible iff P_k^-1 - F_k > 0 (12).

``function(information, phi)`` returns F_k (n x n, symmetric); information is R_k, phi the whitened
regressor. A step with R_k - F_k not positive definite is refused with nothing changed.
    published: the same recursion written with (11), P_k^-1 = P_0^-1 + sum_{i<k} (-F_i + phi^T phi)
"""

from __future__ import annotations

from collections.abc import Callable

from ..linalg import Matrix, Real, identity, inverse, symmetric, transpose
from ..step import Rule, Step
from .form import PublishedForm

RATED = False
Function = Callable[[Matrix, Matrix], Matrix]


class Dense(Rule):
    def __init__(self, n: int, function: Function) -> None:
        self.function = function

    def forgetting(self, step: Step) -> Matrix:
        return symmetric(self.function(step.information, step.phi))


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, function: Function) -> None:
        super().__init__(theta, covariance)
        self.function, self.total = function, inverse(covariance)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        forgotten = symmetric(self.function(self.total, phi))
        self.total = symmetric(self.total - forgotten + transpose(phi) * phi)
        self.covariance = inverse(self.total)
        self.correct(phi, y)


def leak(information: Matrix, phi: Matrix) -> Matrix:
    """F = R/32 - I/1024: R - F > 0 always, improper where R < I/32. Exact in binary."""
    return information / 32 - identity(information.nrows()) / 1024


def cases(n: int) -> list[dict[str, object]]:
    return [{"function": leak}]
