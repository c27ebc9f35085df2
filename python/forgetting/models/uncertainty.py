"""How far outputs may be from what a model predicts: by its noise, and by its parameters.

The noise of the h-th output to come is e(k+h) + ψ_1 e(k+h-1) + ... + ψ_(h-1) e(k+1), with ψ the
impulse response of the model from its noise. What the parameters are off by is added by the delta
method: forecasts are linear in small changes of theta, whose covariance is σ² P.

P of a bank holds what members say that are hardly believed, and is left out: the mean square of its
errors has the uncertainty of the parameters in it, as far as it shows one step ahead.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting._core import Bank

Array = NDArray[np.float64]

STEP = 1e-3
"""Change of the parameters that a slope is taken by, in standard deviations."""


def root_of(estimator: Any) -> Array | None:
    """L (n, n) with L Lᵀ = P; None for a bank."""
    if isinstance(estimator, Bank):
        return None
    covariance = np.asarray(estimator.covariance, dtype=np.float64)
    size = np.sqrt(np.diagonal(covariance))  # so that no parameter is lost whose unit is small
    values, vectors = np.linalg.eigh(covariance / np.outer(size, size))
    return np.asarray(size[:, None] * vectors * np.sqrt(np.maximum(values, 0.0)))


def leverage(phi: Array, root: Array | None) -> Array:
    """φ P φᵀ of each row of phi, (T,); 0 for a bank."""
    return np.zeros(len(phi)) if root is None else np.square(phi @ root).sum(axis=1)


def of_parameters(forecast: Callable[[Array], Array], theta: Array, root: Array | None) -> Array:
    """Variance of forecasts (h, outputs) by parameters of covariance L Lᵀ, over σ² of each output.

    Parameters
    ----------
    forecast : callable
        From parameters (n, outputs) to forecasts (h, outputs).
    theta : ndarray, shape (n, outputs)
    root : ndarray, shape (n, n), or None
        L, the same for all outputs.

    Returns
    -------
    ndarray, shape (h, outputs, outputs)
        By the parameters of each output, the last axis.

    Examples
    --------
    >>> of_parameters(lambda theta: 3.0 * theta, np.array([[2.0]]), np.array([[0.5]])).round(6)
    array([[[2.25]]])
    """
    total = np.zeros((*np.shape(forecast(theta)), theta.shape[1]))
    for output in range(theta.shape[1]):
        for column in () if root is None else root.T:
            change = np.zeros_like(theta)
            change[:, output] = STEP * column
            slope = (forecast(theta + change) - forecast(theta - change)) / (2 * STEP)
            total[:, :, output] += np.square(slope)
    return total


def of_noise(feedback: Array, steps: int) -> Array:
    """Variance of outputs (h, outputs, outputs) by white noise of variance 1 in each, the last.

    Parameters
    ----------
    feedback : ndarray, shape (na, outputs, outputs)
        A_1, A_2, ... of y(k) = A_1 y(k-1) + ... + e(k).
    steps : int
        h.

    Examples
    --------
    >>> of_noise(np.array([[[0.5]]]), 3).ravel().tolist()
    [1.0, 1.25, 1.3125]
    """
    outputs = feedback.shape[1]
    response = np.zeros((steps, outputs, outputs))
    for k in range(steps):
        response[k] = np.eye(outputs) if k == 0 else 0.0
        for lag in range(1, min(k, len(feedback)) + 1):
            response[k] += feedback[lag - 1] @ response[k - lag]
    return np.asarray(np.cumsum(np.square(response), axis=0))
