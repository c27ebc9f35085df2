"""The sidebars: three lemmas, Kalman predictor, maximum a posteriori, matrix forgetting."""

from __future__ import annotations

import numpy as np

import forgetting as fg

from ..claim import Finding, claim, largest_gap
from ..path import follow
from .systems import Array
from .trial import trial

FACTOR = 0.9


def kalman_predictor(phi: Array, y: Array, state: Array, covariance: Array) -> tuple[Array, Array]:
    """(S3), (S6), (S7) with A = I, B = 0, C = φ, Q = 0, R = I: the object of the claim below."""
    for c, value in zip(phi, y, strict=True):
        spread = np.eye(len(c)) + c @ covariance @ c.T
        gain = covariance @ c.T @ np.linalg.inv(spread)
        state = state + gain @ (value - c @ state)
        covariance = covariance - gain @ c @ covariance
    return state, covariance


@claim("VDF sidebar, Kalman (S8), (S9)", "RLS with λ = 1 is the predictor with A = I, Q = 0, R = I")
def predictor() -> Finding:
    """State and covariance after 60 samples."""
    t = trial(21, 1.0)
    state, covariance = kalman_predictor(t.phi, t.y, t.path.theta[0], t.start)
    gaps = largest_gap(state, t.path.theta[-1]), largest_gap(covariance, t.path.covariance[-1])
    return f"θ to {gaps[0]:.0e}, P to {gaps[1]:.0e}", max(gaps) < 1e-10


@claim(
    "VDF sidebar, maximum likelihood (S9)",
    "θ_ML maximises the posterior (S7) and minimises J_k",
    verdict="corrected",
    reason="With a prior it is the maximum a posteriori estimate; in (S7) φ_k should be φ_i.",
)
def maximum_a_posteriori() -> Finding:
    """The logarithm of the density (S7), corrected, falls in every direction from θ_{k+1}."""
    t = trial(22, FACTOR)
    weight, prior = FACTOR ** np.arange(59, -1, -1), FACTOR**60 * np.linalg.inv(t.start)

    def posterior(theta: Array) -> float:
        loss = np.sum(weight * np.sum((t.y - t.phi @ theta) ** 2, axis=1))
        away = theta - t.path.theta[0]
        return -0.5 * float(loss + away @ prior @ away)

    estimate, best = t.path.theta[-1], posterior(t.path.theta[-1])
    rng = np.random.default_rng(0)
    steps = 1e-3 * rng.standard_normal((200, 3))
    falls = [best - posterior(estimate + step) for step in steps]
    return f"falls by at least {min(falls):.1e} in 200 directions", min(falls) > 0


@claim("VDF sidebar, Lemma 1 (S1)", "(I + XWXᵀ)⁻¹y lies in the range of [X y]")
def first_lemma() -> Finding:
    """n = 6, p = 2."""
    rng = np.random.default_rng(1)
    x, y, root = rng.standard_normal((6, 2)), rng.standard_normal(6), rng.standard_normal((2, 2))
    value = np.linalg.solve(np.eye(6) + x @ (root @ root.T + np.eye(2)) @ x.T, y)
    basis = np.column_stack([x, y])
    off = value - basis @ np.linalg.lstsq(basis, value, rcond=None)[0]
    outside = float(np.linalg.norm(off) / np.linalg.norm(value))
    return f"{outside:.0e} of it lies outside", outside < 1e-12


@claim("VDF sidebar, Lemmas 2, 3", "I − A(λI + A)⁻¹ > 0 and I − (A − A(λI + A)⁻¹A)/λ > 0 for A ≥ 0")
def other_lemmas() -> Finding:
    """Singular A too; the two are the same matrix but for λ."""
    rng, smallest = np.random.default_rng(2), np.inf
    for _ in range(100):
        root, factor = rng.standard_normal((4, 3)), rng.uniform(0.1, 2)
        a, one = root @ root.T, np.eye(4)
        inner = np.linalg.inv(factor * one + a)
        for matrix in (one - a @ inner, one - (a - a @ inner @ a) / factor):
            smallest = min(smallest, float(np.linalg.eigvalsh((matrix + matrix.T) / 2)[0]))
    return f"smallest eigenvalue over 100 matrices: {smallest:.2g}", smallest > 0


@claim("VDF sidebar, matrix forgetting Prop. S1 ii)–v)", "P_k⁻¹ ≥ αI, bounded, and → αI in silence")
def matrix_forgetting() -> Finding:
    """Both choices of M_k, N = 1 and 3, from P_0⁻¹ = 1.5 I with α = 1."""
    phi = np.random.default_rng(3).standard_normal((300, 2))
    phi[150:] = 0
    least, most, last = np.inf, 0.0, 0.0
    for choice, power in ((1, 1), (1, 3), (2, 1), (2, 3)):
        values = {"information": 1.0, "power": power, "choice": choice}
        rule = fg.rule("matrix_forgetting", forgetting_factor=0.8, **values)
        path = follow(rule, phi, np.zeros(300), initial_covariance=1 / 1.5)
        least, most = min(least, 1 / path.values.max()), max(most, 1 / path.values.min())
        if power == 1:
            last = max(last, abs(1 / path.values[-1, 0] - 1))
    measured = f"{least:.6f} ≤ P⁻¹/α ≤ {most:.3g}; N = 1 ends within {last:.0e} of αI"
    return measured, least >= 1 - 1e-9 and most < 100 and last < 1e-6


@claim(
    "VDF sidebar, directional (S5)–(S8)",
    "P_{k+1}⁻¹ = P₁⁻¹ + λP₂⁻¹ + φᵀφ, P₁⁻¹φᵀ = 0, rank P₂⁻¹ = 1",
)
def directional() -> Finding:
    """At every sample of a record of one row."""
    t = trial(23, FACTOR, "directional", rows=1)
    r, worst, across = t.path.information, 0.0, 0.0
    for k in range(60):
        seen = r[k] @ t.phi[k].T
        second = seen @ seen.T / float((t.phi[k] @ seen).item())
        first = r[k] - second
        across = max(across, float(np.abs(first @ t.phi[k].T).max() / np.abs(r[k]).max()))
        worst = max(worst, largest_gap(first + FACTOR * second + t.information[k], r[k + 1]))
    return f"(S6) to {worst:.0e}, P₁⁻¹φᵀ to {across:.0e}", max(worst, across) < 1e-11
