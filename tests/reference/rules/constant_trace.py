"""Constant trace (Irving; Astrom & Wittenmark). Measures first, then rescales.

    P_{k+1} = c1 P+ / tr(P+) + c2 I,   c2 = ``floor``, c1 = n (``level`` - ``floor``)

so that tr(P_{k+1}) = n ``level`` and floor I <= P_{k+1} <= (c1 + c2) I for every input. Applied
after every used sample, also one with phi = 0. Embedded (E1) with G = X - P_{k+1}^-1; improper in
general, because it can shrink P.
    published: K = P phi^T (I + phi P phi^T)^-1, P+ = P - K phi P, then the line above
"""

from __future__ import annotations

from ..linalg import Matrix, Real, identity, inverse, symmetric, trace
from ..step import MeasureThenForget, Step
from .form import PublishedForm, gain, measured

RATED = False


class Dense(MeasureThenForget):
    def __init__(self, n: int, level: float, floor: float) -> None:
        super().__init__(n)
        self.level, self.floor = Real(level), Real(floor)

    def after(self, step: Step, covariance: Matrix) -> None:
        n = step.parameters
        scale = n * (self.level - self.floor) / trace(covariance)
        held = symmetric(scale * covariance + self.floor * identity(n))
        self.pending = (inverse(covariance) - inverse(held)).mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, level: float, floor: float) -> None:
        super().__init__(theta, covariance)
        n = theta.nrows()
        self.c1, self.c2 = n * (Real(level) - Real(floor)), Real(floor)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        error = (y - phi * self.theta).mid()
        self.theta = (self.theta + gain(self.covariance, phi) * error).mid()
        after = measured(self.covariance, phi)
        self.covariance = symmetric(
            self.c1 * after / trace(after) + self.c2 * identity(after.nrows())
        )


def cases(n: int) -> list[dict[str, object]]:
    return [{"level": 100.0, "floor": 0.01}, {"level": 1.0, "floor": 0.5}]
