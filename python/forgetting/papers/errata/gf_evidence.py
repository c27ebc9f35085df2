"""Evidence for the errata of Lai and Bernstein, *Generalized forgetting recursive least squares*.

One function an erratum: it measures the printed form failing and the corrected one holding.
"""

from __future__ import annotations

import numpy as np

import forgetting as fg
from forgetting.analysis import lyapunov_decrease

from ..claim import Finding, largest_gap
from ..path import follow
from ..vdf.trial import trial
from .erratum import erratum, refused


@erratum(
    "GF-1",
    "(33), (37), (41)",
    "typo",
    "regulariser ‖θ − θ₀‖²",
    "‖θ̂ − θ₀‖²",
    "As printed the term does not depend on θ̂ and regularises nothing.",
)
def regulariser() -> Finding:
    """Least squares without the regulariser is not what RLS computes."""
    t = trial(41, 1.0, samples=5)
    left, right = t.information.sum(axis=0), np.einsum("tpi,tp->i", t.phi, t.y + 0.1)
    p = np.linalg.inv(t.start)
    run = follow(
        fg.rule("none"), t.phi, t.y + 0.1, initial_covariance=t.start, initial_theta=t.path.theta[0]
    )
    printed = largest_gap(np.linalg.solve(left, right), run.theta[-1])
    corrected = largest_gap(np.linalg.solve(left + p, right + p @ run.theta[0]), run.theta[-1])
    return f"minimiser off by {printed:.1e} as printed, {corrected:.0e} corrected", (
        printed > 1e-3 and corrected < 1e-12
    )


@erratum(
    "GF-5",
    "(73)",
    "error",
    "F_k is (1 − μ)(...) if φ_kP_kφ_kᵀ > 0, otherwise 0",
    "if φ_{k−1}P_{k−1}φ_{k−1}ᵀ > 0; F₀ = 0",
    "β_{k−1} in (71) depends on the sample before.",
)
def index() -> Finding:
    """A silent sample after an informative one still forgets what (71) says."""
    phi = np.array([[1.0, 0.5], [0.0, 0.0], [0.0, 0.0]])
    path = follow(fg.rule("restricted", forgetting_factor=0.9), phi, np.zeros(3))
    forgotten = path.information[:-1] + np.einsum("ti,tj->tij", phi, phi) - path.information[1:]
    wanted = 0.1 * (1 + 1 / float(phi[0] @ phi[0])) * np.outer(phi[0], phi[0])
    gap = largest_gap(forgotten[1], wanted)
    other = max(float(np.abs(forgotten[k]).max()) for k in (0, 2))
    return f"F₁ equals the corrected form to {gap:.0e} although φ₁ = 0; F₀, F₂ ≤ {other:.0e}", (
        gap < 1e-12 and other < 1e-12
    )


@erratum(
    "GF-6",
    "Lemma 7, (118), (122)",
    "typo",
    "Ψ_{k,N} is Np × Np; I_p − M_{k+N−2} ⋯ M_k",
    "Ψ_{k,N} is Np × n, its first block row φ̄_k; I_n − M_{k+N−2} ⋯ M_k",
    "With these the lemma holds.",
)
def seventh_lemma() -> Finding:
    """p = 2, n = 3, N = 3."""
    t, n, count = trial(42, 0.9), 3, 3
    p = t.path.covariance[1:]
    steps = [np.eye(n) - p[k] @ t.information[k] for k in range(count)]
    rows, product = [], np.eye(n)
    for k in range(count):
        rows.append(t.phi[k] @ product)
        product = steps[k] @ product
    weave = np.eye(2 * count)
    for i in range(count):
        for j in range(i):
            weave[2 * i : 2 * i + 2, 2 * j : 2 * j + 2] = t.phi[i] @ p[j] @ t.phi[j].T
    gap = largest_gap(weave @ np.vstack(rows), np.vstack(list(t.phi[:count])))
    misfit = refused(lambda: np.eye(2) - steps[1] @ steps[0])
    return (
        f"corrected to {gap:.0e}; I_p − MM cannot be formed for p = 2, n = 3",
        misfit and gap < 1e-12,
    )


@erratum(
    "GF-7a",
    "Theorem 5, (96)",
    "error",
    "ε ≥ max{μ, √(sup V)}",
    "ε ≥ max{√(β/α) μ, √(sup V/α)}",
    "The lower bound α of (94) is missing. V = x₁² + 0.01x₂².",
)
def ultimate_boundedness() -> Finding:
    """V falls outside the unit ball and sup V = 1 in it, yet ‖x‖ passes 4 again and again."""
    x, largest, falls, top = np.zeros(2), 0.0, True, 0.0
    for k in range(1200):
        kick = max(0.0, 1 - 2 * float(np.linalg.norm(x))) if k % 120 == 0 else 0.0
        after = np.array([kick, 4.3 * x[0] + 0.9 * x[1]])
        before, later = (float(v[0] ** 2 + 0.01 * v[1] ** 2) for v in (x, after))
        outside = float(np.linalg.norm(x)) > 1
        falls &= later < before or not outside
        top = top if outside else max(top, later)
        x, largest = after, max(largest, float(np.linalg.norm(after)) if k > 600 else 0.0)
    printed, corrected = max(1.0, top**0.5), max(10.0, (top / 0.01) ** 0.5)
    measured = (
        f"limit superior {largest:.2f}; printed bound {printed:.2f}, corrected {corrected:.0f}"
    )
    return measured, falls and printed < largest <= corrected


