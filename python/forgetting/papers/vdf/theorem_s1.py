"""Theorem S1: the estimator (S5) is not variable-direction forgetting, and it diverges.

(S5) is written out here, and only here, because it is the object of the claim: P_k comes from the
package's variable-direction rule, θ from (S5).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ..claim import Finding, claim, largest_gap
from .systems import Array
from .trial import Trial, trial

FACTOR, THRESHOLD, SAMPLES = 0.9, 1e-8, 400


@lru_cache(maxsize=1)
def record() -> Trial:
    """One row, three parameters, persistently excited, noise-free."""
    return trial(31, FACTOR, "variable_direction", SAMPLES, 1, threshold=THRESHOLD)


@lru_cache(maxsize=1)
def printed_estimator() -> tuple[Array, Array]:
    """θ_k of (S5), and R_k of (S3), which is R_{k-1} plus what forgetting takes from P_k⁻¹."""
    t = record()
    theta, kept = t.path.theta[0], np.linalg.inv(t.start)
    thetas = [theta]
    for k in range(SAMPLES):
        p = t.path.covariance[k + 1]
        change = t.path.information[k + 1] - t.information[k] - t.path.information[k]
        step = p @ t.phi[k].T @ (t.y[k] - t.phi[k] @ theta)
        theta = theta + step + p @ change @ (t.path.theta[0] - theta)
        kept = kept + change
        thetas.append(theta)
    return np.stack(thetas), kept


@claim("VDF Theorem S1", "(S5) is the unique global minimiser of (S2)")
def minimiser() -> Finding:
    """From all the data."""
    t, (theta, kept) = record(), printed_estimator()
    left = t.information.sum(axis=0) + kept
    right = np.einsum("tpi,tp->i", t.phi, t.y) + kept @ t.path.theta[0]
    gap = largest_gap(np.linalg.solve(left, right), theta[-1])
    return f"to {gap:.0e}", gap < 1e-8


@claim(
    "VDF Theorem S1 and (64), (5)",
    "(64) is optimal for the cost (S2)",
    verdict="corrected",
    reason="(S2) weighs all data alike and its R_k becomes negative: its minimiser diverges. The "
    "estimator (64), (5) minimises the GF-RLS cost (4) with F_k = P_k⁻¹ − Λ_kP_k⁻¹Λ_k.",
)
def diverges() -> Finding:
    """Error of (S5) beside that of variable-direction forgetting."""
    t, (theta, kept) = record(), printed_estimator()
    norm = np.linalg.norm(theta - t.theta, axis=1)
    ours = np.linalg.norm(t.error, axis=1)
    words = ", ".join(f"{norm[k]:.3g}" for k in (10, 50, 200, 400))
    measured = f"(S5): {words} at k = 10, 50, 200, 400; (64), (5): {ours[-1]:.0e}"
    negative = float(np.linalg.eigvalsh((kept + kept.T) / 2)[-1]) < 0
    return measured, negative and bool(norm[400] > 1.5 * norm[200] > 1.5 * norm[50]) and (
        bool(ours[-1] < 1e-6)
    )
