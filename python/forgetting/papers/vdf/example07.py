"""Example 7 and Table 5: a scalar parameter, with the regressor silent or constant."""

from __future__ import annotations

import numpy as np

import forgetting as fg

from ..claim import Finding, claim
from ..path import Path, follow

TRUTH, SILENT = 2.0, 20
LEVEL = 1.5
"""φ̄."""
FACTOR = 0.9


def silent(factor: float) -> Path:
    """φ_k = 1 for 20 samples, then 0."""
    phi = (np.arange(200) < SILENT).astype(float)[:, np.newaxis]
    rule = fg.rule("exponential", forgetting_factor=factor)
    return follow(rule, phi, TRUTH * phi[:, 0])


def constant(factor: float, samples: int = 2000) -> Path:
    """φ_k = φ̄."""
    phi = np.full((samples, 1), LEVEL)
    rule = fg.rule("exponential", forgetting_factor=factor)
    return follow(rule, phi, TRUTH * phi[:, 0])


def stands(path: Path) -> bool:
    """Whether θ stops at the last sample that informs, short of the truth."""
    after = path.theta[SILENT:, 0]
    return bool((after == after[0]).all() and abs(after[0] - TRUTH) > 1e-3)


@claim("VDF Table 5, not exciting, λ = 1", "θ̃_k → θ̄ and P_k → P̄, in k₀ steps")
def silent_without_forgetting() -> Finding:
    """P_0 = 1, θ_0 = 0."""
    path = silent(1.0)
    after = path.values[SILENT:, 0]
    measured = f"θ̃ = {path.theta[-1, 0] - TRUTH:.4f}, P = {after[-1]:.5f} from k = {SILENT} on"
    return measured, stands(path) and bool(np.ptp(after) == 0)


@claim("VDF Table 5, not exciting, λ < 1", "θ̃_k → θ̄ in k₀ steps, P_k diverges geometrically")
def silent_with_forgetting() -> Finding:
    """P grows by 1/λ a sample."""
    path = silent(FACTOR)
    ratio = path.values[SILENT + 1 :, 0] / path.values[SILENT:-1, 0]
    gap = float(np.abs(ratio * FACTOR - 1).max())
    measured = f"θ̃ = {path.theta[-1, 0] - TRUTH:.4f}; P grows by 1/λ a sample to {gap:.0e}"
    return measured, stands(path) and gap < 1e-12


@claim("VDF Table 5, exciting, λ = 1", "θ̃_k → 0, P_k → 0")
def constant_without_forgetting() -> Finding:
    """Both as 1/(1 + φ̄² k)."""
    path = constant(1.0)
    wanted = 1 / (1 + LEVEL**2 * 2000)
    error = abs(path.theta[-1, 0] - TRUTH)
    gap = max(abs(path.values[-1, 0] / wanted - 1), abs(error / (TRUTH * wanted) - 1))
    return f"P = {path.values[-1, 0]:.3g}, θ̃ = {error:.3g} at k = 2000", gap < 1e-9


@claim("VDF Table 5, exciting, λ < 1", "θ̃_k → 0 geometrically, P_k → (1 − λ)/φ̄²")
def constant_with_forgetting() -> Finding:
    """φ̄ = 1.5."""
    path = constant(FACTOR, 300)
    limit = path.values[-1, 0] * LEVEL**2 / (1 - FACTOR)
    error = np.abs(path.theta[100:200, 0] - TRUTH)
    rate = float((error[-1] / error[0]) ** (1 / 99))
    measured = f"P φ̄²/(1 − λ) = {limit:.12f}; θ̃ falls by {rate:.4f} a sample"
    return measured, abs(limit - 1) < 1e-9 and abs(rate - FACTOR) < 1e-3


@claim("VDF Example 7", "φ_k = φ̄ ≠ 0 is persistently exciting with N = 1, α = φ̄², β = 3φ̄²")
def constants() -> Finding:
    """F_{j,j+1} = 2 φ̄²."""
    from forgetting.analysis import excitation

    found = excitation(np.full((50, 1), LEVEL), window=2).tutorial
    inside = found.alpha >= LEVEL**2 and found.beta <= 3 * LEVEL**2
    return f"F_{{j,j+1}} = {found.alpha / LEVEL**2:g} φ̄²", inside
