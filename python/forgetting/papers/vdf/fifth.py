"""Runs on the 5th-order system (34) that several examples share."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

import forgetting as fg
from forgetting.analysis import excitation

from ..path import Path, follow
from .systems import Array, fifth_order

INFORMED = 6
"""Three harmonics excite six of the ten directions."""


@lru_cache(maxsize=8)
def run(rule: str, factor: float, samples: int, every: int, **parameters: Any) -> Path:
    """P_0 = I, θ_0 = 0."""
    phi, y, _ = fifth_order(samples)
    chosen = fg.rule(rule, forgetting_factor=factor, **parameters)
    return follow(chosen, phi, y, every=every)


def information_content(path: Path, phi: Array) -> Array:
    """|col_i(ψ_k)|, ψ_k = φ_k U_k (55), at the kept samples but the last, largest P first."""
    at = path.samples[:-1]
    return np.asarray(np.abs(np.einsum("ti,tij->tj", phi[at], path.vectors[:-1])))


def windows(samples: int) -> Array:
    """Singular values (m, 10) of F_{j,j+20} at every tenth j, largest first."""
    phi = fifth_order(samples)[0]
    starts = range(0, samples - 20, 10)
    return np.stack([np.linalg.svd(phi[j : j + 21], compute_uv=False) ** 2 for j in starts])


def growth(values: Array, samples: Array, begin: int, end: int) -> Array:
    """Factor per sample by which each eigenvalue grows between two kept samples."""
    i, j = int(np.searchsorted(samples, begin)), int(np.searchsorted(samples, end))
    steps = float(samples[j] - samples[i])
    return np.asarray((values[j] / values[i]) ** (1 / steps))


def rank(samples: int) -> int:
    """Directions excited by all windows of 21 samples once the transient is over."""
    phi = fifth_order(samples)[0][samples // 2 :]
    return int(excitation(phi, window=21, threshold=1e-10).rank.max())
