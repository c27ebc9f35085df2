"""Theorem 3 of Lai and Bernstein, corrected: how large the error can stay under
drift of the parameters, measurement noise and regressor noise.

    ε = ε* ζ,   ζ = δ_θ + b √β (√δ_φ θ_max + δ_y),   Δ = 1/(a c_N) - 1

The printed ε* = max{1, 1/√a} (Δ + √(Δ + Δ²)) N (eq. (28)) lacks the lower bound of the
Lyapunov function, 1/b: it changes with the units of the weighting and can be exceeded. It
also bounds products of fewer than N factors by the decrease of N. Two derivations
without these slips, of which the smaller is taken:

* Lyapunov:     ε* = √(b/a) N √D (√Δ + √(1+Δ)),   D = Δ + 1 - 1/N
  (the shorter products contract by 1/a only, so ‖P^{-1/2}[M ... ]‖² <= N/a - c_N);
* contraction:  ε* = √(b/a) (N - 1 + ρ)(1 + ρ)(1 + Δ),   ρ² = Δ/(1+Δ)
  (√V grows by ζ/√a a step at most and shrinks by ρ over N steps).

They coincide at N = 1. Both are loose: a diagnostic, never a tuning rule.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .conditions import Conditions
from .lyapunov import lyapunov_decrease
from .validation import Array, numbers, real, refuse


@dataclass(frozen=True)
class Amplification:
    """ε*, the factor from the disturbance to the error, from three derivations."""

    lyapunov: float
    contraction: float
    printed: float

    @property
    def corrected(self) -> float:
        """The smaller of the two sound ones."""
        return min(self.lyapunov, self.contraction)


@dataclass(frozen=True, eq=False)
class UltimateBound:
    """Bound of the error after transients. See `ultimate_bound`.

    Attributes
    ----------
    bound : float
        ε, in the units of θ; inf where Theorem 3 does not apply.
    printed : float
        Eq. (27) with (28) as printed, for comparison only: it is not a bound.
    errors_in_variables : float
        ε for fixed parameters (δ_θ = 0).
    amplification : Amplification
        ε* from each derivation.
    disturbance : float
        ζ, units of θ.
    constants : dict
        a, b, alpha, beta, window and the disturbance bounds used.
    error : (T,) or None
        ‖θ̌_k‖ seen, where the truth was given.
    reason : str
        Why the theorem applies, or why not.
    """

    bound: float
    printed: float
    errors_in_variables: float
    amplification: Amplification
    disturbance: float
    constants: dict[str, float] = field(repr=False)
    error: Array | None = field(repr=False)
    reason: str

    @property
    def observed(self) -> float | None:
        """Largest error in the second half of the record."""
        return None if self.error is None else float(self.error[self.error.size // 2 :].max())

    @property
    def looseness(self) -> float | None:
        """Bound over the largest error in the second half of the record."""
        seen = self.observed
        if seen is None:
            return None
        return math.inf if seen == 0 else self.bound / seen

    def __str__(self) -> str:
        """The bound in words."""
        if not math.isfinite(self.bound):
            return f"No ultimate bound: {self.reason}."
        text = f"The error stays under {self.bound:.3g} after transients ({self.reason})"
        if self.looseness is not None:
            text += f"; the largest seen is {self.observed:.3g}, {self.looseness:.3g} times less"
        return text + "."

    def to_dict(self) -> dict[str, Any]:
        """Return the scalars, ready for JSON (None for an infinite bound)."""
        values = {
            "bound": self.bound,
            "printed": self.printed,
            "errors_in_variables": self.errors_in_variables,
            "disturbance": self.disturbance,
            "observed": self.observed,
            "looseness": self.looseness,
        }
        finite = {name: _finite(value) for name, value in values.items()}
        return {**finite, "constants": dict(self.constants), "reason": self.reason}


def amplification(a: float, b: float, alpha: float, beta: float, window: int) -> Amplification:
    """Return ε* by the two corrected derivations and as printed.

    Parameters
    ----------
    a, b : float > 0
        Lower bound of P, upper bound of P̄, θ².
    alpha, beta : float > 0
        Information of a window at least, of a sample at most, 1/θ².
    window : int >= 1
        N.

    Returns
    -------
    Amplification
        Without units; `corrected` does not change when P and Γ are scaled together.

    Examples
    --------
    >>> found = amplification(a=1.0, b=1.0, alpha=1.0, beta=1.0, window=1)
    >>> round(found.corrected, 6), round(found.printed, 6)
    (2.414214, 2.414214)
    """
    a = real("a", a, 0.0, math.inf, open_low=True)
    decrease = lyapunov_decrease(alpha, beta, b, window)
    delta = max(0.0, 1 / (a * decrease) - 1) if decrease > 0 else math.inf
    if not math.isfinite(delta):
        return Amplification(math.inf, math.inf, math.inf)
    ratio, root = math.sqrt(b / a), math.sqrt(1 + delta)
    rho = math.sqrt(delta / (1 + delta))
    lyapunov = ratio * window * math.sqrt(delta + 1 - 1 / window) * (math.sqrt(delta) + root)
    contraction = ratio * (window - 1 + rho) * (1 + rho) * (1 + delta)
    printed = max(1.0, 1 / math.sqrt(a)) * (delta + math.sqrt(delta) * root) * window
    return Amplification(lyapunov, contraction, printed)


def ultimate_bound(
    found: Conditions | Mapping[str, float],
    *,
    parameter_drift: float | None = None,
    measurement_noise: float | None = None,
    regressor_noise: float | None = None,
    parameter_norm: float | None = None,
    error: ArrayLike | None = None,
) -> UltimateBound:
    """Bound the error that drift and noise can keep alive.

    Parameters
    ----------
    found : Conditions or mapping
        From `conditions`; or the constants a, b, alpha, beta, window themselves.
    parameter_drift : float >= 0, optional
        δ_θ, the largest step of the parameters, units of θ.
    measurement_noise : float >= 0, optional
        δ_y, the largest weighted noise ‖Γ^{-1/2} δ_y‖.
    regressor_noise : float >= 0, optional
        δ_φ, the largest eigenvalue of the weighted δ_φᵀδ_φ (an amplitude squared).
    parameter_norm : float >= 0, optional
        θ_max, units of θ; needed only with regressor noise.
        What is not given is taken from `found`, and is 0 where it is not there either.
    error : (T, n) or (T,), optional
        θ̌_k = θ_k - θ*_{k-1} or its norm, to measure how loose the bound is.

    Returns
    -------
    UltimateBound
        With `bound` infinite, and the reason, where A1-A4 do not all hold.

    Notes
    -----
    Source: Lai and Bernstein, Theorem 3, eqs. (27)-(29), corrected as the module says.

    Examples
    --------
    >>> known = dict(a=0.1, b=0.2, alpha=1.0, beta=1.0, window=1)
    >>> found = ultimate_bound(known, parameter_drift=1e-3, measurement_noise=0.0)
    >>> round(found.bound, 4), found.errors_in_variables
    (0.0318, 0.0)
    """
    known = dict(found) if isinstance(found, Mapping) else dict(found.constants)
    given = {
        "parameter_drift": parameter_drift,
        "measurement_noise": measurement_noise,
        "regressor_noise": regressor_noise,
        "parameter_norm": parameter_norm,
    }
    for name, value in given.items():
        number = known.get(name, 0.0) if value is None else value
        known[name] = real(name, number, 0.0, math.inf)
    norm = None if error is None else _norm(error)
    reason = _applies(found, known)
    if reason is not None:
        unbounded = (math.inf, math.inf, math.inf)
        factor = Amplification(*unbounded)
        return UltimateBound(*unbounded, factor, math.inf, known, norm, reason)
    bounds = (known["a"], known["b"], known["alpha"], known["beta"])
    factor = amplification(*bounds, int(known["window"]))
    noise = math.sqrt(known["regressor_noise"]) * known["parameter_norm"]
    noise = known["b"] * math.sqrt(known["beta"]) * (noise + known["measurement_noise"])
    zeta = known["parameter_drift"] + noise
    return UltimateBound(
        factor.corrected * zeta if zeta else 0.0,
        factor.printed * zeta if zeta else 0.0,
        factor.corrected * noise if noise else 0.0,
        factor,
        zeta,
        known,
        norm,
        "A1-A4 hold over the record",
    )


def _applies(found: Conditions | Mapping[str, float], known: dict[str, float]) -> str | None:
    """Return why Theorem 3 does not apply, or None."""
    if not isinstance(found, Mapping):
        unmet = [name for name in ("A1", "A2", "A3", "A4") if found[name].verdict != "holds"]
        if unmet:
            return "; ".join(f"{name} {found[name].verdict}" for name in unmet)
    missing = [name for name in ("a", "b", "alpha", "beta", "window") if name not in known]
    if missing:
        raise refuse("found", sorted(known), f"a mapping with {', '.join(missing)}")
    return None


def _norm(error: ArrayLike) -> Array:
    values = numbers("error", error)
    if values.ndim not in {1, 2} or values.shape[0] == 0:
        raise refuse("error", values.shape, "shape (T, n) or (T,)")
    return np.abs(values) if values.ndim == 1 else np.linalg.norm(values, axis=1)


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
