"""Directional forgetting by information-matrix decomposition (Cao & Schwartz 2000). GF-RLS V-G.

One row only. With |phi| > ``threshold``:

    F = (1 - lambda_k) R phi^T phi R / (phi R phi^T)                                   (63)
    Rbar = R - F (61),  Pbar = P + ((1 - lambda)/lambda) phi^T phi / (phi R phi^T)      (62)

else the sample is skipped. As printed, (58) would still add its data, so that sustained regressors
below the threshold were never forgotten and R grew without bound. (62) is printed without its
transposes.
    published: R_{k+1} = Rbar + phi^T phi (58), P_{k+1} by (59), theta by (60)
"""

from __future__ import annotations

from ..linalg import Matrix, Real, inverse, symmetric, trace, transpose
from ..step import Rule, Step
from .form import PublishedForm, measured

RATED = True


class Dense(Rule):
    single_row = True

    def __init__(self, n: int, threshold: float) -> None:
        self.threshold = Real(threshold)

    def skips(self, step: Step) -> bool:
        return not length(step.phi) > self.threshold

    def forgetting(self, step: Step) -> Matrix:
        image = (step.phi * step.information).mid()
        energy = trace(image * transpose(step.phi))
        return ((1 - step.factor) * (transpose(image) * image) / energy).mid()


def length(phi: Matrix) -> Real:
    """Euclidean norm of a row."""
    return trace(phi * transpose(phi)).sqrt().mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, threshold: float) -> None:
        super().__init__(theta, covariance)
        self.information, self.threshold = inverse(covariance), Real(threshold)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        r, p = self.information, self.covariance
        if not length(phi) > self.threshold:
            return
        energy = trace(phi * r * transpose(phi))
        p = p + (1 - factor) / factor * (transpose(phi) * phi) / energy
        r = r - (1 - factor) * (r * transpose(phi) * phi * r) / energy
        self.information = symmetric(r + transpose(phi) * phi)
        self.covariance = measured(symmetric(p), phi)
        self.correct(phi, y)


def cases(n: int) -> list[dict[str, object]]:
    """A threshold that only silence meets, and one that cuts into ordinary samples."""
    return [{"threshold": 1e-3}, {"threshold": 1.0}]
