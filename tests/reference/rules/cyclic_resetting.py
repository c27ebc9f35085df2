"""Cyclic resetting, the O(n^2) substitute for exponential resetting (Lai & Bernstein 2023).

R_inf = sum_j w_j w_j^T, j = 0..r-1. For a scalar or diagonal R_inf these are sqrt(d_i) e_i for the
d_i > 0, the eigenvectors of the source; for a full R_inf the columns of its Cholesky factor with
diagonal pivots (the largest remaining one, the first of equals) in the order of the pivots, until
a pivot is <= 16 n eps max_i R_inf,ii. At sample k, with j = k mod r,

    v_k = sqrt((1 - lambda_k^r) / lambda_k^(r-1-j)) w_j
    F = (1 - lambda_k) R - v_k v_k^T        (not positive semidefinite inside a cycle: improper)
    published: phib = [phi; v_k^T],
      P_{k+1} = (P - P phib^T (lambda I + phib P phib^T)^-1 phib P) / lambda
      theta_{k+1} = theta_k + P_{k+1} phi^T e

One cycle without data is R -> lambda^r R + (1 - lambda^r) R_inf exactly (for a constant lambda).
"""

from __future__ import annotations

import numpy as np

from ..linalg import Matrix, Real, diagonal, inverse, symmetric, symmetric_parameter, transpose
from ..precision import epsilon
from ..step import Rule, Step
from .form import PublishedForm

RATED = True


def expansion(information: object, n: int) -> list[Matrix]:
    """The w_j (n x 1)."""
    a = symmetric_parameter(information, n)
    if np.ndim(information) < 2:
        return [_column(n, i, a[i, i].sqrt()) for i in range(n) if a[i, i] > 0]
    least = 16 * n * epsilon() * max(a[i, i] for i in range(n))
    found: list[Matrix] = []
    while len(found) < n:
        i = max(range(n), key=lambda j: a[j, j])
        if not a[i, i] > least:
            break
        w = (a * _column(n, i, 1 / a[i, i].sqrt())).mid()
        a = (a - w * transpose(w)).mid()
        found.append(w)
    return found


def _column(n: int, i: int, value: Real) -> Matrix:
    return Matrix([[value if j == i else 0] for j in range(n)]).mid()


def entry(vectors: list[Matrix], k: int, factor: Real) -> Matrix:
    """v_k (n x 1)."""
    r = len(vectors)
    j = k % r
    return (((1 - factor**r) / factor ** (r - 1 - j)).sqrt() * vectors[j]).mid()


class Dense(Rule):
    def __init__(self, n: int, information: object) -> None:
        self.vectors = expansion(information, n)

    def forgetting(self, step: Step) -> Matrix:
        forgotten = (1 - step.factor) * step.information
        if self.vectors:
            v = entry(self.vectors, step.k, step.factor)
            forgotten -= v * transpose(v)
        return forgotten.mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, information: object) -> None:
        super().__init__(theta, covariance)
        self.vectors, self.k = expansion(information, theta.nrows()), 0

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        rows = phi.tolist()
        if self.vectors:
            rows.append(entry(self.vectors, self.k, factor).entries())
        wide, p = Matrix(rows), self.covariance
        spread = diagonal([factor] * wide.nrows()) + wide * p * transpose(wide)
        lost = p * transpose(wide) * inverse(spread) * wide * p
        self.covariance = symmetric((p - lost) / factor)
        self.correct(phi, y)
        self.k += 1


def cases(n: int) -> list[dict[str, object]]:
    w = np.cos(np.arange(1.0, n + 1))
    full = np.diag(np.linspace(0.01, 0.05, n)) + 0.02 * np.outer(w, w)
    return [{"information": 0.01}, {"information": full}, {"information": np.outer(w, w)}]
