"""Conditions A5-A8: how far parameters move and how large the noise is.

None of these can be read from inputs and outputs alone: noise and wrong parameters move
the output alike. They are decided from the truth, or from a bound the user vouches for.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from .information import whiten
from .trajectory import Trajectory
from .validation import Array, numbers, real, refuse

Verdict = Literal["holds", "fails", "not decidable"]
Item = tuple[str, str, Verdict, dict[str, float], "int | None", str]

UNKNOWN = "needs the truth, or a bound given by the user"


def disturbances(
    trajectory: Trajectory,
    true_theta: ArrayLike | None,
    measurement_noise: ArrayLike | None,
    regressor_noise: ArrayLike | None,
) -> tuple[Item, ...]:
    """Return the findings on A5-A8."""
    drift, norm = _parameters(trajectory, true_theta)
    noise = _measurement(trajectory, measurement_noise)
    blur = _regressor(trajectory, regressor_noise)
    return (
        _item("A5", "bounded drift of the parameters", "parameter_drift", drift),
        _item("A6", "bounded measurement noise", "measurement_noise", noise),
        _item("A7", "bounded regressor noise", "regressor_noise", blur),
        _item("A8", "bounded parameters", "parameter_norm", norm),
    )


def _item(name: str, statement: str, symbol: str, bound: float | None) -> Item:
    if bound is None:
        return name, statement, "not decidable", {}, None, UNKNOWN
    reason = f"{symbol} = {bound:.4g} over the record"
    return name, statement, "holds", {symbol: bound}, None, reason


def _parameters(
    trajectory: Trajectory, theta: ArrayLike | None
) -> tuple[float | None, float | None]:
    """δ_θ and θ_max."""
    if theta is None:
        return None, None
    values = numbers("true_theta", theta)
    if values.shape == (trajectory.parameters,):
        return 0.0, float(np.linalg.norm(values))
    samples = trajectory.samples + trajectory.first
    if values.shape != (samples, trajectory.parameters):
        allowed = f"shape {(trajectory.parameters,)} or {(samples, trajectory.parameters)}"
        raise refuse("true_theta", values.shape, allowed)
    steps = np.linalg.norm(np.diff(values, axis=0), axis=1)
    return float(steps.max(initial=0.0)), float(np.linalg.norm(values, axis=1).max())


def _measurement(trajectory: Trajectory, noise: ArrayLike | None) -> float | None:
    """δ_y, the largest ‖Γ^{-1/2} δ_y‖."""
    if noise is None:
        return None
    values = numbers("measurement_noise", noise)
    if values.ndim == 0:
        return real("measurement_noise", float(values), 0.0, math.inf)
    values = values.reshape(len(values), -1)
    samples = trajectory.samples + trajectory.first
    if values.shape != (samples, trajectory.rows):
        allowed = f"a bound, or shape {(samples, trajectory.rows)}"
        raise refuse("measurement_noise", values.shape, allowed)
    white = _whiten(trajectory, values[trajectory.first :, :, np.newaxis])
    return float(np.linalg.norm(white, axis=(1, 2)).max())


def _regressor(trajectory: Trajectory, noise: ArrayLike | None) -> float | None:
    """δ_φ, the largest eigenvalue of δ_φᵀ Γ⁻¹ δ_φ."""
    if noise is None:
        return None
    values = numbers("regressor_noise", noise)
    if values.ndim == 0:
        return real("regressor_noise", float(values), 0.0, math.inf)
    samples = trajectory.samples + trajectory.first
    if values.ndim == 2:
        values = values[:, np.newaxis, :]
    if values.shape != (samples, trajectory.rows, trajectory.parameters):
        allowed = f"a bound, or shape {(samples, trajectory.rows, trajectory.parameters)}"
        raise refuse("regressor_noise", values.shape, allowed)
    white = _whiten(trajectory, values[trajectory.first :])
    return float(np.linalg.norm(white, ord=2, axis=(1, 2)).max() ** 2)


def _whiten(trajectory: Trajectory, values: Array) -> Array:
    return whiten(np.linalg.cholesky(trajectory.weight), values)
