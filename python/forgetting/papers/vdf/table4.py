"""Table 4: P_k with and without persistent excitation, with and without forgetting."""

from __future__ import annotations

import numpy as np

import forgetting as fg

from ..claim import Finding, claim
from ..path import Path, follow
from .systems import three_sinusoids, two_lags

SAMPLES = 3000
FACTOR = 0.99


def path(factor: float, excited: bool) -> Path:
    """The input of Example 2, or u = 1 from sample 100 on."""
    wave = three_sinusoids(SAMPLES)
    u = wave if excited else np.where(np.arange(SAMPLES) < 100, wave, 1.0)
    rule = fg.rule("exponential", forgetting_factor=factor)
    return follow(rule, two_lags(u), np.zeros(SAMPLES), every=10)


@claim("VDF Table 4, persistent, λ = 1", "P_k converges to zero")
def persistent_without_forgetting() -> Finding:
    """Every singular value, as 1/k."""
    largest = path(1.0, True).values[:, 0]
    measured = f"largest singular value {largest[30]:.2g} and {largest[-1]:.2g} at k = 300, 3000"
    return measured, bool(largest[-1] < 0.15 * largest[30])


@claim("VDF Table 4, persistent, λ < 1", "P_k is bounded")
def persistent_with_forgetting() -> Finding:
    """And bounded below too."""
    values = path(FACTOR, True).values[30:]
    measured = f"{values.min():.2g} ≤ P ≤ {values.max():.2g} after k = 300"
    return measured, bool(values.max() < 1 and values.min() > 1e-3)


@claim("VDF Table 4, not persistent, λ = 1", "all singular values bounded, some converge to zero")
def silent_without_forgetting() -> Finding:
    """One of two."""
    first, last = path(1.0, False).values[30], path(1.0, False).values[-1]
    measured = f"k = 300 to 3000: × {last[0] / first[0]:.6f} and × {last[1] / first[1]:.3f}"
    return measured, bool(abs(last[0] / first[0] - 1) < 1e-2 and last[1] < 0.3 * first[1])


@claim("VDF Table 4, not persistent, λ < 1", "some singular values diverge, the others are bounded")
def silent_with_forgetting() -> Finding:
    """One of two, by 1/λ a sample."""
    found = path(FACTOR, False)
    growth = float((found.values[150, 0] / found.values[100, 0]) ** (1 / 500))
    rest = found.values[30:, 1]
    measured = f"one grows by {growth:.6f} a sample (1/λ = {1 / FACTOR:.6f}); "
    measured += f"the other stays below {rest.max():.2g}"
    return measured, abs(growth * FACTOR - 1) < 1e-6 and bool(rest.max() < 1)
