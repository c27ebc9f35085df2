"""Eigenvalues of P from its factor, to full relative accuracy each.

Without excitation the condition number of P passes 1e16 and the smallest eigenvalues of the dense
matrix are rounding. Those of U D Uᵀ are not lost: one-sided Jacobi rotations of the columns of
U √D find each to its last digits, whatever D is, as long as U is well conditioned
(J. Demmel, K. Veselić, *Jacobi's method is more accurate than QR*, SIAM J. Matrix Anal. Appl.
13(4), 1992).
"""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

SWEEPS = 30
"""More than any matrix needs; the loop stops at the sweep that turns nothing."""


def eigenpairs(upper: Array, diagonal: Array) -> tuple[Array, Array]:
    """Eigenvalues, descending, and eigenvectors of a stack of U diag(d) Uᵀ.

    Parameters
    ----------
    upper : (T, n, n)
        Unit upper triangular.
    diagonal : (T, n)
        Positive.

    Returns
    -------
    values : (T, n)
    vectors : (T, n, n)
        One a column.

    Examples
    --------
    >>> values, _ = eigenpairs(np.array([[[1.0, 1.0], [0.0, 1.0]]]), np.array([[1e40, 1.0]]))
    >>> values.round(6).tolist()
    [[1e+40, 1.0]]
    """
    columns = upper * np.sqrt(diagonal)[:, np.newaxis, :]
    pairs = list(combinations(range(columns.shape[2]), 2))
    for _ in range(SWEEPS):
        turned = [_rotate(columns, i, j) for i, j in pairs]
        if not any(turned):
            break
    values = np.einsum("tij,tij->tj", columns, columns)
    order = np.argsort(-values, axis=1)
    values = np.take_along_axis(values, order, axis=1)
    columns = np.take_along_axis(columns, order[:, np.newaxis, :], axis=2)
    return values, columns / np.sqrt(values)[:, np.newaxis, :]


def _rotate(columns: Array, i: int, j: int) -> bool:
    """Make columns i and j of each matrix orthogonal; False where they all were."""
    a, b = columns[:, :, i], columns[:, :, j]
    aa, bb, ab = (np.einsum("ti,ti->t", x, y) for x, y in ((a, a), (b, b), (a, b)))
    # Roots first: the product of the squares would overflow long before P does.
    oblique = np.abs(ab) > 4 * np.finfo(float).eps * np.sqrt(aa) * np.sqrt(bb)
    if not oblique.any():
        return False
    zeta = (bb - aa) / (2 * np.where(oblique, ab, 1.0))
    tangent = np.where(zeta >= 0, 1.0, -1.0) / (np.abs(zeta) + np.hypot(1.0, zeta))
    tangent = np.where(oblique, tangent, 0.0)[:, np.newaxis]
    cosine = 1 / np.hypot(1.0, tangent)
    columns[:, :, i], columns[:, :, j] = cosine * (a - tangent * b), cosine * (tangent * a + b)
    return True
