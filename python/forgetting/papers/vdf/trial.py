"""Random records for the propositions, which hold for every record."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

import forgetting as fg

from ..path import Path, follow
from .systems import Array


@dataclass(frozen=True, eq=False)
class Trial:
    """A record of y = φθ, its start, and the path through it.

    Attributes
    ----------
    phi : (T, p, n)
    y : (T, p)
    theta : (n,)
    start : (n, n)
        P_0.
    factor : float
    path : Path
    """

    phi: Array
    y: Array
    theta: Array
    start: Array
    factor: float
    path: Path

    @property
    def information(self) -> Array:
        """φ_kᵀφ_k, (T, n, n)."""
        return np.asarray(np.einsum("tpi,tpj->tij", self.phi, self.phi))

    @property
    def error(self) -> Array:
        """θ̃_k, (T + 1, n)."""
        return np.asarray(self.path.theta - self.theta)


@lru_cache(maxsize=64)
def trial(
    seed: int,
    factor: float,
    rule: str = "exponential",
    samples: int = 60,
    rows: int = 2,
    n: int = 3,
    **parameters: Any,
) -> Trial:
    """White regressors, a random P_0 and θ_0."""
    rng = np.random.default_rng(seed)
    phi = rng.standard_normal((samples, rows, n))
    theta, root = rng.standard_normal(n), rng.standard_normal((n, n))
    start = root @ root.T + np.eye(n)
    y = phi @ theta
    chosen = fg.rule(rule, forgetting_factor=factor, **parameters)
    one = rows == 1
    path = follow(
        chosen,
        phi[:, 0] if one else phi,
        y[:, 0] if one else y,
        initial_covariance=start,
        initial_theta=rng.standard_normal(n),
    )
    return Trial(phi, y, theta, start, factor, path)


def inflated(covariance: Array, phi: Array, factor: float = 1.0) -> Array:
    """P/λ - P/λ φᵀ(λI + φPφᵀ)⁻¹φP, the right-hand side of (4)."""
    gain = covariance @ phi.T
    inverse = np.linalg.inv(factor * np.eye(len(phi)) + phi @ gain)
    return np.asarray((covariance - gain @ inverse @ gain.T) / factor)
