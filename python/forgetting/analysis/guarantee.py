"""Bounds of P that a rule guarantees, as formulas of its header.

With R = P⁻¹, λ in [λ_min, λ_max] and φ̄ᵀφ̄ ≤ β I. Upper bounds of P hold for any input, lower ones
for regressors within β. A rule that is not here guarantees none by a formula.

    rule                    P at most, or P_0             P at least, or P_0
    none                    P_0
    exponential, component                                (1 - λ_max)/β
    subspace, directional   (1 - λ_min)/threshold²        (1 - λ_max)/β
    exponential_resetting   R_∞⁻¹                         1/(β/(1 - λ_max) + R_∞)
    matrix_forgetting       1/information
    data_dependent                                        1/β
    random_walk                                           1/(β + Q⁻¹)
    efra                    increase + (1/λ_min)²/(4 saturation)
    constant_trace          n level - (n - 1) floor       1/(β + 1/floor)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .validation import Array, positive_matrix, real


@dataclass(frozen=True)
class Guarantee:
    """Bounds of the eigenvalues of P after every sample; None where there is none."""

    lower: float | None
    upper: float | None

    def __str__(self) -> str:
        """In words."""
        small = "for regressors as large as in this record"
        if self.upper is None and self.lower is None:
            return "The rule guarantees no bounds of P."
        if self.upper is None:
            return f"The rule guarantees P no upper bound; {small} P stays above {self.lower:.3g}."
        above = f"The rule keeps P below {self.upper:.3g} whatever the input"
        return above + ("." if self.lower is None else f", and above {self.lower:.3g} {small}.")


@dataclass(frozen=True)
class _Case:
    """What the formulas use."""

    parameters: dict[str, Any]
    n: int
    largest: float
    factors: tuple[float, float]
    beta: float


def guaranteed_bounds(
    rule: Any,
    initial_covariance: ArrayLike,
    *,
    parameters: int,
    forgetting_factors: tuple[float, float],
    regressor_bound: float = math.inf,
) -> Guarantee:
    """Return the bounds that `rule` guarantees for the eigenvalues of P.

    Parameters
    ----------
    rule : Rule
        As given to the estimator.
    initial_covariance : scalar, (n,) or (n, n)
        P_0.
    parameters : int
        n.
    forgetting_factors : (float, float)
        The smallest and largest λ that is used, in (0, 1].
    regressor_bound : float >= 0
        β: no squared singular value of Γ^{-1/2} φ is larger.

    Returns
    -------
    Guarantee

    Notes
    -----
    Samples that are left out count for nothing; one that a gate freezes has λ = 1.

    Examples
    --------
    >>> import forgetting as fg
    >>> rule = fg.Subspace(0.9, threshold=0.5)
    >>> found = guaranteed_bounds(
    ...     rule, 0.1, parameters=2, forgetting_factors=(0.9, 0.9), regressor_bound=4.0
    ... )
    >>> round(found.lower, 9), round(found.upper, 9)
    (0.025, 0.4)
    """
    start = np.linalg.eigvalsh(
        positive_matrix("initial_covariance", initial_covariance, parameters)
    )
    low, high = (real("forgetting_factors", each, 0.0, 1.0) for each in forgetting_factors)
    beta = real("regressor_bound", regressor_bound, 0.0, math.inf)
    case = _Case(rule.parameters, parameters, float(start[-1]), (low, high), beta)
    upper, lower = (each.get(rule.name, _none)(case) for each in (_UPPER, _LOWER))
    return Guarantee(
        lower=min(lower, float(start[0])) if lower else None,
        upper=None if upper is None else max(upper, float(start[-1])),
    )


def _none(_: _Case) -> float | None:
    return None


def _threshold(case: _Case) -> float | None:
    threshold = float(case.parameters["threshold"])
    return (1 - case.factors[0]) / threshold**2 if threshold > 0 else None


def _target(case: _Case) -> float | None:
    least = float(_eigenvalues(case)[0])
    return 1 / least if least > 0 else None


def _eigenvalues(case: _Case) -> Array:
    """Of the information that resetting returns to, or of the process noise."""
    matrix = np.asarray(
        case.parameters.get("information", case.parameters.get("process_noise")), dtype=np.float64
    )
    if matrix.ndim < 2:
        return np.sort(np.broadcast_to(matrix, (case.n,)))
    return np.asarray(np.linalg.eigvalsh(matrix), dtype=np.float64)


def _saturation(case: _Case) -> float | None:
    increase, saturation = (float(case.parameters[x]) for x in ("increase", "saturation"))
    return increase + 1 / (4 * saturation * case.factors[0] ** 2)


def _level(case: _Case) -> float | None:
    level, floor = float(case.parameters["level"]), float(case.parameters["floor"])
    return case.n * level - (case.n - 1) * floor


def _memory(case: _Case) -> float | None:
    factors = case.parameters.get("factors")
    most = case.factors[1] if factors is None else float(np.max(factors))
    return (1 - most) / case.beta if 0 < case.beta < math.inf else None


def _resetting(case: _Case) -> float | None:
    most = case.factors[1]
    if most >= 1 or case.beta == math.inf:
        return None
    return 1 / (case.beta / (1 - most) + float(_eigenvalues(case)[-1]))


def _bounded_weight(case: _Case) -> float | None:
    return 1 / case.beta if 0 < case.beta < math.inf else None


def _floor(case: _Case) -> float | None:
    return 1 / (case.beta + 1 / float(case.parameters["floor"]))


def _walk(case: _Case) -> float | None:
    least = float(_eigenvalues(case)[0])
    return 1 / (case.beta + 1 / least) if least > 0 else None


_Formula = Callable[[_Case], "float | None"]
_UPPER: dict[str, _Formula] = {
    "none": lambda case: case.largest,
    "subspace": _threshold,
    "directional": _threshold,
    "exponential_resetting": _target,
    "matrix_forgetting": _target,
    "efra": _saturation,
    "constant_trace": _level,
}
_LOWER: dict[str, _Formula] = {
    "exponential": _memory,
    "component": _memory,
    "subspace": _memory,
    "directional": _memory,
    "exponential_resetting": _resetting,
    "data_dependent": _bounded_weight,
    "random_walk": _walk,
    "constant_trace": _floor,
}
