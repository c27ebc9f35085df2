"""Kreisselmeier's stabilised least squares (1990), "toward matrix forgetting": the sidebar of the
variable-direction tutorial, (S1)-(S3).

    choice 1:  F = (1 - lambda_k) (I - alpha P)^N R                                     (S2)
    choice 2:  F = (1 - lambda_k) (R - alpha I)^N (R + beta I)^-N R                     (S3)

``information`` = alpha > 0, ``shift`` = beta >= 0 (choice 2 only), ``power`` = N odd. All factors
commute with R: an eigenvalue r becomes r - (1 - lambda)(1 - alpha/r)^N r, or
r - (1 - lambda)((r - alpha)/(r + beta))^N r, which is positive for every r > 0.
    published: P_{k+1}^-1 = (I + M P) P^-1 + phi^T phi, M = -F (S1), by matrix products
N = 1, choice 1 is ``exponential_resetting`` with R_inf = alpha I; beta = 0 makes choice 2 choice 1.
Proper iff R >= alpha I, which holds for ever if P_0^-1 >= alpha I.
"""

from __future__ import annotations

from ..eigen import eigen_symmetric
from ..linalg import Matrix, Real, diagonal, identity, inverse, symmetric, transpose
from ..step import Rule, Step
from .form import PublishedForm

RATED = True


class Dense(Rule):
    def __init__(
        self, n: int, information: float, power: int = 1, choice: int = 1, shift: float = 0.0
    ) -> None:
        self.alpha, self.power = Real(information), power
        self.beta = Real(shift) if choice == 2 else Real(0)

    def forgetting(self, step: Step) -> Matrix:
        values, vectors = eigen_symmetric(step.information)
        lost = [
            (1 - step.factor) * ((r - self.alpha) / (r + self.beta)) ** self.power * r
            for r in values
        ]
        return (vectors * diagonal(lost) * transpose(vectors)).mid()


class Published(PublishedForm):
    def __init__(
        self,
        theta: Matrix,
        covariance: Matrix,
        information: float,
        power: int = 1,
        choice: int = 1,
        shift: float = 0.0,
    ) -> None:
        super().__init__(theta, covariance)
        self.alpha, self.beta = Real(information), Real(shift)
        self.power, self.choice = power, choice

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        p, one = self.covariance, identity(phi.ncols())
        r = inverse(p)
        base = one - self.alpha * p
        if self.choice == 2:
            base = (r - self.alpha * one) * inverse(r + self.beta * one)
        product = one
        for _ in range(self.power):
            product = (product * base).mid()
        m = -(1 - factor) * product * r
        after = (one + m * p) * r + transpose(phi) * phi
        self.covariance = symmetric(inverse(after))
        self.correct(phi, y)


def cases(n: int) -> list[dict[str, object]]:
    return [
        {"information": 0.01},
        {"information": 0.01, "power": 3},
        {"information": 0.01, "power": 3, "choice": 2, "shift": 0.5},
        {"information": 0.02, "power": 1, "choice": 2, "shift": 0.5},
    ]
