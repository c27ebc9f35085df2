"""Variable-direction forgetting by oblique projection (Zhu, Yu & Wan 2022), (17)-(23).

With the largest singular value |phi|_2 >= ``threshold``:

    F = (1 - lambda_k) R phi^T (phi R phi^T)^+ phi R                            (17), (19)

else F = 0 (18). The data is added in both cases (23). The pseudo-inverse is decided on phi itself:
V (n x r) holds the right singular vectors of phi with s_i > tau s_1, tau = sqrt(eps) (2^-26
in double precision), and

    F = (1 - lambda) R V (V^T R V)^-1 V^T R,  Pbar = P + ((1 - lambda)/lambda) V (V^T R V)^-1 V^T

That is the printed expression whenever phi has rank r exactly.
    published: (17)-(23) with the Moore-Penrose inverse of phi R phi^T
"""

from __future__ import annotations

from ..eigen import eigen_symmetric, svd
from ..linalg import Matrix, Real, block, diagonal, inverse, symmetric, transpose
from ..precision import tolerance
from ..step import Rule, Step
from .form import PublishedForm

RATED = True
ROUNDING = Real(2) ** -200


def row_space(phi: Matrix) -> tuple[Matrix, Real]:
    """V (n x r), an orthonormal basis of the numerical row space, and the largest s."""
    _, s, v = svd(phi)
    if not s:
        return Matrix(phi.ncols(), 0), Real(0)
    rank = sum(1 for x in s if x > tolerance() * s[0])
    return block(v, range(v.nrows()), range(rank)), s[0]


class Dense(Rule):
    def __init__(self, n: int, threshold: float) -> None:
        self.threshold = Real(threshold)

    def forgetting(self, step: Step) -> Matrix:
        v, largest = row_space(step.phi)
        if largest < self.threshold or v.ncols() == 0:
            return Matrix(step.parameters, step.parameters)
        image = (step.information * v).mid()
        gram = inverse((transpose(v) * image).mid())
        return ((1 - step.factor) * (image * gram * transpose(image))).mid()


def pseudo_inverse(gram: Matrix) -> Matrix:
    """Moore-Penrose inverse of a positive-semidefinite matrix, with its exact rank.

    Only eigenvalues at the rounding level of 256 bits count as zero: a cut-off on phi R phi^T at
    working precision would depend on the conditioning of R.
    """
    values, vectors = eigen_symmetric(gram)
    least = values[0] * ROUNDING
    inverted = [1 / x if x > least else Real(0) for x in values]
    return (vectors * diagonal(inverted) * transpose(vectors)).mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, threshold: float) -> None:
        super().__init__(theta, covariance)
        self.information, self.threshold = inverse(covariance), Real(threshold)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        r = self.information
        if eigen_symmetric((phi * transpose(phi)).mid())[0][0] >= self.threshold**2:
            gram = pseudo_inverse((phi * r * transpose(phi)).mid())
            r = r - (1 - factor) * (r * transpose(phi) * gram * phi * r)
        self.information = symmetric(r + transpose(phi) * phi)
        self.covariance = inverse(self.information)
        self.correct(phi, y)


def cases(n: int) -> list[dict[str, object]]:
    return [{"threshold": 1e-3}, {"threshold": 1.0}]
