"""Theorem 3, corrected: the ultimate bound under drift and noise."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

import forgetting as fg
from forgetting.analysis import UltimateBound, amplification, conditions, ultimate_bound

from ..claim import Finding, claim
from .every_rule import course, make
from .excursion import printed_bound_exceeded

SAMPLES, DRIFT, NOISE = 2000, 1e-3, 0.05


@lru_cache(maxsize=2)
def bounded(name: str) -> UltimateBound:
    """A drifting parameter and bounded noise."""
    rng = np.random.default_rng(8)
    phi, k = rng.uniform(-1, 1, (SAMPLES, 2)), np.arange(SAMPLES)
    theta = np.stack([np.cos(DRIFT * k), np.sin(DRIFT * k)], axis=1)
    noise = rng.uniform(-NOISE, NOISE, SAMPLES)
    found = course(make(name, forgetting_factor=0.9), phi, np.sum(phi * theta, axis=1) + noise)
    judged = conditions(found.trajectory, window=40, true_theta=theta, measurement_noise=noise)
    error = found.path.theta[1:] - theta
    return ultimate_bound(judged, error=error)


@claim(
    "GF-RLS Theorem 3, (27)–(29)",
    "the error is ultimately bounded by ε = ε*[δ_θ + b√β(√δ_φ θ_max + δ_y)]",
    verdict="corrected",
    reason="(28) lacks the lower bound of V: ε* carries √(b/a), not max{1, 1/√a}; and products of "
    "fewer than N factors need their own bound. Loose by orders of magnitude either way.",
)
def holds_on_a_run() -> Finding:
    """Exponential forgetting and subspace forgetting."""
    words, held = [], True
    for name in ("exponential", "subspace"):
        found = bounded(name)
        words.append(f"{name}: error ≤ {found.observed:.2g}, bound {found.bound:.1e}")
        held &= bool(np.isfinite(found.bound) and (found.observed or 0) < found.bound)
    return "; ".join(words), held


@claim(
    "GF-RLS Theorem 3, (28)",
    "ε* = max{1, 1/√a}(Δ + √(Δ + Δ²))N",
    verdict="corrected",
    reason="Scaling P and Γ together changes no estimate, but changes the printed ε*.",
)
def units() -> Finding:
    """P and Γ times 1/c: a, b over c, α and β times c."""
    constants = {"a": 0.1, "b": 1.0, "alpha": 1.0, "beta": 2.0}
    scaled = {"a": 1e-5, "b": 1e-4, "alpha": 1e4, "beta": 2e4}
    one, other = (amplification(**each, window=3) for each in (constants, scaled))
    measured = f"printed × {other.printed / one.printed:.3g}, corrected × "
    measured += f"{other.corrected / one.corrected:.12g} for c = 10⁴"
    same = abs(other.corrected / one.corrected - 1) < 1e-9
    return measured, same and abs(other.printed / one.printed - 1) > 0.1


@claim(
    "GF-RLS Theorem 3, (27) printed",
    "no run that satisfies A1–A8 exceeds ε",
    verdict="corrected",
    reason="One does: hold P at a₀I while the parameter drifts, let one direction of P grow to b, "
    "let strong excitation turn the error into it, start again.",
)
def exceeded() -> Finding:
    """n = p = 2, N = 1, no noise."""
    error, found = printed_bound_exceeded()
    measured = f"error {error:.3g}; printed {found.printed:.3g}, corrected {found.bound:.3g}"
    return measured, found.printed < error <= found.bound


@claim("GF-RLS section IV", "without drift and noise ε = 0")
def nothing_disturbs() -> Finding:
    """δ_θ = δ_y = δ_φ = 0."""
    constants = {"a": 0.1, "b": 1.0, "alpha": 1.0, "beta": 2.0, "window": 3}
    found = ultimate_bound(constants, parameter_drift=0.0, measurement_noise=0.0)
    return f"ε = {found.bound:g}", found.bound == 0


def rules_of_section_five() -> list[str]:
    """Registry names, for the map."""
    return [about["name"] for about in fg.rules()]
