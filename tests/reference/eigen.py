"""Symmetric eigenvalues and singular values by Jacobi rotations, in 256-bit arithmetic."""

from __future__ import annotations

from functools import cache

import numpy as np

from .linalg import CONVERGED, ZERO, Matrix, Real, dot, identity, matrix, to_float, transpose

SWEEPS = 60
# A first-order correction is used where it is smaller than this; it then leaves its square.
SEPARATED = Real(2) ** -20
# 2**-40 (or better) after double precision becomes 2**-80, 2**-160, below rounding.
REFINEMENTS = 3
ITERATIONS = 10


def rotation(app: Real, aqq: Real, apq: Real) -> tuple[Real, Real]:
    """Cosine and sine of the rotation that diagonalises [[app, apq], [apq, aqq]]."""
    t = (aqq - app) / (2 * apq)
    sign = -1 if t < 0 else 1
    tangent = sign / (abs(t) + (1 + t * t).sqrt())
    cosine = (1 / (1 + tangent * tangent).sqrt()).mid()
    return cosine, (tangent * cosine).mid()


def rotate(a: list[Real], b: list[Real], cosine: Real, sine: Real) -> tuple[list, list]:
    """The pair of rows (cosine a - sine b, sine a + cosine b)."""
    pairs = list(zip(a, b, strict=True))
    return [cosine * x - sine * y for x, y in pairs], [sine * x + cosine * y for x, y in pairs]


def eigen_symmetric(a: Matrix) -> tuple[list[Real], Matrix]:
    """Eigenvalues, largest first, and the orthogonal matrix of eigenvectors (as columns).

    Double-precision eigenvectors are the start; first-order corrections refine separated pairs,
    and cyclic Jacobi does what is left (clusters). Both converge quadratically from there.
    """
    n = a.nrows()
    v = matrix(np.linalg.eigh(to_float(a))[1])
    for _ in range(REFINEMENTS):
        v = _refined(a, v)
    v = _orthogonal(v)
    work = (transpose(v) * a * v).mid().tolist()
    vectors = transpose(v).tolist()
    limit = max(abs(x) for row in work for x in row) * CONVERGED
    for _ in range(SWEEPS):
        if not _sweep(work, vectors, limit):
            break
    else:
        raise ArithmeticError("Jacobi iteration did not converge")
    order = sorted(range(n), key=lambda i: work[i][i], reverse=True)
    ordered = transpose(Matrix([vectors[i] for i in order]))
    return [work[i][i] for i in order], ordered.mid()


def _refined(a: Matrix, v: Matrix) -> Matrix:
    """One step for eigenvectors and their orthogonality at once (Ogita & Aishima 2018).

    With G = V^T V, S = V^T A V and the eigenvalues l_i = s_ii / g_ii, the new V is V (I + E).
    E_ij = (s_ij - l_j g_ij) / (l_j - l_i) turns a separated pair into eigenvectors; elsewhere
    E = (I - G) / 2 only makes V orthogonal.
    """
    n, left = v.nrows(), transpose(v)
    departure = (left * v - identity(n)).mid()  # G - I
    lean, work = departure.tolist(), (left * a * v).mid().tolist()
    step = (departure / -2).tolist()
    values = [work[i][i] / (1 + lean[i][i]) for i in range(n)]
    for i in range(n - 1):
        for j in range(i + 1, n):
            gap, off = values[j] - values[i], work[i][j]
            if abs(off) < SEPARATED * abs(gap):
                step[i][j] = (off - values[j] * lean[i][j]) / gap
                step[j][i] = (values[i] * lean[i][j] - off) / gap
    return (v + v * Matrix(step)).mid()


def _orthogonal(v: Matrix) -> Matrix:
    """Newton-Schulz: every iteration squares the departure from orthogonality."""
    near, three = _about_identity(v.nrows())
    for _ in range(ITERATIONS):
        gram = (transpose(v) * v).mid()
        if near.contains(gram):
            return v
        v = (v * (three - gram) / 2).mid()
    raise ArithmeticError("Newton-Schulz iteration did not converge")


@cache
def _about_identity(n: int) -> tuple[Matrix, Matrix]:
    """I, with what rounding leaves of it as radius, and 3 I."""
    rounding = Real(0, CONVERGED)
    return identity(n) + Matrix([[rounding] * n for _ in range(n)]), 3 * identity(n)


def _sweep(work: list[list[Real]], vectors: list[list[Real]], limit: Real) -> bool:
    """One cyclic sweep; False when nothing was left to rotate."""
    n, moved = len(work), False
    for p in range(n - 1):
        for q in range(p + 1, n):
            if abs(work[p][q]) <= limit:
                continue
            moved = True
            cosine, sine = rotation(work[p][p], work[q][q], work[p][q])
            work[p], work[q] = rotate(work[p], work[q], cosine, sine)
            left, right = rotate([row[p] for row in work], [row[q] for row in work], cosine, sine)
            for i, row in enumerate(work):
                row[p], row[q] = left[i].mid(), right[i].mid()
            vectors[p], vectors[q] = rotate(vectors[p], vectors[q], cosine, sine)
    return moved


def svd(a: Matrix) -> tuple[Matrix, list[Real], Matrix]:
    """Compact decomposition a = U diag(s) V^T with s > 0, largest first.

    One-sided Jacobi on the rows, so the cost follows the number of rows. Singular values below
    2**-112 of the largest are zero (rounding residue of exact rank deficiency) and left out.
    """
    rows, count = a.tolist(), a.nrows()
    left = [[Real(int(i == j)) for j in range(count)] for i in range(count)]
    limit = sum(dot(r, r) for r in rows) * CONVERGED
    for _ in range(SWEEPS):
        moved = False
        for p in range(count - 1):
            for q in range(p + 1, count):
                pq = dot(rows[p], rows[q])
                if abs(pq) <= limit:
                    continue
                moved = True
                turn = rotation(dot(rows[p], rows[p]), dot(rows[q], rows[q]), pq)
                rows[p], rows[q] = rotate(rows[p], rows[q], *turn)
                left[p], left[q] = rotate(left[p], left[q], *turn)
        if not moved:
            break
    else:
        raise ArithmeticError("Jacobi iteration did not converge")
    return _sorted(rows, left, a.ncols())


def _sorted(rows: list, left: list, n: int) -> tuple[Matrix, list[Real], Matrix]:
    lengths = [dot(r, r).sqrt().mid() for r in rows]
    largest = max(lengths)
    order = sorted(range(len(rows)), key=lambda i: lengths[i], reverse=True)
    order = [i for i in order if lengths[i] > largest * ZERO]
    if not order:
        return Matrix(len(rows), 0), [], Matrix(n, 0)
    right = [[(x / lengths[i]).mid() for x in rows[i]] for i in order]
    u = transpose(Matrix([left[i] for i in order]))
    return u, [lengths[i] for i in order], transpose(Matrix(right))
