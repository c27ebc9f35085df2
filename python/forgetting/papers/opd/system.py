"""The time-varying two-output system of section VI, and the settings its text lost."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

NAMES = ("a₁", "a₂", "a₃", "b₁", "b₂", "b₃")
"""θ_1 ... θ_6."""


@dataclass(frozen=True)
class Settings:
    """What has to be chosen to run the experiment; the values that come nearest to Table I.

    The line of the paper that states them is lost but for θ̂₀ = [0.5 0.5 ... and "both set to 0.1".

    Attributes
    ----------
    samples : int
        N.
    noise : float
        Standard deviation of v, "covariance 0.01 I".
    inside : bool
        True for the model as printed, with v inside the recursion; False when the regressors hold
        noise-free outputs.
    information : float
        R_0 = information · I.
    smallest, sensitivity : float
        μ_L and η of (21).
    dead_zone : float
        ε of (18), and of (25) as `threshold`.
    """

    samples: int = 1000
    noise: float = 0.1
    inside: bool = False
    information: float = 0.1
    smallest: float = 0.5
    sensitivity: float = 0.1
    dead_zone: float = 0.1
    threshold: float = 0.04


FITTED = Settings()
"""A fit to Table I, not the authors' values."""
PRINTED_THRESHOLD = Settings(threshold=0.1)
"""The same with ε_th = 0.1, the value that the text seems to give."""


@lru_cache(maxsize=4)
def parameters(samples: int) -> Array:
    """True θ_k, k = 1 ... samples, (samples, 6)."""
    k, one = np.arange(1, samples + 1), np.ones(samples)
    first = -0.3 - 0.1 * np.sin(k * np.pi / 515)
    third = -0.2 - 0.1 * np.cos(k / 159)
    last = 0.43 - 0.1 * np.sin(k / 235)
    return np.stack([first, 0.8 * one, third, 0.23 * one, -0.67 * one, last], axis=1)


def inputs(samples: int) -> Array:
    """u_1 and u_2, (samples, 2)."""
    k = np.arange(1, samples + 1)
    first = 10 * np.sin(k * np.pi / 140) + 10 * np.cos(k * np.pi / 187)
    return np.stack([first, 10 * np.cos(k * np.pi / 123)], axis=1)


def simulate(settings: Settings, seed: int) -> tuple[Array, Array]:
    """Regressors Φ_kᵀ (N, 2, 6) and outputs (N, 2), from rest.

    The printed regressor holds y_2(k), which is the output itself; it must be y_2(k-1).
    """
    theta, u = parameters(settings.samples), inputs(settings.samples)
    rng = np.random.default_rng(seed)
    noise = settings.noise * rng.standard_normal((settings.samples, 2))
    phi, y, last = np.zeros((settings.samples, 2, 6)), np.empty((settings.samples, 2)), np.zeros(2)
    for k in range(settings.samples):
        phi[k, 0, :3] = last[0], *u[k]
        phi[k, 1, 3:] = *last, u[k, 1]
        clean = phi[k] @ theta[k]
        y[k] = clean + noise[k]
        last = y[k] if settings.inside else clean
    return phi, y
