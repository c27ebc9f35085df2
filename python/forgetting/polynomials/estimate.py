"""A quantity and its standard error, by the delta method."""

from __future__ import annotations

from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from forgetting.polynomials.checks import real

Array = NDArray[np.float64]


class Estimate(NamedTuple):
    """What follows from the parameters, and how far it may be off.

    Attributes
    ----------
    value : ndarray or float
    standard_error : ndarray or float
        As large as the value; NaN where the covariance of the parameters is not known.

    Examples
    --------
    >>> low, high = Estimate(1.0, 0.1).interval(0.95)
    >>> round(low, 3), round(high, 3)
    (0.804, 1.196)
    """

    value: Array
    standard_error: Array

    def interval(self, level: float = 0.95) -> tuple[Array, Array]:
        """Both ends of the normal confidence interval; `level` is in (0, 1)."""
        half = quantile(level) * self.standard_error
        return self.value - half, self.value + half


def deviation(gradient: Array, covariance: Array) -> Array:
    """The standard deviation of something real, √(gᵀ C g).

    Parameters
    ----------
    gradient : ndarray, shape (n, ...)
        By parameter.
    covariance : ndarray, shape (n, n)
        Of the parameters.

    Examples
    --------
    >>> float(deviation(np.array([3.0, 4.0]), np.eye(2)))
    5.0
    """
    variance = np.einsum("i...,ij,j...->...", gradient, covariance, gradient)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))


def quantile(level: float) -> float:
    """Standard deviations to either side that hold this share of a normal distribution."""
    return NormalDist().inv_cdf(0.5 + real("level", level, 0.0, 1.0) / 2)
