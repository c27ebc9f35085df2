"""Whether a model diverges when it runs on its own outputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .finding import Finding

Array = NDArray[np.float64]

SAMPLED = 200
"""Models drawn from the uncertainty of the coefficients."""
SURE = 0.975
"""Share of them that must diverge for the model to be wrong."""


def largest_pole(feedback: Array) -> float:
    """Modulus of the largest pole of y(k) = A_1 y(k-1) + ... + A_na y(k-na).

    Parameters
    ----------
    feedback : ndarray, shape (na, m, m)
        A_1, ..., A_na.

    Examples
    --------
    >>> import numpy as np
    >>> round(largest_pole(np.array([[[1.5]], [[-0.5]]])), 9)  # poles 1 and 0.5
    1.0
    """
    lags, outputs, _ = feedback.shape
    companion = np.zeros((lags * outputs, lags * outputs))
    companion[:outputs] = np.concatenate(feedback, axis=1)
    companion[outputs:, :-outputs] = np.eye((lags - 1) * outputs)
    return float(np.abs(np.linalg.eigvals(companion)).max())


def poles(feedback: Array, spread: Array | None = None) -> Finding | None:
    """Judge the poles.

    Parameters
    ----------
    feedback : ndarray, shape (na, m, m)
        A_1, ..., A_na.
    spread : ndarray, shape (samples, na, m, m), optional
        Deviations of the coefficients, drawn from their uncertainty.
    """
    if not len(feedback) or not np.isfinite(feedback).all():
        return None
    largest = largest_pole(feedback)
    if largest <= 1:
        return Finding(
            "poles", "good", f"The model is stable: its largest pole has modulus {largest:.4f}."
        )
    sure = 1.0
    if spread is not None and np.isfinite(spread).all():
        sure = float(np.mean([largest_pole(feedback + each) > 1 for each in spread]))
    wrong = sure >= SURE
    text = f"Its largest pole has modulus {largest:.4f}, outside the unit circle"
    doubt = "" if wrong else f" (within the uncertainty: {sure:.0%} of models as likely diverge)"
    return Finding(
        "poles",
        "wrong" if wrong else "warning",
        f"The model diverges when it runs freely. {text}{doubt}.",
        "Predict one step ahead only, or lower na, or remember longer.",
    )
