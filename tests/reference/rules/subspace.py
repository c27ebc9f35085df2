"""Subspace-of-information forgetting, SIFt-RLS (Lai & Bernstein, arXiv 2404.10844).

Compact SVD of the whitened regressor phi = U S V^T; the q singular values >= ``threshold`` are
kept: phi_f = U_q^T phi, y_f = U_q^T y. Everything below the threshold is neither forgotten nor
accumulated; with q = 0 the sample is skipped.

    F = (1 - lambda_k) R phi_f^T (phi_f R phi_f^T)^-1 phi_f R,  measured: (phi_f, y_f)
    published (the pair R, P):
      Rbar = R - F,  Pbar = P + ((1 - lambda)/lambda) phi_f^T (phi_f R phi_f^T)^-1 phi_f
      R_{k+1} = Rbar + phi_f^T phi_f
      P_{k+1} = Pbar - Pbar phi_f^T (I + phi_f Pbar phi_f^T)^-1 phi_f Pbar
      theta_{k+1} = theta + P_{k+1} phi_f^T (y_f - phi_f theta)
"""

from __future__ import annotations

from ..eigen import svd
from ..gf_rls import Measurement
from ..linalg import Matrix, Real, block, identity, inverse, symmetric, transpose
from ..step import Rule, Step
from .form import PublishedForm, measured

RATED = True


def informative(phi: Matrix, threshold: Real) -> Matrix:
    """U_q (p x q): the left singular vectors of phi whose singular value is >= threshold."""
    u, s, _ = svd(phi)
    q = sum(1 for x in s if x >= threshold)
    return block(u, range(u.nrows()), range(q))


class Dense(Rule):
    def __init__(self, n: int, threshold: float) -> None:
        self.threshold = Real(threshold)
        self.choose = Matrix(0, 0)

    def skips(self, step: Step) -> bool:
        self.choose = transpose(informative(step.phi, self.threshold))
        return self.choose.nrows() == 0

    def measurement(self, step: Step, y: Matrix) -> Measurement:
        choose = self.choose
        return Measurement((choose * step.phi).mid(), (choose * y).mid(), identity(choose.nrows()))

    def forgetting(self, step: Step) -> Matrix:
        phi = (self.choose * step.phi).mid()
        image = (phi * step.information).mid()
        gram = inverse((image * transpose(phi)).mid())
        return ((1 - step.factor) * (transpose(image) * gram * image)).mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, threshold: float) -> None:
        super().__init__(theta, covariance)
        self.information, self.threshold = inverse(covariance), Real(threshold)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        choose = transpose(informative(phi, self.threshold))
        if choose.nrows() == 0:
            return
        phi, y = (choose * phi).mid(), (choose * y).mid()
        r = self.information
        gram = inverse((phi * r * transpose(phi)).mid())
        lost = r * transpose(phi) * gram * phi * r
        self.information = symmetric(r - (1 - factor) * lost + transpose(phi) * phi)
        wider = self.covariance + (1 - factor) / factor * (transpose(phi) * gram * phi)
        self.covariance = measured(symmetric(wider), phi)
        self.correct(phi, y)


def cases(n: int) -> list[dict[str, object]]:
    """A threshold that only silence meets, and one that cuts into ordinary samples."""
    return [{"threshold": 1e-3}, {"threshold": 1.0}]
