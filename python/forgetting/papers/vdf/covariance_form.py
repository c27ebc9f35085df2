"""The covariance form (4), (5) as printed: the object of Example 9, not an estimator to use.

Subtracting from a dense P loses its smallest eigenvalues to rounding, and then its sign. It is
written out here, and only here, because that loss is what the example claims.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .systems import Array, fifth_order


@lru_cache(maxsize=2)
def covariance_form(factor: float, samples: int, every: int) -> tuple[Array, Array, Array]:
    """θ_k and z_k, k = 0 ... samples, and the smallest and largest eigenvalue of P every so often.

    The loop stops, and the rest stays NaN, when a number overflows.
    """
    phi, y, _ = fifth_order(samples)
    n = phi.shape[1]
    p, theta, thetas, errors = np.eye(n), np.zeros(n), [], []
    extremes = np.full((samples // every, 2), np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        for k, (row, value) in enumerate(zip(phi, y, strict=True)):
            thetas.append(theta)
            errors.append(row @ theta - value)
            gain = p @ row
            p = (p - np.outer(gain, gain) / (factor + row @ gain)) / factor  # (4)
            theta = theta + p @ row * (value - row @ theta)  # (5)
            if not np.isfinite(theta).all() or not np.isfinite(p).all():
                break
            if k % every == every - 1:
                extremes[k // every] = np.linalg.eigvalsh((p + p.T) / 2)[[0, -1]]
    padding = np.full((samples - len(thetas), n), np.nan)
    return np.vstack([*thetas, padding]), np.array([*errors, *padding[:, 0]]), extremes