@erratum(
    "GF-8",
    "(155), (157)",
    "gap",
    "‖P_{k+i}^{−1/2}M_{k,i}‖² ≤ 1/a − c_i for i < N",
    "≤ 1/a for i < N, so that (158) becomes √(N/a − c_N)",
    "Lemma 8 holds for the N of persistent excitation, not for fewer factors. (158) itself is not "
    "known to fail.",
)
def shorter_products() -> Finding:
    """e₁ and e₂ in turn, λ = 0.9: N = 2, i = 1."""
    phi = np.tile(np.eye(2), (200, 1))
    path = follow(fg.rule("directional", forgetting_factor=0.9), phi, np.zeros(400))
    row, after = phi[-1], path.information[-1]
    step = np.eye(2) - np.linalg.solve(after, np.outer(row, row))
    found = float(np.linalg.eigvalsh(step.T @ after @ step)[-1])
    a, kept = 1 / float(np.linalg.eigvalsh(after)[-1]), after - np.outer(row, row)
    b = 1 / float(np.linalg.eigvalsh(kept)[0])
    limit = 1 / a - lyapunov_decrease(1.0, 1.0, b, 1)
    return f"{found:.3f}, printed limit {limit:.3f}, 1/a = {1 / a:.3f}", (
        limit < found - 0.5 and found <= 1 / a + 1e-9
    )


@erratum(
    "GF-9",
    "after (32), the sanity check",
    "error",
    "Δ_N > N b β̄/(a ᾱ) − 1 ≥ N − 1",
    "≥ b/a − 1 ≥ 0",
    "ᾱ ≤ Nβ̄, not ≤ β̄: the window sums N samples.",
)
def sanity_check() -> Finding:
    """φ = I, N = 3, λ = 0.5."""
    path = follow(
        fg.rule("exponential", forgetting_factor=0.5),
        np.tile(np.eye(2), (60, 1, 1)),
        np.zeros((60, 2)),
    )
    a = float(path.values[-1, -1])
    b, value = a / 0.5, 3 * (a / 0.5) * 1.0 / (a * 3.0) - 1
    measured = f"N b β/(a α) − 1 = {value:.3f}; printed floor 2, corrected {b / a - 1:.3f}"
    return measured, value < 2 and value >= b / a - 1 - 1e-9


@erratum(
    "GF-10",
    "(138)",
    "typo",
    "ε(1 + bβ̄)^{1/(N−1)}",
    "ε(1 + bβ̄)^{−(N−1)}",
    "The two powers of the next line must cancel.",
)
def exponent() -> Finding:
    """b β = 1, N = 4."""
    printed, corrected = 2.0**3 * 2.0 ** (1 / 3), 2.0**3 * 2.0**-3
    return f"the bound is {printed:.2f} ε as printed, {corrected:.0f} ε corrected", (
        printed > 1 and corrected == 1
    )


@erratum(
    "GF-13",
    "(159)",
    "typo",
    "𝓜ᵀP⁻¹𝓜̄ ⪯ √N(1/a − c_N) I_n",
    "σ_max(𝓜ᵀP⁻¹𝓜̄) ≤ √N(1/a − c_N)",
    "The product is n × Nn: an inequality between matrices means nothing.",
)
def not_square() -> Finding:
    """n = 2, N = 3."""
    misfit = refused(lambda: np.eye(2) @ np.zeros((2, 6)) - np.eye(2))
    return "2 × 6 against I₂", misfit


@erratum(
    "GF-14",
    "(58), (61)",
    "error",
    "for ‖φ‖ ≤ ε nothing is forgotten, and φᵀφ is added",
    "such a sample is left out altogether",
    "Sustained small regressors add up: R has no upper bound. The same holds for the thresholds of "
    "the other two papers.",
)
def dead_zone() -> Finding:
    """‖φ‖ = 0.05, ε = 0.1, 20 000 samples."""
    phi = 0.05 * np.eye(2)[np.arange(20_000) % 2]
    largest = {}
    for name in ("oblique_projection", "subspace"):
        rule = fg.rule(name, forgetting_factor=0.9, threshold=0.1)
        largest[name] = 1 / float(follow(rule, phi, np.zeros(20_000), every=20_000).values[-1, -1])
    added, left_out = largest.values()
    measured = f"λ_max(R): {added:.1f} and growing where they are added, {left_out:.1f} where not"
    return measured, added > 20 and left_out < 1.1
