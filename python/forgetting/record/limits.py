"""Estimates within bounds, while a record or a stream is run.

An estimate outside is moved inside by `forgetting.bounded`, in the metric of P⁻¹; the estimator
does not learn of it, so that nothing is lost when a bound was wrong, and its errors are its own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.origin import Origin

Array = NDArray[np.float64]


class Limits:
    """Bounds of parameters, and the estimates that were moved inside.

    Parameters
    ----------
    lower, upper : ndarray, shape (n,)
        Bounds of parameters of the samples as they are.
    here : Origin
        What the estimator measures from.
    """

    def __init__(self, lower: Array, upper: Array, here: Origin) -> None:
        self.lower, self.upper, self.here = lower, upper, here
        self._rows: list[NDArray[np.intp]] = []
        self._found: list[Array] = []

    def hold(self, theta: Array, covariance: Array, first: int) -> None:
        """Move estimates inside, in place, but for the constant, which `put` sees to.

        Parameters
        ----------
        theta : ndarray, shape (K, n, 1)
            Estimates measured from the origin.
        covariance : ndarray, shape (K, n, n)
            P after the same samples.
        first : int
            The row of the first of them.
        """
        here = self.here
        as_is = here.theta(theta.copy())[:, :, 0]
        out = np.flatnonzero(((as_is < self.lower) | (as_is > self.upper)).any(axis=1))
        if not len(out):
            return
        found = within(as_is[out], here.covariance(covariance[out]), self.lower, self.upper)
        moved = theta[out, :, 0]
        others = np.arange(theta.shape[1]) != here.constant
        moved[:, others] = found[:, others]
        theta[out, :, 0] = moved
        self._rows.append(first + out)
        self._found.append(found)

    def put(self, theta: Array) -> None:
        """Put what was found into the estimates (T, n, 1) of samples as they are."""
        for rows, found in zip(self._rows, self._found, strict=True):
            theta[rows, :, 0] = found


def within(theta: Array, covariance: Array, lower: Array, upper: Array) -> Array:
    """The nearest estimates (K, n) inside the bounds, in the metric of each P⁻¹, (K, n, n).

    Where P is not positive definite as it was rounded, every parameter by itself.

    Examples
    --------
    >>> correlated = np.array([[[1.0, 0.5], [0.5, 1.0]]])
    >>> within(np.array([[-0.2, 1.0]]), correlated, np.zeros(2), np.full(2, np.inf)).tolist()
    [[0.0, 1.1]]
    """
    covariance = covariance.astype(np.float64)
    try:
        return np.asarray(fg.bounded(theta, covariance, lower, upper))
    except fg.InvalidInput:
        if len(theta) == 1:
            return np.clip(theta, lower, upper)
    rows = zip(theta[:, None], covariance[:, None], strict=True)
    return np.concatenate([within(*row, lower, upper) for row in rows])
