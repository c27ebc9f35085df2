"""A run that satisfies A1-A8 and exceeds the printed bound of Theorem 3.

n = p = 2, N = 1, Γ = I, no noise. Three phases, repeated with the drift turned round each time so
that θ stays bounded; the error follows (26), θ̌_{k+1} = M_k(θ̌_k − δ_θ):

    A  P is held at a₀I by F = φᵀφ = αI while θ drifts along e₂: the error settles at δ_θ/(a₀α)
    B  one direction v, almost e₁, is forgotten up to covariance b; then K steps without
       forgetting, φᵀφ = diag(α, β), turn the error into v. V = θ̌ᵀP⁻¹θ̌ falls all the while
    C  strong excitation, φᵀφ = βI, brings P back to a₀I
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from forgetting.analysis import UltimateBound, ultimate_bound

Array = NDArray[Any]

ALPHA, BETA, HIGH = 0.002, 0.2, 1.0
STEPS = round(3 / (HIGH * ALPHA))
"""K, so that K b α = 3."""
HELD = 0.15 / (STEPS * BETA)
"""a₀."""


class Excursion:
    """The error, R, and the bounds of P met on the way."""

    def __init__(self) -> None:
        self.error: Array = np.zeros(2)
        self.information = np.eye(2) / HELD
        self.lowest, self.highest, self.decay = np.inf, 0.0, True

    def step(self, kept: Array, measured: Array) -> None:
        """R̄ = `kept` <= R, then the measurement; (26) without drift."""
        self.decay &= bool(np.linalg.eigvalsh(self.information - kept)[0] > -1e-6)
        after = kept + measured
        self.error = np.linalg.solve(after, kept @ self.error)
        self.information = after
        self.highest = max(self.highest, 1 / float(np.linalg.eigvalsh(kept)[0]))
        self.lowest = min(self.lowest, 1 / float(np.linalg.eigvalsh(after)[-1]))

    def drift(self, sign: float, samples: int) -> None:
        """Phase A in closed form: M = (1 - a₀α) I at every step, δ_θ = 1."""
        shrink = 1 - HELD * ALPHA
        share = shrink**samples
        settled = -sign * np.array([0.0, 1.0]) * shrink / (HELD * ALPHA)
        self.error = share * self.error + (1 - share) * settled

    def turn(self, direction: Array) -> float:
        """Phase B; the largest error on the way."""
        kept = np.eye(2) / HELD + (1 / HIGH - 1 / HELD) * np.outer(direction, direction)
        largest = 0.0
        for _ in range(STEPS):
            self.step(kept, np.diag([ALPHA, BETA]))
            kept = self.information
            largest = max(largest, float(np.linalg.norm(self.error)))
        return largest

    def restore(self) -> None:
        """Phase C, in the eigenbasis of R, which it leaves as it is."""
        values, vectors = np.linalg.eigh(self.information)
        error = vectors.T @ self.error
        while values[0] < (1 - 1e-9) / HELD:
            kept = np.minimum(values, 1 / HELD - BETA)  # what would exceed 1/a₀ is forgotten
            values = kept + BETA
            error = kept / values * error
        self.information, self.error = vectors * values @ vectors.T, vectors @ error


def direction() -> Array:
    """The v that turns e₂ into the largest error after phase B."""
    best, largest = np.array([1.0, 0.0]), 0.0
    for slope in np.linspace(0.02, 0.3, 29):
        v = np.array([1.0, slope]) / np.hypot(1.0, slope)
        kept = np.eye(2) / HELD + (1 / HIGH - 1 / HELD) * np.outer(v, v)
        after = kept + STEPS * np.diag([ALPHA, BETA])
        size = float(np.linalg.norm(np.linalg.solve(after, kept @ [0.0, 1.0])))
        best, largest = (v, size) if size > largest else (best, largest)
    return best


def printed_bound_exceeded() -> tuple[float, UltimateBound]:
    """Largest error of the second cycle, and the bounds for the constants found.

    Units are chosen so that a >= 1, where the factor max{1, 1/√a} of (28) is 1.
    """
    run, v, largest = Excursion(), direction(), 0.0
    for cycle in range(2):
        run.drift((-1.0) ** cycle, samples=30_000_000)
        found = run.turn(v)
        run.restore()
        largest = max(largest, found) if cycle else 0.0
    if not run.decay:
        raise ArithmeticError("forgetting added information")
    scale = 1 / run.lowest
    constants = {"a": run.lowest * scale, "b": run.highest * scale, "window": 1.0}
    constants |= {"alpha": ALPHA / scale, "beta": BETA / scale}
    return largest, ultimate_bound(constants, parameter_drift=1.0, measurement_noise=0.0)
