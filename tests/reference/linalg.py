"""Small dense linear algebra in 256-bit arithmetic, on ``flint.arb_mat``.

The entries are balls (value and error radius). A recursion lets the radii grow although the
values stay good, so results are reduced to their midpoints; 256 bits are 77 decimal digits, and
the self-check of the references measures what is left of them.
"""

from __future__ import annotations

from functools import cache
from operator import mul

import flint
import numpy as np

BITS = 256
flint.ctx.prec = BITS

Matrix = flint.arb_mat
Real = flint.arb

# Jacobi iterations stop here: 2**-240 of the largest entry, 16 bits above the rounding level.
CONVERGED = Real(2) ** (16 - BITS)
# Rows of an exactly rank-deficient matrix keep a residue of about 2**-BITS; half the bits tell
# that residue from any singular value that 53-bit input can have (at least 2**-106 relative).
ZERO = Real(2) ** -112


def matrix(values: object) -> Matrix:
    """Exact copy of a 2-D array of floats (or of a list of lists of reals)."""
    return Matrix(values.tolist() if isinstance(values, np.ndarray) else values)


@cache
def identity(n: int) -> Matrix:
    """Not to be changed in place: there is one of each size."""
    return Matrix([[int(i == j) for j in range(n)] for i in range(n)])


def diagonal(values: list[Real]) -> Matrix:
    n = len(values)
    return Matrix([[values[i] if i == j else 0 for j in range(n)] for i in range(n)])


def symmetric_parameter(value: object, n: int) -> Matrix:
    """A scalar, a diagonal (n,) or a full (n, n) array as an n x n matrix."""
    array = np.asarray(value, dtype=float)
    if array.ndim == 0:
        return diagonal([Real(float(array))] * n)
    if array.ndim == 1:
        return diagonal([Real(float(x)) for x in array])
    return matrix(array)


def transpose(a: Matrix) -> Matrix:
    return a.transpose()


def symmetric(a: Matrix) -> Matrix:
    """Midpoint of the symmetric part."""
    return ((a + a.transpose()) / 2).mid()


def inverse(a: Matrix) -> Matrix:
    return a.inv().mid()


def trace(a: Matrix) -> Real:
    return a.trace().mid()


def dot(a: list[Real], b: list[Real]) -> Real:
    """Sum of the products, up to the end of the shorter list."""
    return sum(map(mul, a, b), Real(0)).mid()


def columns(a: Matrix) -> list[list[Real]]:
    return a.transpose().tolist()


def block(a: Matrix, rows: range, cols: range) -> Matrix:
    return Matrix([[a[i, j] for j in cols] for i in rows])


def block_diagonal(a: Matrix, blocks: list[range]) -> Matrix:
    """``a`` with everything outside the diagonal blocks set to zero."""
    owner = {i: b for b, members in enumerate(blocks) for i in members}
    n = a.nrows()
    return Matrix([[a[i, j] if owner[i] == owner[j] else 0 for j in range(n)] for i in range(n)])


def cholesky(a: Matrix) -> Matrix:
    """Lower L with L L^T = a; ``ArithmeticError`` unless ``a`` is positive definite."""
    low: list[list[Real]] = []
    for j, given in enumerate(a.tolist()):
        row: list[Real] = []
        for above, value in zip(low, given, strict=False):
            row.append((_less(value, row, above) / above[-1]).mid())
        pivot = _less(given[j], row, row).mid()
        if not pivot > 0:
            raise ArithmeticError(f"not positive definite: pivot {j} is {pivot}")
        low.append([*row, pivot.sqrt().mid()])
    return Matrix([row + [0] * (len(low) - len(row)) for row in low])


def _less(value: Real, a: list[Real], b: list[Real]) -> Real:
    """``value`` less the products, up to the end of the shorter list."""
    for x, y in zip(a, b, strict=False):
        value -= x * y
    return value


def to_float(a: Matrix) -> np.ndarray:
    return np.array([[float(x.mid()) for x in row] for row in a.tolist()])


def difference(a: Matrix, b: Matrix) -> float:
    """Largest entry of |a - b| relative to the largest entry of |b|."""
    scale = max(abs(x) for x in b.mid().entries())
    worst = max(abs(x) for x in (a - b).mid().entries())
    return float((worst / scale).mid()) if scale > 0 else float(worst)
