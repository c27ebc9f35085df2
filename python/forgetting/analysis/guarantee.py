"""Bounds of P that a rule guarantees, by the formulas of its file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from forgetting import _core

from .validation import positive_matrix, real


@dataclass(frozen=True)
class Guarantee:
    """Bounds of the eigenvalues of P after every sample.

    Attributes
    ----------
    lower, upper : float or None
        None where the rule has no such bound, or no formula for it is known.
    bounded : bool
        Whether P stays bounded above whatever the input, by a formula or without.
    """

    lower: float | None
    upper: float | None
    bounded: bool

    def __str__(self) -> str:
        """In words."""
        small = "for regressors as large as in this record"
        if self.upper is None and self.lower is None:
            return "No formula for bounds of P is known for this rule; see its page."
        if self.upper is None:
            above = (
                "bounds P above, by no formula that is known"
                if self.bounded
                else "guarantees P no upper bound"
            )
            return f"The rule {above}; {small} P stays above {self.lower:.3g}."
        above = f"The rule keeps P below {self.upper:.3g} whatever the input"
        return above + ("." if self.lower is None else f", and above {self.lower:.3g} {small}.")


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
    initial = (float(start[0]), float(start[-1]))
    return Guarantee(*_core.bounds(rule, parameters, initial, (low, high), beta))
