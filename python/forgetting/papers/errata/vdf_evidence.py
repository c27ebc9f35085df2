"""Evidence for the errata of Goel, Bruce and Bernstein, *Recursive least squares with
variable-direction forgetting*.

One function an erratum: it measures the printed form failing and the corrected one holding.
"""

from __future__ import annotations

import numpy as np

import forgetting as fg
from forgetting.analysis import excitation

from ..claim import Finding, largest_gap
from ..path import follow
from ..vdf import variable_direction
from ..vdf.trial import inflated, trial
from .erratum import claimed, erratum, refused


@erratum(
    "V-2",
    "after Definition 1",
    "error",
    "if N is replaced by 2N, (19) holds with 2α and 2β",
    "by 2N + 1",
    "F_{j,j+N} sums N + 1 samples; twice as many are 2N + 2.",
)
def twice_the_window() -> Finding:
    """φ = 0, 1, 0, 1, ..., N = 1."""
    phi = (np.arange(100) % 2).astype(float)[:, np.newaxis]
    found = [excitation(phi, window).alpha for window in (2, 3, 4)]
    return f"α = {found[0]:g} for N = 1, {found[1]:g} for 2N, {found[2]:g} for 2N + 1", (
        found == [1.0, 1.0, 2.0]
    )


@erratum(
    "V-3a",
    "(32)",
    "error",
    "κ(P_k) ≤ β/α for λ = 1",
    "κ(P_k) ≤ (⌈k/(N+1)⌉β + ‖P₀⁻¹‖)/(⌊k/(N+1)⌋α + σ_min(P₀⁻¹)); β/α in the limit",
    "P₀ and the rounding of k/(N + 1) are left out.",
)
def condition_number() -> Finding:
    """φ = I, so α = β and N = 0; P_0⁻¹ = diag(1000, 0.1)."""
    start = 1 / np.array([1000.0, 0.1])
    path = follow(
        fg.rule("none"), np.tile(np.eye(2), (5, 1, 1)), np.zeros((5, 2)), initial_covariance=start
    )
    found, corrected = float(path.condition[2]), (2 + 1000) / (2 + 0.1)
    measured = f"κ = {found:.0f} at k = 2; printed bound 1, corrected {corrected:.0f}"
    return measured, found > 100 and found <= corrected * (1 + 1e-9)


@erratum(
    "V-3b",
    "before Example 5",
    "error",
    "a bounded condition number implies that φ is persistently exciting",
    "a diverging one implies that it is not; a bounded one implies nothing",
)
def bounded_condition() -> Finding:
    """φ = 0, λ = 0.9."""
    rule = fg.rule("exponential", forgetting_factor=0.9)
    path = follow(rule, np.zeros((100, 2)), np.zeros(100), initial_covariance=[1.0, 2.0])
    return f"κ = {path.condition[-1]:.6g} all along, ‖P‖ = {path.values[-1, 0]:.3g} at k = 100", (
        bool(abs(path.condition[-1] - 2) < 1e-9 and path.values[-1, 0] > 1e4)
    )


@erratum(
    "V-9",
    "(70), (S10), proofs of Propositions 8 and 9",
    "typo",
    "P̄_k − P̄_kφ_k(I + φ_kᵀP̄_kφ_k)⁻¹φ_kᵀP̄_k",
    "P̄_k − P̄_kφ_kᵀ(I + φ_kP̄_kφ_kᵀ)⁻¹φ_kP̄_k",
    "φ_k is p × n throughout.",
)
def transposes() -> Finding:
    """p = 2, n = 3."""
    t = trial(51, 0.9, "variable_direction", threshold=0.5)
    p, phi = t.path.covariance[0], t.phi[0]
    misfit = refused(lambda: p @ phi @ np.linalg.inv(np.eye(2) + phi.T @ p @ phi) @ phi.T @ p)
    words, holds = claimed(variable_direction.two_updates)()
    return f"the printed product of 3 × 3 and 2 × 3 does not exist; {words}", misfit and holds


@erratum(
    "V-10",
    "proof of Proposition 10",
    "typo",
    "U Λ̄ΣΛ̄ Uᵀ = Λ_kP_{k+1}⁻¹Λ_k",
    "= Λ_kP_k⁻¹Λ_k",
    "Likewise Examples 11 and 12 say that P_k⁻¹ is given by (70), which gives P_{k+1}.",
)
def index_in_the_proof() -> Finding:
    """One step."""
    t = trial(52, 0.9, "variable_direction", threshold=0.5)
    r = t.path.information
    matrix = variable_direction.stretch(r[5], t.phi[5], 0.5)
    wanted = r[6] - t.information[5]
    corrected, printed = (largest_gap(matrix @ each @ matrix, wanted) for each in (r[5], r[6]))
    return (
        f"printed off by {printed:.2f}, corrected {corrected:.0e}",
        printed > 0.01 > 1e-9 > corrected,
    )


