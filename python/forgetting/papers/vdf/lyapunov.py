"""Theorems 6 and 7, in corrected form."""

from __future__ import annotations

import numpy as np

from forgetting.analysis import excitation

from ..claim import Finding, claim
from .trial import Trial, trial

FACTOR, LAST = 0.8, 3
"""λ and the tutorial's N."""


def decrease(t: Trial, k: int) -> float:
    """Largest eigenvalue of the change of V from k to k + 1, by (45)."""
    step = np.eye(3) - t.path.covariance[k + 1] @ t.information[k]
    change = step.T @ t.path.information[k + 1] @ step - t.path.information[k]
    return float(np.linalg.eigvalsh((change + change.T) / 2)[-1])


def constants(t: Trial) -> tuple[float, float]:
    """Lower and upper bound of P_k⁻¹ by (25)."""
    found, forgotten = excitation(t.phi, LAST + 1).tutorial, 1 - FACTOR ** (LAST + 1)
    lower = FACTOR**LAST * (1 - FACTOR) * found.alpha / forgotten
    return lower, found.beta / forgotten + 1 / float(t.path.values[LAST, -1])


@claim(
    "VDF Theorem 6, (44)",
    "V_{k+1} − V_k ≤ −γ₁‖x‖² with γ₁ = (1 − λ)(β/(1 − λᴺ⁺¹) + ‖P_N⁻¹‖)",
    verdict="corrected",
    reason="The upper bound of P⁻¹ cannot bound −(1 − λ)xᵀP⁻¹x from above; the lower bound does: "
    "γ₁ = (1 − λ) λᴺ(1 − λ)α/(1 − λᴺ⁺¹). The conclusion of the theorem stands.",
)
def lyapunov_decrease() -> Finding:
    """Over a record, for k >= N + 1."""
    t = trial(7, FACTOR)
    worst = max(decrease(t, k) for k in range(LAST + 1, 60))
    printed, corrected = (-(1 - FACTOR) * c for c in reversed(constants(t)))
    measured = f"largest {worst:.3g}; printed bound {printed:.3g}, corrected {corrected:.2g}"
    return measured, printed < worst <= corrected


@claim("VDF Theorem 6, λ = 1", "the zero solution of (12) is Lyapunov stable")
def stable_without_forgetting() -> Finding:
    """V never rises and bounds ‖θ̃‖ from above through P_0⁻¹."""
    t = trial(8, 1.0)
    worst = max(decrease(t, k) for k in range(60))
    v = np.einsum("ti,tij,tj->t", t.error, t.path.information, t.error)
    held = bool((np.sum(t.error**2, axis=1) <= v * np.linalg.eigvalsh(t.start)[-1]).all())
    return f"largest eigenvalue of the change of V: {worst:.0e}", held and worst < 1e-12


@claim(
    "VDF Theorem 7",
    "‖θ̃_k‖ ≤ α₀‖θ̃_{k₀}‖β₀^{−k}, β₀ = 1/λ",
    verdict="corrected",
    reason="The exponent must be −(k − k₀) (Definition 5 too): with k = k₀ large nothing but zero "
    "satisfies the printed form.",
)
def geometric() -> Finding:
    """Every pair k >= k_0 of the record, k >= N + 1."""
    t = trial(7, FACTOR)
    lower, upper = constants(t)
    norm = np.linalg.norm(t.error, axis=1)
    pairs = [(k, j) for j in range(0, 50) for k in range(max(LAST + 1, j), 60)]
    corrected = max(norm[k] / norm[j] / FACTOR ** (k - j) for k, j in pairs) * lower / upper
    printed = max(norm[k] / norm[j] / FACTOR**k for k, j in pairs) * lower / upper
    measured = f"error over bound: corrected ≤ {corrected:.2g}, printed ≤ {printed:.2g}"
    return measured, corrected <= 1 < printed


@claim("VDF Theorem 7, λ = 1", "the zero solution of (12) is globally asymptotically stable")
def asymptotic() -> Finding:
    """The error falls as 1/k."""
    t = trial(9, 1.0, samples=4000)
    norm = np.linalg.norm(t.error, axis=1)
    return f"‖θ̃‖ = {norm[400]:.1e} and {norm[4000]:.1e} at k = 400, 4000", bool(
        norm[4000] < 0.2 * norm[400] and norm[4000] < 1e-3
    )
