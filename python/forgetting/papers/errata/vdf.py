"""Errata of Goel, Bruce and Bernstein, *Recursive least squares with variable-direction
forgetting*."""

from __future__ import annotations

from ..vdf import example04, lyapunov, propositions, sidebars, theorem_s1
from .erratum import Erratum, claimed
from .vdf_evidence import (
    bounded_condition,
    condition_number,
    factor_two,
    index_in_the_proof,
    not_inverses,
    predictor,
    start_of_matrix_forgetting,
    sub_threshold,
    transposes,
    twice_the_window,
    weights,
)

ERRATA = (
    Erratum(
        "V-1",
        "Lemma 1, (20)",
        "error",
        "P_k⁻¹ = F_{0,k} + P₀⁻¹",
        "P_k⁻¹ = F_{0,k−1} + P₀⁻¹",
        "Off by one. The first display of the proof of Proposition 3 has its inequality reversed.",
        claimed(propositions.information_so_far),
    ),
    twice_the_window,
    condition_number,
    bounded_condition,
    Erratum(
        "V-5",
        "Proposition 5",
        "error",
        "N ≥ (λβ̄ − ᾱ)/((1 − λ)ᾱ)",
        "N > (λβ̄ − ᾱ)/((1 − λ)ᾱ)",
        "With equality the lower bound of (26) is zero. The first line of the proof has −β̄ where "
        "−λβ̄ is meant.",
        claimed(propositions.converse),
    ),
    Erratum(
        "V-6",
        "proof of Theorem 6, (44)",
        "error",
        "γ₁ = (1 − λ)(β/(1 − λᴺ⁺¹) + ‖P_N⁻¹‖)",
        "γ₁ = (1 − λ) λᴺ(1 − λ)α/(1 − λᴺ⁺¹)",
        "An upper bound multiplied by a negative factor. The theorem stands.",
        claimed(lyapunov.lyapunov_decrease),
    ),
    Erratum(
        "V-7",
        "Propositions 6 and 9",
        "error",
        "z_k → 0 whether or not φ is persistently exciting",
        "... for bounded φ",
        "With φ_k = 1.5^(2^k) and λ = 1 z_k tends to 1.",
        claimed(propositions.error_vanishes),
    ),
    transposes,
    index_in_the_proof,
    weights,
    factor_two,
    Erratum(
        "V-12",
        "Theorem S1; after Proposition 8",
        "error",
        "(64) is optimal for the cost (S2)",
        "(64), (5) minimises the GF-RLS cost with F_k = P_k⁻¹ − Λ_kP_k⁻¹Λ_k",
        "(S5) is the minimiser of (S2), but it is another estimator, and it diverges.",
        claimed(theorem_s1.diverges),
    ),
    Erratum(
        "V-13",
        "Example 4",
        "typo",
        "in the second case u_k = 1",
        "another input of rank one, such as u_k = (−1)ᵏ",
        "One input cannot have two limits.",
        claimed(example04.second_input),
    ),
    predictor,
    Erratum(
        "V-14d",
        "sidebar on maximum likelihood, (S7), (S9)",
        "typo",
        "φ_kθ in the sum; maximum likelihood",
        "φ_iθ; maximum a posteriori",
        "The density has a prior.",
        claimed(sidebars.maximum_a_posteriori),
    ),
    not_inverses,
    start_of_matrix_forgetting,
    sub_threshold,
)
