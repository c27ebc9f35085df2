"""Parameters as a Gaussian random walk: the Kalman filter with state transition I.

    Pbar = P + Q,   F = R - (P + Q)^-1            (predict, then measure; always proper)
    published: Pbar = A P A^T + Q, K = Pbar phi^T (I + phi Pbar phi^T)^-1, theta + K e,
               P_{k+1} = (I - K phi) Pbar, with A = I

``process_noise`` is Q per sample, for unit measurement noise (Gamma): a scalar, (n,) or (n, n),
positive semidefinite. The reported P is that of the estimate after the data (not of the
prediction), so the first sample adds Q to P_0 as well.

With a ``bound`` b, A A^T = kappa I, kappa = 1 - max Q_ii / b, here for a scalar or diagonal Q:
P <= b I makes Pbar <= b I.

With the cyclic ``schedule``, Q = sum_j w_j w_j^T with the r terms of cyclic resetting, and sample k
has Q_k = r w_j w_j^T, j = k mod r, in the place of Q. With a bound, row j of A_k and Q_k are those
of r samples: A_k = I but for kappa^(r/2) in row j, Q_k = (1 + kappa + ... + kappa^(r-1)) w_j w_j^T.
"""

from __future__ import annotations

import numpy as np

from ..linalg import (
    Matrix,
    Real,
    diagonal,
    identity,
    inverse,
    symmetric,
    symmetric_parameter,
    transpose,
)
from ..step import Rule, Step
from .cyclic_resetting import expansion
from .form import PublishedForm, gain

RATED = False

#: A_k and Q_k
Prediction = tuple[Matrix, Matrix]


def cycle(
    n: int,
    process_noise: object,
    bound: float | None = None,
    schedule: str = "every_sample",
) -> list[Prediction]:
    """A_k and Q_k of one cycle, a single sample unless it is cyclic."""
    noise, kappa = symmetric_parameter(process_noise, n), Real(1)
    if bound is not None:
        kappa -= max(noise[i, i] for i in range(n)) / Real(bound)
    if schedule == "every_sample":
        return [((kappa.sqrt() * identity(n)).mid(), noise)]
    vectors = expansion(process_noise, n)
    samples = sum((kappa**k for k in range(len(vectors))), Real(0))
    turns = [turn(w, kappa ** len(vectors), samples) for w in vectors]
    return turns or [(identity(n), Matrix(n, n))]


def turn(w: Matrix, kept: Real, samples: Real) -> Prediction:
    """A_k and Q_k where it is the turn of w, of which one element is not 0 unless ``kept`` is 1."""
    root = kept.sqrt()
    shrunk = [Real(1) if w[i, 0] == 0 else root for i in range(w.nrows())]
    return diagonal(shrunk), (samples * w * transpose(w)).mid()


def predicted(p: Matrix, prediction: Prediction) -> Matrix:
    """A P A^T + Q."""
    transition, noise = prediction
    return symmetric(transition * p * transpose(transition) + noise)


class Dense(Rule):
    def __init__(self, n: int, process_noise: object, **options: object) -> None:
        self.cycle = cycle(n, process_noise, **options)  # type: ignore[arg-type]

    def forgetting(self, step: Step) -> Matrix:
        wider = predicted(step.covariance, self.cycle[step.k % len(self.cycle)])
        return (step.information - inverse(wider)).mid()


class Published(PublishedForm):
    def __init__(
        self, theta: Matrix, covariance: Matrix, process_noise: object, **options: object
    ) -> None:
        super().__init__(theta, covariance)
        self.cycle = cycle(theta.nrows(), process_noise, **options)  # type: ignore[arg-type]
        self.k = 0

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        wider = predicted(self.covariance, self.cycle[self.k % len(self.cycle)])
        k = gain(wider, phi)
        self.theta = (self.theta + k * (y - phi * self.theta)).mid()
        self.covariance = symmetric(wider - k * phi * wider)
        self.k += 1


def cases(n: int) -> list[dict[str, object]]:
    w = np.cos(np.arange(1.0, n + 1))
    full = np.diag(np.linspace(1e-4, 1e-3, n)) + 1e-3 * np.outer(w, w)
    noises = [1e-4, np.linspace(0.0, 1e-3, n), full]
    cases: list[dict[str, object]] = [{"process_noise": noise} for noise in noises]
    cases += [{"process_noise": noise, "bound": 150.0} for noise in noises[:2]]
    return cases + [{**case, "schedule": "cyclic"} for case in cases]
