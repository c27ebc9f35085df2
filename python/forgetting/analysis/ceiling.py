"""The bound that a rule sets to the covariance without excitation, where it sets one."""

from __future__ import annotations

from typing import Any

import numpy as np

from .validation import Array


def ceiling_of(rule: Any, parameters: int) -> Array | None:
    """Return the covariance that `rule` returns to without excitation, (n, n), or None.

    A rule that forgets towards an information matrix returns to its inverse. A rule that
    always bounds P̄, by a number that is not known beforehand, has an infinite ceiling.

    Parameters
    ----------
    rule : Rule
        As given to the estimator.
    parameters : int
        Number n of parameters.

    Examples
    --------
    >>> import forgetting as fg
    >>> ceiling_of(fg.ExponentialResetting(0.9, information=0.25), 2)
    array([[4., 0.],
           [0., 4.]])
    >>> ceiling_of(fg.Exponential(0.9), 2) is None
    True
    """
    information = rule.parameters.get("information")
    if information is not None:
        matrix = np.asarray(information, dtype=np.float64)
        if matrix.ndim < 2:
            matrix = np.diag(np.broadcast_to(matrix, (parameters,)))
        if np.linalg.eigvalsh(matrix)[0] > 0:
            return np.asarray(np.linalg.inv(matrix), dtype=np.float64)
    if rule.about["bounded_above"] == "always":
        return np.diag(np.full(parameters, np.inf))
    return None
