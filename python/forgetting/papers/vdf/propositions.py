"""Propositions 1 to 7 and Lemma 1, on random records; in corrected form where they need one."""

from __future__ import annotations

import numpy as np

import forgetting as fg
from forgetting.analysis import excitation

from ..claim import Finding, claim, largest_gap
from ..path import follow
from .systems import three_sinusoids, two_lags
from .trial import inflated, trial

FACTOR = 0.9
TRIALS = 20


@claim("VDF Proposition 1", "(4) ⟺ (8): P_{k+1}⁻¹ = λP_k⁻¹ + φᵀφ")
def two_updates() -> Finding:
    """Both, at every sample of a record."""
    t = trial(0, FACTOR)
    p, r = t.path.covariance, t.path.information
    four = largest_gap([inflated(p[k], t.phi[k], FACTOR) for k in range(60)], p[1:])
    eight = largest_gap(FACTOR * r[:-1] + t.information, r[1:])
    return f"(4) to {four:.0e}, (8) to {eight:.0e}", max(four, eight) < 1e-11


@claim("VDF Proposition 2, (15)", "θ_{k+1} solves the weighted normal equations")
def normal_equations() -> Finding:
    """Summed over all the data."""
    t = trial(1, FACTOR)
    weight = FACTOR ** np.arange(59, -1, -1)
    prior = FACTOR**60 * np.linalg.inv(t.start)
    left = np.einsum("t,tij->ij", weight, t.information) + prior
    right = np.einsum("t,tpi,tp->i", weight, t.phi, t.y) + prior @ t.path.theta[0]
    gap = largest_gap(np.linalg.solve(left, right), t.path.theta[-1])
    return f"to {gap:.0e}", gap < 1e-11


@claim(
    "VDF Proposition 2, (16)",
    "θ_{k+1} ∈ range of Φᵀ, R⁻¹Φᵀ and θ₀",
    verdict="corrected",
    reason="True; the proof's W_k and inverse are misprinted, and more is true: θ_{k+1} − θ₀ lies "
    "in the range of R⁻¹Φᵀ alone.",
)
def subspace() -> Finding:
    """Two samples of one row in six dimensions."""
    t = trial(2, FACTOR, samples=2, rows=1, n=6)
    basis = t.start @ t.phi[:, 0].T
    moved = t.path.theta[-1] - t.path.theta[0]
    off = moved - basis @ np.linalg.lstsq(basis, moved, rcond=None)[0]
    outside = float(np.linalg.norm(off) / np.linalg.norm(moved))
    return f"{outside:.0e} of θ − θ₀ lies outside a plane in six dimensions", outside < 1e-12


@claim(
    "VDF Lemma 1, (20)",
    "λ = 1: P_k⁻¹ = F_{0,k} + P₀⁻¹",
    verdict="corrected",
    reason="Off by one: P_k has seen φ_0 ... φ_{k-1}, so P_k⁻¹ = F_{0,k-1} + P₀⁻¹.",
)
def information_so_far() -> Finding:
    """After 60 samples; as printed, one sample more is needed."""
    t = trial(3, 1.0)
    total = t.information.sum(axis=0) + np.linalg.inv(t.start)
    corrected = largest_gap(total, t.path.information[60])
    printed = largest_gap(total, t.path.information[59])
    return f"corrected to {corrected:.0e}, printed off by {printed:.2f}", (
        corrected < 1e-12 and printed > 1e-3
    )


