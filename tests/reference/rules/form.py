"""What published forms share: their state and the measurement step in covariance form."""

from __future__ import annotations

from ..linalg import Matrix, Real, identity, inverse, symmetric, transpose


def gain(covariance: Matrix, phi: Matrix, gamma: Matrix | None = None) -> Matrix:
    """K = P phi^T (Gamma + phi P phi^T)^-1."""
    noise = identity(phi.nrows()) if gamma is None else gamma
    spread = (noise + phi * covariance * transpose(phi)).mid()
    return (covariance * transpose(phi) * inverse(spread)).mid()


def measured(covariance: Matrix, phi: Matrix, gamma: Matrix | None = None) -> Matrix:
    """P - K phi P, the covariance form of R + phi^T Gamma^-1 phi."""
    return symmetric(covariance - gain(covariance, phi, gamma) * phi * covariance)


class PublishedForm:
    """theta and P of an algorithm that is printed for Gamma = I."""

    def __init__(self, theta: Matrix, covariance: Matrix) -> None:
        self.theta, self.covariance = theta, covariance

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        raise NotImplementedError

    def correct(self, phi: Matrix, y: Matrix) -> None:
        """theta + P_{k+1} phi^T (y - phi theta), with P_{k+1} already in ``covariance``."""
        step = self.covariance * transpose(phi) * (y - phi * self.theta)
        self.theta = (self.theta + step).mid()
