"""Evidence for the errata of Zhu, Yu and Wan, *Variable-direction forgetting via oblique projection
decomposition*.

One function an erratum: it measures the printed form failing and the corrected one holding.
"""

from __future__ import annotations

import numpy as np

import forgetting as fg

from ..claim import Finding, largest_gap
from ..opd.system import Settings, inputs, parameters, simulate
from ..path import follow
from .erratum import erratum, refused


@erratum(
    "Z-1a",
    "(5a)",
    "typo",
    "θ̂_k = θ̂_{k−1} + R_k⁻¹Φ_k(y_k − Φ_kᵀθ̂_k)",
    "... (y_k − Φ_kᵀθ̂_{k−1})",
    "As printed θ̂_k stands on both sides, and its solution is not the least-squares one.",
)
def innovation() -> Finding:
    """The printed equation solved for θ̂_k, one row, one step."""
    phi, y = np.array([[1.0, 2.0]]), np.array([3.0])
    path = follow(fg.rule("exponential", forgetting_factor=0.9), phi, y)
    p = path.covariance[1]
    printed = np.linalg.solve(np.eye(2) + p @ phi.T @ phi, p @ phi.T @ y)
    minimiser = np.linalg.solve(0.9 * np.eye(2) + phi.T @ phi, phi.T @ y)
    gaps = largest_gap(printed, minimiser), largest_gap(path.theta[1], minimiser)
    return f"printed off by {gaps[0]:.2f}, corrected {gaps[1]:.0e}", gaps[0] > 0.01 > 1e-9 > gaps[1]


@erratum(
    "Z-1b",
    "(24)",
    "typo",
    "R_k = UΛΣΛUᵀ + Φ_kᵀΦ_k",
    "... + Φ_kΦ_kᵀ",
    "Φ_k is n × m in this paper, p × n in the one that (24) is taken from.",
)
def added_information() -> Finding:
    """n = 6, m = 2."""
    phi = simulate(Settings(samples=3), 0)[0][2].T
    misfit = refused(lambda: np.eye(6) + phi.T @ phi)
    return "6 × 6 plus 2 × 2 does not exist", misfit and (np.eye(6) + phi @ phi.T).shape == (6, 6)


@erratum(
    "Z-2",
    "section VI, the regressor",
    "typo",
    "y₂(k) in the fifth row",
    "y₂(k − 1)",
    "The system has b₂y₂(k − 1); the output itself cannot be its own regressor.",
)
def regressor() -> Finding:
    """The second equation of the system without noise."""
    settings = Settings(samples=200, noise=0.0)
    y = simulate(settings, 0)[1]
    theta, u = parameters(200), inputs(200)
    output = np.concatenate([[[0.0, 0.0]], y])
    right = np.einsum("kj,kj->k", theta[:, 3:5], output[:-1]) + theta[:, 5] * u[:, 1]
    as_printed = theta[:, 3] * output[:-1, 0] + theta[:, 4] * y[:, 1] + theta[:, 5] * u[:, 1]
    gaps = largest_gap(as_printed, y[:, 1]), largest_gap(right, y[:, 1])
    return f"printed off by {gaps[0]:.2f}, corrected {gaps[1]:.0e}", gaps[0] > 0.01 > 1e-9 > gaps[1]


@erratum(
    "Z-3",
    "Theorem 5, (36)",
    "typo",
    "ζ₀ = θ̂₀ᵀR₀θ̂₀",
    "ζ₀ = θ̃₀ᵀR₀θ̃₀",
    "ζ₀ must bound V₀; with θ̂₀ = 0 the printed one is 0.",
)
def first_bound() -> Finding:
    """θ̂_0 = 0, θ = 1, R_0 = 1."""
    printed, corrected, v = 0.0, 1.0, (1.0 - 0.0) ** 2
    return f"V₀ = {v:g}; printed {printed:g}, corrected {corrected:g}", printed < v <= corrected


@erratum(
    "Z-6",
    "proof of Theorem 5, (59)",
    "gap",
    "the cross term of (58) has zero mean, because v_k and Φ_k are independent",
    "... if μ_k does not depend on v_k",
    "By (21) μ_k depends on e_k and so on v_k; R_k and v_k are not independent.",
)
def cross_term() -> Finding:
    """Mean of vΦᵀR_k⁻¹R̄θ̃ over v ~ N(0, 1), by quadrature; scalars, θ̃ = 1, η = 0.1."""
    v, weight = np.polynomial.hermite_e.hermegauss(80)
    square = (1 + v) ** 2
    means = []
    for mu in (1 - square / (0.1 + square) / 2, np.full(80, 0.8)):
        means.append(float(weight @ (v * mu / (mu + 1)) / weight.sum()))
    measured = f"{means[0]:.4f} with (21), {means[1]:.0e} with a constant μ"
    return measured, abs(means[0]) > 1e-3 and abs(means[1]) < 1e-12


@erratum(
    "Z-10",
    "Appendix A, Lemma 1",
    "error",
    "X(YᵀX)†Yᵀ is the projector onto range X along Null Yᵀ whenever YᵀX ≠ 0",
    "... when the two subspaces are complementary",
)
def projector() -> Finding:
    """X = [e₁ e₂], Y = e₁ in the plane."""
    x, y = np.eye(2), np.array([[1.0], [0.0]])
    found = x @ np.linalg.pinv(y.T @ x) @ y.T
    moved = float(np.linalg.norm(found @ [0.0, 1.0] - [0.0, 1.0]))
    oblique = np.array([[1.0], [1.0]])
    fine = oblique @ np.linalg.pinv(y.T @ oblique) @ y.T
    kept = largest_gap(fine @ oblique, oblique)
    return (
        f"e₂, in range X, is moved by {moved:g}; complementary: {kept:.0e}",
        moved == 1 and kept < 1e-12,
    )