@claim("VDF Proposition 3, (21)", "λ = 1: ⌊k/(N+1)⌋ α I + P₀⁻¹ ≤ P_k⁻¹ ≤ ⌈k/(N+1)⌉ β I + P₀⁻¹")
def bounds_without_forgetting() -> Finding:
    """The input of Example 2, P_0 = I, N = 10; P_k → 0 follows (22)."""
    phi = two_lags(three_sinusoids(3000))
    path, found = follow(fg.rule("none"), phi, np.zeros(3000)), excitation(phi, 11).tutorial
    k = path.samples[11:]
    low = path.values[11:, 0] ** -1 - (k // 11 * found.alpha + 1)
    high = (-(-k // 11) * found.beta + 1) - path.values[11:, -1] ** -1
    measured = f"margins ≥ {low.min():.3g} and {high.min():.3g}; P ≤ {path.values[-1, 0]:.1g}"
    return measured, bool(low.min() >= 0 and high.min() >= 0 and path.values[-1, 0] < 0.02)


@claim("VDF Proposition 4, (25)", "λ < 1 and persistent excitation: P_k⁻¹ lies between the bounds")
def bounds_with_forgetting() -> Finding:
    """Random records; N = 3."""
    worst = np.inf
    for seed in range(TRIALS):
        t = trial(seed, FACTOR)
        found, last = excitation(t.phi, 4).tutorial, 3
        forgotten = 1 - FACTOR ** (last + 1)
        values = 1 / t.path.values[last + 1 :]
        low = FACTOR**last * (1 - FACTOR) * found.alpha / forgotten
        high = found.beta / forgotten + 1 / t.path.values[last, -1]
        worst = min(worst, float((values / low).min()), float((high / values).min()))
    return f"closest, as a ratio, over {TRIALS} records: {worst:.3g}", worst >= 1


@claim(
    "VDF Proposition 5, (26)",
    "ᾱ I ≤ P_k⁻¹ ≤ β̄ I implies persistent excitation with N ≥ (λβ̄ − ᾱ)/((1 − λ)ᾱ)",
    verdict="corrected",
    reason="N must be greater: with equality the lower bound is zero.",
)
def converse() -> Finding:
    """λ = 0.5, so that N is short; from sample 20 on, where P_0 is forgotten."""
    factor, worst = 0.5, np.inf
    for seed in range(TRIALS):
        t = trial(seed, factor, samples=400, rows=6)
        low, high = 1 / t.path.values[20:].max(), 1 / t.path.values[20:].min()
        needed = (factor * high - low) / ((1 - factor) * low)
        last = int(needed) + 1
        found = excitation(t.phi[20:], last + 1).tutorial
        above = found.alpha - ((1 + (1 - factor) * last) * low - factor * high)
        below = (1 - factor ** (last + 1)) / (factor**last * (1 - factor)) * high - found.beta
        worst = min(worst, above, below)
    at_equality = (1 + (1 - factor) * needed) * low - factor * high
    measured = f"margins ≥ {worst:.3g}; at equality the bound is {abs(at_equality):.0e}"
    return measured, worst >= 0 and abs(at_equality) < 1e-9 * high


@claim(
    "VDF Proposition 6, (28)",
    "z_k → 0 whether or not φ is persistently exciting",
    verdict="corrected",
    reason="φ must be bounded: with φ_k = 1.5^(2^k), λ = 1, z_k does not vanish.",
)
def error_vanishes() -> Finding:
    """Bounded: along one direction only. Unbounded: one parameter."""
    phi = np.outer(np.sin(np.arange(4000)), [1.0, 2.0, -1.0])
    rule = fg.rule("exponential", forgetting_factor=0.99)
    bounded = np.abs(follow(rule, phi, phi @ [1.0, 1.0, 1.0], every=4000).error[-100:]).max()
    grows = 1.5 ** (2.0 ** np.arange(7))[:, np.newaxis]
    # The truth is 0, so that θ is its own error to the last digit.
    unbounded = np.abs(follow(fg.rule("none"), grows, np.zeros(7), initial_theta=[1.0]).error)
    measured = f"|z| = {bounded:.0e}; with unbounded φ it tends to {unbounded[-1]:.4f}"
    return measured, bool(bounded < 1e-9 and abs(unbounded[-1] - 1) < 0.01)


@claim("VDF Proposition 7", "the eigenvalues of P_{k+1}φᵀφ lie in [0, 1] and A_k → 0 (48)")
def products() -> Finding:
    """λ = 0.9 and λ = 1."""
    words, inside = [], True
    for factor in (FACTOR, 1.0):
        t = trial(5, factor, samples=200)
        values = np.linalg.eigvals(t.path.covariance[1:] @ t.information).real
        product = np.eye(3)
        for p, information in zip(t.path.covariance[1:], t.information, strict=True):
            product = (np.eye(3) - p @ information) @ product
        words.append(
            f"{values.min():.0e} to {values.max():.4f}, ‖A₂₀₀‖ = {np.linalg.norm(product):.0e}"
        )
        inside &= bool(values.min() > -1e-12 and values.max() < 1 + 1e-12)
        inside &= bool(np.linalg.norm(product) < 0.01)
    return "; ".join(words), inside
