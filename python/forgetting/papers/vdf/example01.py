"""Example 1: P_k converges to zero without persistent excitation."""

from __future__ import annotations

import numpy as np

import forgetting as fg
from forgetting.analysis import excitation

from ..claim import Finding, claim, largest_gap
from ..path import follow

SAMPLES = 100_000
K = np.arange(SAMPLES)
PHI = 1 / np.sqrt(K + 1.0)[:, np.newaxis]


@claim("VDF Example 1, (24)", "P_k⁻¹ = Σ 1/(i+1) + P₀⁻¹, so P_k → 0")
def harmonic_sum() -> Finding:
    """P_0 = 1."""
    path = follow(fg.rule("none"), PHI, np.zeros(SAMPLES), every=1000)
    harmonic = np.concatenate([[0.0], np.cumsum(1.0 / (K + 1))])[path.samples]
    gap = largest_gap(path.information[:, 0, 0], harmonic + 1)
    measured = f"equal to {gap:.1g}; P = {path.values[-1, 0]:.3g} at k = {SAMPLES}, still falling"
    return measured, gap < 1e-12 and bool((np.diff(path.values[:, 0]) < 0).all())


@claim("VDF Example 1", "F_{j,j+N} ≤ (N+1)/(j+1): not persistently exciting")
def not_exciting() -> Finding:
    """N = 10."""
    found = excitation(PHI, window=11).largest
    below = bool((found <= 11 / (K[: len(found)] + 1.0) * (1 + 1e-12)).all())
    return f"F_{{j,j+10}} falls from {found[0]:.3g} to {found[-1]:.2g}", below and found[-1] < 2e-4
