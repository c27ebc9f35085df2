"""Parameters as a Gaussian random walk: the Kalman filter with state transition I.

    Pbar = P + Q,   F = R - (P + Q)^-1            (predict, then measure; always proper)
    published: Pbar = P + Q, K = Pbar phi^T (I + phi Pbar phi^T)^-1, theta + K e,
               P_{k+1} = (I - K phi) Pbar

``process_noise`` is Q per sample, for unit measurement noise (Gamma): a scalar, (n,) or (n, n),
positive semidefinite. The reported P is that of the estimate after the data (not of the
prediction), so the first sample adds Q to P_0 as well.

With the cyclic ``schedule``, Q = sum_j w_j w_j^T with the r terms of cyclic resetting, and sample k
has Q_k = r w_j w_j^T, j = k mod r, in the place of Q.
"""

from __future__ import annotations

import numpy as np

from ..linalg import Matrix, Real, inverse, symmetric, symmetric_parameter, transpose
from ..step import Rule, Step
from .cyclic_resetting import expansion
from .form import PublishedForm, gain

RATED = False


def _noises(process_noise: object, n: int, schedule: str) -> list[Matrix]:
    """Q_k of one cycle."""
    if schedule == "every_sample":
        return [symmetric_parameter(process_noise, n)]
    vectors = expansion(process_noise, n)
    return [(len(vectors) * w * transpose(w)).mid() for w in vectors] or [Matrix(n, n)]


class Dense(Rule):
    def __init__(self, n: int, process_noise: object, schedule: str = "every_sample") -> None:
        self.noises = _noises(process_noise, n, schedule)

    def forgetting(self, step: Step) -> Matrix:
        noise = self.noises[step.k % len(self.noises)]
        return (step.information - inverse(step.covariance + noise)).mid()


class Published(PublishedForm):
    def __init__(
        self,
        theta: Matrix,
        covariance: Matrix,
        process_noise: object,
        schedule: str = "every_sample",
    ) -> None:
        super().__init__(theta, covariance)
        self.noises, self.k = _noises(process_noise, theta.nrows(), schedule), 0

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        wider = self.covariance + self.noises[self.k % len(self.noises)]
        k = gain(wider, phi)
        self.theta = (self.theta + k * (y - phi * self.theta)).mid()
        self.covariance = symmetric(wider - k * phi * wider)
        self.k += 1


def cases(n: int) -> list[dict[str, object]]:
    w = np.cos(np.arange(1.0, n + 1))
    full = np.diag(np.linspace(1e-4, 1e-3, n)) + 1e-3 * np.outer(w, w)
    return [
        {"process_noise": 1e-4},
        {"process_noise": np.linspace(0.0, 1e-3, n)},
        {"process_noise": full},
        {"process_noise": 1e-4, "schedule": "cyclic"},
        {"process_noise": np.linspace(0.0, 1e-3, n), "schedule": "cyclic"},
        {"process_noise": full, "schedule": "cyclic"},
    ]
