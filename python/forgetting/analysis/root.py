"""A square root of covariances that serves badly scaled ones."""

from __future__ import annotations

import numpy as np

from .validation import Array


def square_root(covariance: Array, precision: float) -> tuple[Array, Array]:
    """Return C and C⁻¹ with P = C Cᵀ for each P of a stack (T, n, n).

    P is scaled to a unit diagonal first, so that the units of the parameters cost no digits.
    Variances that rounding has lost beside the largest are held at its roundoff, so that a
    root exists for every P with a positive diagonal.

    Examples
    --------
    >>> import numpy as np
    >>> root, inverse = square_root(np.array([[[4.0, 0.0], [0.0, 1e-12]]]), 1e-16)
    >>> bool(np.allclose(root @ np.swapaxes(root, 1, 2), np.diag([4.0, 1e-12]), rtol=1e-12))
    True
    """
    deviation = np.sqrt(np.maximum(np.diagonal(covariance, axis1=1, axis2=2), np.finfo(float).tiny))
    values, vectors = np.linalg.eigh(covariance / deviation[:, :, None] / deviation[:, None, :])
    largest = np.maximum(values[:, -1:], 1.0)  # at least 1 beside a unit diagonal
    size = np.sqrt(np.maximum(values, precision * largest))[:, np.newaxis, :]
    root = deviation[:, :, np.newaxis] * vectors * size
    inverse = np.swapaxes(vectors / size, 1, 2) / deviation[:, np.newaxis, :]
    return root, inverse
