"""Table 3: the expressions of P_k, θ_k and θ̃_k, each against the estimator."""

from __future__ import annotations

import numpy as np

from ..claim import Finding, claim, largest_gap
from .systems import Array
from .trial import Trial, inflated, trial

FACTOR, SAMPLES = 0.9, 60
GAP = 1e-10
"""Largest gap accepted: a hundred times what rounding of the explicit inverses leaves."""


def record() -> Trial:
    """Two rows, three parameters, λ = 0.9."""
    return trial(11, FACTOR)


def found(value: Array | list[Array], wanted: Array) -> Finding:
    """An expression against the estimator."""
    gap = largest_gap(value, wanted)
    return f"equal to {gap:.0e}", gap < GAP


def weights() -> Array:
    """λ^(k-i) for k = SAMPLES - 1."""
    return np.asarray(FACTOR ** np.arange(SAMPLES - 1, -1, -1))


@claim("VDF Table 3, (4)", "P_{k+1} = P_k/λ − P_k φᵀ(λI + φP_kφᵀ)⁻¹φP_k/λ")
def covariance() -> Finding:
    """At every sample."""
    t = record()
    p = t.path.covariance
    return found([inflated(p[k], t.phi[k], FACTOR) for k in range(SAMPLES)], p[1:])


@claim("VDF Table 3, (8)", "P_{k+1}⁻¹ = λP_k⁻¹ + φ_kᵀφ_k")
def information() -> Finding:
    """At every sample."""
    t = record()
    r = t.path.information
    return found(FACTOR * r[:-1] + t.information, r[1:])


@claim("VDF Table 3, (8) summed", "P_{k+1}⁻¹ = λ^{k+1}P₀⁻¹ + Σ λ^{k−i}φ_iᵀφ_i")
def summed_information() -> Finding:
    """At the end of the record."""
    t = record()
    total = np.einsum("t,tij->ij", weights(), t.information)
    return found(FACTOR**SAMPLES * np.linalg.inv(t.start) + total, t.path.information[-1])


@claim("VDF Table 3, (5)", "θ_{k+1} = θ_k + P_{k+1}φᵀ(y_k − φ_kθ_k)")
def correction() -> Finding:
    """At every sample."""
    t = record()
    error = t.y - np.einsum("tpi,ti->tp", t.phi, t.path.theta[:-1])
    step = np.einsum("tij,tpj,tp->ti", t.path.covariance[1:], t.phi, error)
    return found(t.path.theta[:-1] + step, t.path.theta[1:])


@claim("VDF Table 3, (6)", "θ_{k+1} = θ_k + P_kφᵀ(λI + φP_kφᵀ)⁻¹(y_k − φ_kθ_k)")
def gain_from_before() -> Finding:
    """At every sample."""
    t = record()
    error = t.y - np.einsum("tpi,ti->tp", t.phi, t.path.theta[:-1])
    gain = t.path.covariance[:-1] @ np.swapaxes(t.phi, 1, 2)
    inside = FACTOR * np.eye(2) + t.phi @ gain
    step = gain @ np.linalg.solve(inside, error[:, :, np.newaxis])
    return found(t.path.theta[:-1] + step[:, :, 0], t.path.theta[1:])


@claim("VDF Table 3, (15)", "θ_{k+1} = P_{k+1}(Σ λ^{k−i}φ_iᵀy_i + λ^{k+1}P₀⁻¹θ₀)")
def from_all_data() -> Finding:
    """At the end of the record."""
    t = record()
    seen = np.einsum("t,tpi,tp->i", weights(), t.phi, t.y)
    prior = FACTOR**SAMPLES * np.linalg.solve(t.start, t.path.theta[0])
    return found(t.path.covariance[-1] @ (seen + prior), t.path.theta[-1])


@claim("VDF Table 3, (9)", "θ̃_k = θ_k − θ, so φ_iθ_k − y_i = φ_iθ̃_k (10)")
def parameter_error() -> Finding:
    """At every sample."""
    t = record()
    left = np.einsum("tpi,ti->tp", t.phi, t.path.theta[:-1]) - t.y
    return found(left, np.einsum("tpi,ti->tp", t.phi, t.error[:-1]))


@claim("VDF Table 3, (12)", "θ̃_{k+1} = (I − P_{k+1}φᵀφ)θ̃_k")
def error_map() -> Finding:
    """At every sample."""
    t = record()
    step = np.eye(3) - t.path.covariance[1:] @ t.information
    return found(np.einsum("tij,tj->ti", step, t.error[:-1]), t.error[1:])


@claim("VDF Table 3, (13)", "θ̃_{k+1} = λP_{k+1}P_k⁻¹θ̃_k")
def error_ratio() -> Finding:
    """At every sample."""
    t = record()
    step = FACTOR * t.path.covariance[1:] @ t.path.information[:-1]
    return found(np.einsum("tij,tj->ti", step, t.error[:-1]), t.error[1:])


@claim("VDF Table 3, (14)", "θ̃_k = λ^{k−l}P_kP_l⁻¹θ̃_l")
def error_between() -> Finding:
    """For l = 5 and every later k."""
    t = record()
    carried = t.path.covariance[5:] @ t.path.information[5] @ t.error[5]
    powers = FACTOR ** np.arange(SAMPLES - 4)
    return found(powers[:, np.newaxis] * carried, t.error[5:])
