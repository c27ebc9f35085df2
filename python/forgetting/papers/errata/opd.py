"""Errata of Zhu, Yu and Wan, *Variable-direction forgetting via oblique projection
decomposition*."""

from __future__ import annotations

from ..opd import convergence, decomposition
from .erratum import Erratum, claimed
from .opd_evidence import (
    added_information,
    cross_term,
    first_bound,
    innovation,
    projector,
    regressor,
)

ERRATA = (
    innovation,
    added_information,
    Erratum("Z-1c", "section I", "typo", "VDF-EM", "VDF-ED"),
    Erratum(
        "Z-1d",
        "Algorithm 1",
        "typo",
        "update θ̂_k by (22), then R_k by (23)",
        "R_k by (23), then θ̂_k by (22)",
        "(22) needs R_k.",
    ),
    Erratum("Z-1e", "(21)", "typo", "P_{k−1}", "R_{k−1}⁻¹", "P is not defined in the paper."),
    regressor,
    first_bound,
    Erratum(
        "Z-5",
        "Theorem 5, (34)",
        "error",
        "there is a < 1 with θ̃ᵀR̄R_k⁻¹R̄θ̃ ≤ a θ̃ᵀR_{k−1}θ̃",
        "a = 1; E V_k ≤ E V_{k−1} + bδ, and contraction only under persistent excitation",
        "What is retained keeps its error, so the claimed convergence of the variance bound fails.",
        claimed(convergence.contraction),
    ),
    cross_term,
    Erratum(
        "Z-7",
        "Theorem 3",
        "gap",
        "R_k > β_kI",
        "a uniform floor needs a dead zone for each singular value",
        "β_k is not bounded away from zero.",
        claimed(convergence.lower_bound),
    ),
    Erratum(
        "Z-8",
        "Theorem 4",
        "error",
        "μ_k ≤ μ̄ < 1 according to (21), so R_k is bounded",
        "cap μ_k ≤ μ̄ < 1; then R_k ≤ max(c²/(1 − μ̄), λ_max(R₀)) I",
        "(21) gives μ_k = 1 at e_k = 0.",
        claimed(convergence.upper_bound),
    ),
    Erratum(
        "Z-9",
        "section IV",
        "error",
        "VDF-ED discounts an unexcited direction until its eigenvalue reaches ε_th",
        "until its content falls to ε_th; in the paper's example it is discounted once",
        "The threshold (25) is on ‖Φᵀu_i‖, not on eigenvalues.",
        claimed(decomposition.discounted_once),
    ),
    projector,
)
