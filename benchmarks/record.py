"""The data that every side gets, and the solution that every side must find."""

from __future__ import annotations

import numpy as np

LAMBDA, P0 = 0.999, 100.0
# relative difference of theta after the record from the solution; of float32 what its digits allow
AGREES = {"float64": 1e-8, "float32": 2e-2}
NUMBERS, LONGEST, SHORTEST = 32768, 8192, 64


def record(n: int, dtype: str = "float64") -> tuple[np.ndarray, np.ndarray]:
    """White regressors and measurements, few enough for the second cache and for short turns."""
    samples = min(LONGEST, max(SHORTEST, NUMBERS // n))
    random = np.random.default_rng(n)
    phi = random.standard_normal((samples, n))
    y = phi @ random.standard_normal(n) + 0.1 * random.standard_normal(samples)
    return phi.astype(dtype), y.astype(dtype)


def solution(phi: np.ndarray, y: np.ndarray, factor: float = LAMBDA, p0: float = P0) -> np.ndarray:
    """Theta after all samples, from the cost that exponential forgetting minimises."""
    phi, y = phi.astype(float), y.astype(float)
    weights = factor ** np.arange(len(y) - 1, -1, -1.0)
    prior = factor ** len(y) / p0 * np.eye(phi.shape[1])
    return np.linalg.solve((phi.T * weights) @ phi + prior, (phi.T * weights) @ y)


class WrongResult(ArithmeticError):
    """What computes something else is not timed."""


def check(theta: np.ndarray, reference: np.ndarray) -> None:
    """Raise WrongResult unless they agree."""
    apart = float(np.linalg.norm(theta - reference) / np.linalg.norm(reference))
    if not apart < AGREES[str(theta.dtype)]:
        raise WrongResult(f"theta differs by {apart:.1e}, relative")
