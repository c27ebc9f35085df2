"""Errata of Lai and Bernstein, *Generalized forgetting recursive least squares*."""

from __future__ import annotations

from ..gf import family, theorem3
from ..vdf import lyapunov
from .erratum import Erratum, claimed
from .gf_evidence import (
    dead_zone,
    exponent,
    index,
    not_square,
    regulariser,
    sanity_check,
    seventh_lemma,
    shorter_products,
    ultimate_boundedness,
)

ERRATA = (
    regulariser,
    Erratum(
        "GF-1b",
        "A7",
        "typo",
        "there exists δ̄_y ≥ 0",
        "there exists δ̄_φ ≥ 0",
        "The bound used below is δ̄_φ.",
    ),
    Erratum(
        "GF-1c",
        "Definition 4",
        "typo",
        "equilibrium: f(k, 0) = 0",
        "f(k, x_eq) = x_eq",
        "The definition names x_eq and then does not use it.",
    ),
    Erratum(
        "GF-3",
        "section V-D, (50)",
        "error",
        "data-dependent updating is variable-rate forgetting with λ_k = (1 − μ_k)μ_{k−1}/μ_k",
        "Γ_k = I/μ_k and F_k = μ_kP_k⁻¹",
        "The printed λ_k is undefined at μ_k = 0 and exceeds 1.",
        claimed(family.data_dependent_updating),
    ),
    index,
    seventh_lemma,
    ultimate_boundedness,
    Erratum(
        "GF-7b",
        "Theorem 3, (28)",
        "error",
        "ε* carries max{1, 1/√a}",
        "ε* carries √(b/a)",
        "Follows from GF-7a. The printed ε* changes when P and Γ are scaled together, which "
        "changes no estimate.",
        claimed(theorem3.units),
    ),
    Erratum(
        "GF-7c",
        "Theorem 3, (27)",
        "error",
        "the error is ultimately bounded by ε",
        "by ε with the corrected ε*",
        "A run that satisfies A1–A8 and exceeds the printed bound.",
        claimed(theorem3.exceeded),
    ),
    shorter_products,
    sanity_check,
    exponent,
    Erratum(
        "GF-11",
        "Definition 5 iv); Definition 5 and Theorem 7 of the tutorial",
        "error",
        "‖x_k‖ ≤ α‖x_{k₀}‖β^{−k}",
        "‖x_k‖ ≤ α‖x_{k₀}‖β^{−(k−k₀)}",
        "With k = k₀ large, nothing but zero satisfies the printed form.",
        claimed(lyapunov.geometric),
    ),
    Erratum(
        "GF-12",
        "(25), (26)",
        "typo",
        "θ_true,−1 at k = 0",
        "θ_true,−1 = θ_true,0",
        "It is not defined.",
    ),
    Erratum(
        "GF-J",
        "section V-J",
        "error",
        "if λ_{1,k}, λ_{2,k} are chosen sufficiently small, multiple forgetting is proper",
        "if λ_k ≤ 1 − |ρ_k| at every sample, ρ_k the correlation of R_k",
        "A small λ at one sample makes the next R_k nearly φᵀφ, whose correlation is 1.",
        claimed(family.multiple_forgetting),
    ),
    not_square,
    dead_zone,
)
