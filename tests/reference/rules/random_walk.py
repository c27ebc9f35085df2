"""Parameters as a Gaussian random walk: the Kalman filter with state transition I.

    Pbar = P + Q,   F = R - (P + Q)^-1            (predict, then measure; always proper)
    published: Pbar = P + Q, K = Pbar phi^T (I + phi Pbar phi^T)^-1, theta + K e,
               P_{k+1} = (I - K phi) Pbar

``process_noise`` is Q per sample, for unit measurement noise (Gamma): a scalar, (n,) or (n, n),
positive semidefinite. The reported P is that of the estimate after the data (not of the
prediction), so the first sample adds Q to P_0 as well.
"""

from __future__ import annotations

import numpy as np

from ..linalg import Matrix, Real, inverse, symmetric, symmetric_parameter
from ..step import Rule, Step
from .form import PublishedForm, gain

RATED = False


class Dense(Rule):
    def __init__(self, n: int, process_noise: object) -> None:
        self.noise = symmetric_parameter(process_noise, n)

    def forgetting(self, step: Step) -> Matrix:
        return (step.information - inverse(step.covariance + self.noise)).mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, process_noise: object) -> None:
        super().__init__(theta, covariance)
        self.noise = symmetric_parameter(process_noise, theta.nrows())

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        wider = self.covariance + self.noise
        k = gain(wider, phi)
        self.theta = (self.theta + k * (y - phi * self.theta)).mid()
        self.covariance = symmetric(wider - k * phi * wider)


def cases(n: int) -> list[dict[str, object]]:
    w = np.cos(np.arange(1.0, n + 1))
    full = np.diag(np.linspace(1e-4, 1e-3, n)) + 1e-3 * np.outer(w, w)
    return [
        {"process_noise": 1e-4},
        {"process_noise": np.linspace(0.0, 1e-3, n)},
        {"process_noise": full},
    ]
