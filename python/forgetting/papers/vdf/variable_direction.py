"""Propositions 8 to 10: variable-direction forgetting."""

from __future__ import annotations

import numpy as np

import forgetting as fg
from forgetting.analysis import excitation

from ..claim import Finding, claim, largest_gap
from ..path import follow
from .systems import Array
from .trial import inflated, trial

FACTOR, THRESHOLD = 0.9, 0.5


def stretch(information: Array, phi: Array, threshold: float) -> Array:
    """Λ_k of (67), (68)."""
    vectors = np.linalg.eigh(information)[1]
    rich = np.linalg.norm(phi @ vectors, axis=0) > threshold
    return np.asarray(vectors * np.where(rich, np.sqrt(FACTOR), 1.0) @ vectors.T)


@claim(
    "VDF Proposition 8, (70)",
    "(64) ⟺ P_{k+1} = P̄ − P̄φ(I + φᵀP̄φ)⁻¹φᵀP̄ with P̄ = Λ⁻¹PΛ⁻¹",
    verdict="corrected",
    reason="The transposes are misplaced: φ is p × n, so it must be P̄ − P̄φᵀ(I + φP̄φᵀ)⁻¹φP̄.",
)
def two_updates() -> Finding:
    """(64) and the corrected (70), at every sample of a record."""
    t = trial(0, FACTOR, "variable_direction", threshold=THRESHOLD)
    p, r, first, second = t.path.covariance, t.path.information, [], []
    for k in range(60):
        matrix = stretch(r[k], t.phi[k], THRESHOLD)
        first.append(matrix @ r[k] @ matrix + t.information[k])
        inverse = np.linalg.inv(matrix)
        second.append(inflated(inverse @ p[k] @ inverse, t.phi[k]))
    gaps = largest_gap(first, r[1:]), largest_gap(second, p[1:])
    return f"(64) to {gaps[0]:.0e}, corrected (70) to {gaps[1]:.0e}", max(gaps) < 1e-11


@claim(
    "VDF Proposition 9, (74)",
    "z_k → 0 with variable-direction forgetting, for every ε, whether or not φ is exciting",
    verdict="corrected",
    reason="φ must be bounded, as in Proposition 6.",
)
def error_vanishes() -> Finding:
    """Regressors along one direction; three thresholds."""
    phi = np.outer(np.sin(np.arange(4000)), [1.0, 2.0, -1.0])
    last = []
    for threshold in (1e-8, 0.1, 1.0):
        rule = fg.rule("variable_direction", forgetting_factor=FACTOR, threshold=threshold)
        error = follow(rule, phi, phi @ [1.0, 1.0, 1.0], every=4000).error
        last.append(float(np.abs(error[-100:]).max()))
    return f"|z| ≤ {max(last):.0e} after 4000 samples for ε = 1e-8, 0.1, 1", max(last) < 1e-6


@claim("VDF Proposition 10, (76)", "λᴺ(1 − λ)α/(1 − λᴺ⁺¹) I ≤ P_k⁻¹ under persistent excitation")
def lower_bound() -> Finding:
    """Random records, N = 3."""
    worst, last = np.inf, 3
    for seed in range(20):
        t = trial(seed, FACTOR, "variable_direction", threshold=THRESHOLD)
        alpha = excitation(t.phi, last + 1).alpha
        bound = FACTOR**last * (1 - FACTOR) * alpha / (1 - FACTOR ** (last + 1))
        worst = min(worst, float((1 / t.path.values[last + 1 :, 0]).min() / bound))
    return f"P_k⁻¹ ≥ {worst:.3g} times the bound over 20 records", worst >= 1
