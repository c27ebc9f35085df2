"""Theorem 1 of Lai & Bernstein, *Generalized forgetting RLS* (arXiv 2308.04259), dense.

    R_{k+1}     = R_k - F_k + phi^T Gamma^-1 phi                        (9)
    theta_{k+1} = theta_k + R_{k+1}^-1 phi^T Gamma^-1 (y - phi theta_k)   (10)

with R = P^-1. ``theta`` is n x targets (every column has the same phi, Gamma and F).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from .linalg import Matrix, cholesky, inverse, symmetric, transpose


@dataclass(frozen=True)
class Measurement:
    """What a step adds: phi (p x n), y (p x targets) and the weighting Gamma (p x p)."""

    phi: Matrix
    y: Matrix
    gamma: Matrix

    @cached_property
    def weighted(self) -> Matrix:
        """phi^T Gamma^-1."""
        return transpose(self.phi) * inverse(self.gamma)

    @cached_property
    def information(self) -> Matrix:
        """phi^T Gamma^-1 phi."""
        return self.weighted * self.phi

    def evidence(self, value: Matrix) -> Matrix:
        """phi^T Gamma^-1 value, for a p x targets ``value``."""
        return self.weighted * value


def theorem_1(
    information: Matrix, theta: Matrix, forgotten: Matrix, sample: Measurement
) -> tuple[Matrix, Matrix, Matrix]:
    """R, P and theta after one step of (9)-(10).

    ``ArithmeticError`` unless R - F > 0, condition (12).
    """
    kept = symmetric(information - forgotten)
    cholesky(kept)
    after = symmetric(kept + sample.information)
    covariance = symmetric(inverse(after))
    gain = covariance * sample.evidence(sample.y - sample.phi * theta)
    return after, covariance, (theta + gain).mid()
