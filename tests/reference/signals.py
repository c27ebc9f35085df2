"""Seeded test inputs: what excites, what falls silent, what is rank deficient.

A record is (phi, y, gamma): phi (T, p, n), y (T, p, targets), gamma (T, p, p) or None for I.
The parameters drift slowly and jump once, at a third of the record; the noise has standard
deviation 0.1.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

DRIFT = 0.01
NOISE = 0.1
NEARLY = 1e-3  # distance of the nearly collinear columns, relative to their length


class Record(NamedTuple):
    kind: str
    phi: np.ndarray
    y: np.ndarray
    gamma: np.ndarray | None


def _exciting(rng: np.random.Generator, samples: int, p: int, n: int) -> np.ndarray:
    return rng.standard_normal((samples, p, n))


def _silent(rng: np.random.Generator, samples: int, p: int, n: int) -> np.ndarray:
    """Half exciting, then zeros."""
    phi = _exciting(rng, samples, p, n)
    phi[samples // 2 :] = 0.0
    return phi


def _fixed(rng: np.random.Generator, samples: int, p: int, n: int) -> np.ndarray:
    """Half exciting, then one constant regressor in every row."""
    phi = _exciting(rng, samples, p, n)
    phi[samples // 2 :] = rng.standard_normal(n)
    return phi


def _deficient(rng: np.random.Generator, samples: int, p: int, n: int) -> np.ndarray:
    """Rows that are exact multiples of the first (the last one zero every third sample)."""
    phi = _exciting(rng, samples, p, n)
    for row in range(1, p):
        phi[:, row] = (-2.0) ** row * phi[:, 0]
    phi[::3, -1] = 0.0
    return phi


def _collinear(rng: np.random.Generator, samples: int, p: int, n: int) -> np.ndarray:
    """Second column nearly equal to the first."""
    phi = _exciting(rng, samples, p, n)
    if n > 1:
        phi[:, :, 1] = phi[:, :, 0] + NEARLY * phi[:, :, 1]
    return phi


KINDS: dict[str, Callable[[np.random.Generator, int, int, int], np.ndarray]] = {
    "exciting": _exciting,
    "silent": _silent,
    "fixed": _fixed,
    "deficient": _deficient,
    "collinear": _collinear,
}


def record(
    kind: str, samples: int, p: int, n: int, targets: int = 1, weighted: bool = False, seed: int = 0
) -> Record:
    """A seeded record; ``weighted`` gives every sample its own full Gamma."""
    rng = np.random.default_rng([seed, samples, p, n, targets, sorted(KINDS).index(kind)])
    phi = KINDS[kind](rng, samples, p, n)
    drift = DRIFT * rng.standard_normal((samples, n, targets))
    drift[samples // 3] += rng.standard_normal((n, targets))
    theta = rng.standard_normal((n, targets)) + np.cumsum(drift, axis=0)
    y = phi @ theta + NOISE * rng.standard_normal((samples, p, targets))
    gamma = None
    if weighted:
        root = 0.3 * rng.standard_normal((samples, p, p))
        gamma = 0.5 * np.eye(p) + root @ root.transpose(0, 2, 1)
    return Record(kind, phi, y, gamma)
