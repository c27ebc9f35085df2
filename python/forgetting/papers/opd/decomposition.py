"""Theorems 1 and 2 and section IV: what each algorithm forgets, and what it keeps."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

import forgetting as fg

from ..claim import Finding, claim
from ..path import follow
from .system import Array

FACTOR, SAMPLES = 0.9, 40


def forgotten(name: str, **parameters: float) -> tuple[Array, Array, Array]:
    """Φᵀ, R_{k-1} and its forgotten part of every sample of a random record (p = 2, n = 5).

    The forgotten part is (R_{k-1} - R_k + ΦΦᵀ)/(1 - μ), from the estimator's own R.
    """
    rng = np.random.default_rng(4)
    phi, root = rng.standard_normal((SAMPLES, 2, 5)), rng.standard_normal((5, 5))
    phi[::3, 1] = phi[::3, 0]  # every third regressor has rank one
    rule = fg.rule(name, forgetting_factor=FACTOR, **parameters)
    path = follow(rule, phi, np.zeros((SAMPLES, 2)), initial_covariance=root @ root.T + np.eye(5))
    r = path.information
    part = (r[:-1] - r[1:] + np.einsum("tpi,tpj->tij", phi, phi)) / (1 - FACTOR)
    return phi, r[:-1], part


def ranks(matrices: Array) -> Array:
    """Numerical rank of each matrix."""
    return np.asarray(np.linalg.matrix_rank(matrices, tol=1e-9 * float(np.abs(matrices).max())))


@claim("VDF-OPD Theorem 1", "R⁽¹⁾ and R⁽²⁾ of (17) are positive semidefinite")
def positive_parts() -> Finding:
    """At every sample."""
    _, r, part = forgotten("oblique_projection", threshold=0.0)
    least = min(float(np.linalg.eigvalsh(each)[:, 0].min()) for each in (part, r - part))
    return f"smallest eigenvalue {least:.0e}", least > -1e-10


@claim("VDF-OPD Theorem 2, (30)", "rank Φ = rank R⁽²⁾ ≤ rank M⁽²⁾")
def forgotten_ranks() -> Finding:
    """Regressors of rank one and two."""
    phi, _, oblique = forgotten("oblique_projection", threshold=0.0)
    _, _, eigen = forgotten("variable_direction", threshold=1e-12)
    found = [ranks(each) for each in (phi, oblique, eigen)]
    measured = "mean ranks " + ", ".join(f"{each.mean():.2f}" for each in found)
    return measured, bool((found[0] == found[1]).all() and (found[1] <= found[2]).all())


@claim("VDF-OPD Theorem 2, (31)", "Null Φᵀ = range R⁽¹⁾ ⊇ range M⁽¹⁾")
def kept_ranges() -> Finding:
    """ΦᵀR⁽¹⁾ = 0 with rank R⁽¹⁾ = n − rank Φ; ΦᵀM⁽¹⁾ = 0."""
    phi, r, oblique = forgotten("oblique_projection", threshold=0.0)
    _, s, eigen = forgotten("variable_direction", threshold=1e-12)
    off = [float(np.abs(phi @ kept).max()) for kept in (r - oblique, s - eigen)]
    whole = bool((ranks(r - oblique) == 5 - ranks(phi)).all())
    return f"|ΦᵀR⁽¹⁾| ≤ {off[0]:.0e}, |ΦᵀM⁽¹⁾| ≤ {off[1]:.0e}", whole and max(off) < 1e-9


@claim("VDF-OPD section III", "for a scalar output it reduces to the algorithm of [21]")
def scalar_output() -> Finding:
    """`oblique_projection` and `directional` on one row."""
    rng = np.random.default_rng(5)
    phi, y = rng.standard_normal((200, 4)), rng.standard_normal(200)
    paths = [
        follow(fg.rule(name, forgetting_factor=FACTOR, threshold=1e-6), phi, y)
        for name in ("oblique_projection", "directional")
    ]
    gap = float(np.abs(paths[0].theta - paths[1].theta).max())
    return f"estimates differ by {gap:.0e}", gap < 1e-12


def across(spread: float, threshold: float, samples: int) -> Array:
    """Information along ω = [-1 1 0] in the example of section IV, k = 0 ... samples.

    R_0 = diag(1, 1 + spread, 1 + 2 spread): distinct, so that its eigenvectors are U_0 = I.
    """
    start = 1 / np.array([1.0, 1 + spread, 1 + 2 * spread])
    phi = np.tile([1.0, 1.0, 0.0], (samples, 1))
    rule = fg.rule("variable_direction", forgetting_factor=FACTOR, threshold=threshold)
    path = follow(rule, phi, phi @ np.ones(3), initial_covariance=start)
    omega = np.array([-1.0, 1.0, 0.0]) / np.sqrt(2)
    return np.asarray(np.einsum("i,tij,j->t", omega, path.information, omega))


@claim(
    "VDF-OPD section IV",
    "with U₀ = I, VDF-ED discounts the unexcited direction ω until eigenvalues reach ε_th",
    verdict="corrected",
    reason="The threshold is on ‖Φᵀu_i‖, not on eigenvalues. ω is an eigenvector from the second "
    "sample on and is discounted exactly once.",
)
def discounted_once() -> Finding:
    """ε_th = 1e-3, 200 samples."""
    found = across(1e-6, 1e-3, 200)
    measured = f"ωᵀRω: {found[0]:.4f}, {found[1]:.4f} after one sample, {found[-1]:.4f} after 200"
    return measured, bool(abs(found[1] - FACTOR) < 1e-5 and abs(found[-1] - found[1]) < 1e-5)


@claim(
    "VDF-OPD section IV",
    "part of the forgotten subspace of VDF-ED discounts information without receiving any",
    reason="With a generic R₀ = diag(1, 2, 3) what is left is of the order of ε_th.",
)
def generic_start() -> Finding:
    """The end value falls with the threshold."""
    found = [float(across(1.0, threshold, 400)[-1]) for threshold in (1e-2, 1e-4, 1e-6)]
    words = ", ".join(f"{value:.2g}" for value in found)
    ratios = [a / b for a, b in pairwise(found)]
    measured = f"ωᵀRω → {words} for ε_th = 1e-2, 1e-4, 1e-6 (VDF-OPD keeps it)"
    return measured, all(20 < ratio < 500 for ratio in ratios) and found[0] < 1
