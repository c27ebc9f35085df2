"""The cost (4) of Theorem 1 and its minimiser, from all the data.

    J_k(t) = sum_i |y_i - phi_i t|^2_{Gamma_i^-1} - sum_i |t - theta_i|^2_{F_i}
             + |t - theta_0|^2_{P_0^-1}

The normal equations are summed term by term from this definition; the recursion's R and theta
enter only where the definition itself has them (theta_i inside the forgetting term).
"""

from __future__ import annotations

from .gf_rls import Measurement
from .linalg import Matrix, Real, inverse, trace, transpose


class Cost:
    """J_k, one term at a time."""

    def __init__(self, theta: Matrix, covariance: Matrix) -> None:
        self.prior = inverse(covariance)
        self.theta = theta
        self.hessian = self.prior
        self.right = self.prior * theta
        self.terms: list[tuple[Measurement | None, Matrix, Matrix]] = []

    def add(self, sample: Measurement | None, forgotten: Matrix, theta: Matrix) -> None:
        """The loss of ``sample`` (None: nothing measured) less |t - theta|^2_forgotten."""
        self.hessian = (self.hessian - forgotten).mid()
        self.right = (self.right - forgotten * theta).mid()
        if sample is not None:
            self.hessian = (self.hessian + sample.information).mid()
            self.right = (self.right + sample.evidence(sample.y)).mid()
        self.terms.append((sample, forgotten, theta))

    def minimiser(self) -> Matrix:
        """argmin J_k: the solution of the summed normal equations."""
        return self.hessian.solve(self.right).mid()

    def value(self, t: Matrix) -> Real:
        """J_k(t), evaluated from the definition (summed over the targets)."""
        total = _quadratic(t - self.theta, self.prior)
        for sample, forgotten, theta in self.terms:
            total -= _quadratic(t - theta, forgotten)
            if sample is not None:
                total += _quadratic(sample.y - sample.phi * t, inverse(sample.gamma))
        return total.mid()


def _quadratic(x: Matrix, weight: Matrix) -> Real:
    return trace(transpose(x) * weight * x)