@erratum(
    "V-11a",
    "proof of Proposition 2",
    "error",
    "θ_{k+1} = (I + Φ_kᵀW_kΦ_k)⁻¹(...), W_k = diag(λ⁻¹I, ..., λ⁻ᵏI)",
    "(I + R⁻¹Φ_kᵀW_kΦ_k)⁻¹(...), W_k = diag(λ⁻¹I, ..., λ^{−(k+1)}I)",
    "R⁻¹ is lost, and W_k has a block too few. The conclusion (16) stands.",
)
def weights() -> Finding:
    """Ten samples, a start P_0 = R⁻¹ that is not I."""
    t, count = trial(53, 0.9, samples=10), 10
    weight = 0.9 ** -(np.arange(count) + 1.0)
    seen = np.einsum("t,tij->ij", weight, t.information)
    right = t.start @ np.einsum("t,tpi,tp->i", weight, t.phi, t.y) + t.path.theta[0]
    gaps = [
        largest_gap(np.linalg.solve(np.eye(3) + part, right), t.path.theta[-1])
        for part in (seen, t.start @ seen)
    ]
    return f"printed off by {gaps[0]:.2f}, corrected {gaps[1]:.0e}", gaps[0] > 0.01 > 1e-9 > gaps[1]


@erratum(
    "V-11b",
    "proofs of Proposition 2 and Theorem S1",
    "typo",
    "J = θ̂ᵀAθ̂ + θ̂ᵀb + c",
    "J = θ̂ᵀAθ̂ + 2θ̂ᵀb + c",
)
def factor_two() -> Finding:
    """J from its definition (2), λ = 1, at random θ̂."""
    t, x = trial(54, 1.0, samples=10), np.array([0.3, -0.2, 0.9])
    r, start = np.linalg.inv(t.start), t.path.theta[0]
    cost = float(np.sum((t.y - t.phi @ x) ** 2) + (x - start) @ r @ (x - start))
    a = t.information.sum(axis=0) + r
    b = -np.einsum("tpi,tp->i", t.phi, t.y) - r @ start
    c = float(np.sum(t.y**2) + start @ r @ start)
    printed, corrected = (float(x @ a @ x + times * x @ b + c) for times in (1, 2))
    return f"J = {cost:.6f}; printed {printed:.3f}, corrected {corrected:.6f}", (
        abs(printed - cost) > 0.01 and abs(corrected - cost) < 1e-9
    )


@erratum(
    "V-14a",
    "sidebar on the one-step predictor, (S5)",
    "typo",
    "... − A_kP_kC_kᵀK_kᵀ − C_kP_kA_kᵀ",
    "... − A_kP_kC_kᵀK_kᵀ − K_kC_kP_kA_kᵀ",
)
def predictor() -> Finding:
    """p = 2, n = 3: the last term is 2 × 3. With K_k it gives (S7)."""
    t = trial(55, 1.0)
    p, c = t.start, t.phi[0]
    gain = p @ c.T @ np.linalg.inv(np.eye(2) + c @ p @ c.T)
    whole = p + gain @ (np.eye(2) + c @ p @ c.T) @ gain.T - p @ c.T @ gain.T
    misfit = refused(lambda: whole - c @ p)
    gap = largest_gap(whole - gain @ c @ p, inflated(p, c))
    return f"the printed sum does not exist; corrected to {gap:.0e}", misfit and gap < 1e-12


@erratum(
    "V-14b",
    "sidebar on matrix forgetting, (S5), (S6)",
    "typo",
    "P_{1,k}⁻¹ and P_{2,k}⁻¹",
    "two singular matrices: they are nobody's inverse",
)
def not_inverses() -> Finding:
    """n = 3, one row."""
    t = trial(56, 0.9, rows=1)
    r, phi = t.path.information[5], t.phi[5]
    seen = r @ phi.T
    second = seen @ seen.T / float((phi @ seen).item())
    ranks = [int(np.linalg.matrix_rank(part, tol=1e-9)) for part in (r - second, second)]
    return f"ranks {ranks[0]} and {ranks[1]} of 3", ranks == [2, 1]


@erratum(
    "V-14c",
    "sidebar on matrix forgetting, Proposition S1",
    "typo",
    "let P₀ be symmetric and nonsingular",
    "symmetric and positive definite",
    "With a nonsingular P₀ i) fails.",
)
def start_of_matrix_forgetting() -> Finding:
    """n = 1, λ = 0.5, α = 1, N = 1, P_0 = −1: λ/P_0 + (1 − λ)α = 0, so P_1 does not exist."""
    after = 0.5 / -1.0 + 0.5 * 1.0
    rule = fg.rule("matrix_forgetting")
    try:
        fg.RLS(1, rule=rule, initial_covariance=-1.0)
    except fg.InvalidInput:
        return f"P₀ = −1 gives P₁⁻¹ = {after:g}; the package refuses it", after == 0
    return "P₀ = −1 was accepted", False


@erratum(
    "V-15",
    "(67), Propositions 9 and 10",
    "error",
    "P_k is bounded for every choice of ε (text before Proposition 10)",
    "bounded from above under persistent excitation; from below not at all",
    "Below ε data are added and never forgotten: R grows without bound.",
)
def sub_threshold() -> Finding:
    """‖φ‖ = 0.05, ε = 0.1."""
    phi = 0.05 * np.eye(2)[np.arange(20_000) % 2]
    rule = fg.rule("variable_direction", forgetting_factor=0.9, threshold=0.1)
    path = follow(rule, phi, np.zeros(20_000), every=10_000)
    first, last = 1 / path.values[1:, -1]
    return f"λ_max(R) = {first:.1f} and {last:.1f} at k = 10000, 20000", last > 1.9 * first - 1
