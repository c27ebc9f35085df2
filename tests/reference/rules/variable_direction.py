"""Variable-direction forgetting by eigen-decomposition (Goel, Bruce & Bernstein 2020), (64)-(71).

R = U diag(s) U^T, psi = phi U; direction i is forgotten iff |col_i(psi)| > ``threshold`` (67).
Eigenvectors of a repeated eigenvalue are not unique, so: eigenvalues in descending order form a
cluster while s_i - s_{i+1} <= tau s_i (tau = sqrt(eps): 2^-26 in double precision), and inside a
cluster the basis U_c is rotated by the right singular vectors of phi U_c. The forgotten directions
of a cluster are then q = U_c v_j for the singular values > threshold (at most rank(phi U_c) of
them); a cluster of one gives (67) unchanged. Over all forgotten directions q_j:

    Pbar = P + ((1 - lambda_k)/lambda_k) sum_j (q_j^T P q_j) q_j q_j^T,   F = R - Pbar^-1

which is U diag(s_i or lambda s_i) U^T for R - F. All data is added, below the threshold too.
    published: Lambda_k = U Lambdabar U^T (68), P_{k+1}^-1 = Lambda_k P_k^-1 Lambda_k + phi^T phi
    (64), as Pbar = Lambda^-1 P Lambda^-1 (71) and (70) with its transposes corrected
"""

from __future__ import annotations

from ..eigen import eigen_symmetric, svd
from ..linalg import Matrix, Real, block, diagonal, inverse, symmetric, transpose
from ..precision import tolerance
from ..step import Rule, Step
from .form import PublishedForm, measured

RATED = True


def clusters(values: list[Real]) -> list[range]:
    """Runs of (nearly) equal eigenvalues in a descending list."""
    starts = [0]
    for i in range(1, len(values)):
        if values[i - 1] - values[i] > tolerance() * values[i - 1]:
            starts.append(i)
    return [range(a, b) for a, b in zip(starts, [*starts[1:], len(values)], strict=True)]


def forgotten_directions(information: Matrix, phi: Matrix, threshold: Real) -> list[Matrix]:
    """The q_j (n x 1)."""
    values, vectors = eigen_symmetric(information)
    found = []
    for members in clusters(values):
        basis = block(vectors, range(vectors.nrows()), members)
        _, s, v = svd((phi * basis).mid())
        for j, size in enumerate(s):
            if size > threshold:
                found.append((basis * block(v, range(v.nrows()), range(j, j + 1))).mid())
    return found


class Dense(Rule):
    def __init__(self, n: int, threshold: float) -> None:
        self.threshold = Real(threshold)

    def forgetting(self, step: Step) -> Matrix:
        p = step.covariance
        wider = p
        for q in forgotten_directions(step.information, step.phi, self.threshold):
            share = (transpose(q) * p * q)[0, 0] * (1 - step.factor) / step.factor
            wider = wider + share * (q * transpose(q))
        return (step.information - inverse(wider)).mid()


class Published(PublishedForm):
    def __init__(self, theta: Matrix, covariance: Matrix, threshold: float) -> None:
        super().__init__(theta, covariance)
        self.threshold = Real(threshold)

    def update(self, phi: Matrix, y: Matrix, factor: Real) -> None:
        values, vectors = eigen_symmetric(inverse(self.covariance))
        stretch = Matrix(len(values), len(values))
        for members in clusters(values):
            stretch = stretch + self._stretch(vectors, members, phi, factor)
        wider = symmetric(stretch * self.covariance * stretch)
        self.covariance = measured(wider, phi)
        self.correct(phi, y)

    def _stretch(self, vectors: Matrix, members: range, phi: Matrix, factor: Real) -> Matrix:
        """Lambda^-1 (69) inside one cluster, in its rotated basis."""
        basis = block(vectors, range(vectors.nrows()), members)
        psi = (phi * basis).mid()
        if len(members) > 1:
            turn = eigen_symmetric((transpose(psi) * psi).mid())[1]
            basis, psi = (basis * turn).mid(), (psi * turn).mid()
        squares = (transpose(psi) * psi).mid()
        entries = [
            1 / factor.sqrt() if squares[i, i] > self.threshold**2 else Real(1)
            for i in range(len(members))
        ]
        return (basis * diagonal(entries) * transpose(basis)).mid()


def cases(n: int) -> list[dict[str, object]]:
    return [{"threshold": 1e-3}, {"threshold": 1.0}]
