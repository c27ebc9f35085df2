"""Whether one-step errors follow from what the inputs were before: dynamics that the model lacks.

Errors are made white first, so that their own correlation is not taken for one with the inputs
(Box and Jenkins). Of each input the share of the variance that its past explains is found by least
squares on its lags, from running sums alone: no matrix is as long as the record.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from forgetting.extras import extra

from .finding import Finding
from .residuals import CHANCE, FEWEST, NOTICED

Array = NDArray[np.float64]

LAGS = 10
"""Samples that an input is looked at back from each error."""
WRONG = 0.5
"""Share of the variance of the errors from which on the model is wrong."""
SINGULAR = 1e-8
"""Directions of the lags below this share of the largest are left out."""


def explained(errors: Array, signal: Array) -> tuple[float, float]:
    """Share of the variance of white errors that a signal's past explains, and its probability.

    Parameters
    ----------
    errors, signal : ndarray, shape (T,)
        NaN where there is none.

    Examples
    --------
    >>> import numpy as np
    >>> rng = np.random.default_rng(0)
    >>> u = rng.normal(size=1000)
    >>> share, chance = explained(np.r_[0.0, u[:-1]] + rng.normal(size=1000), u)
    >>> round(share, 1), chance < 1e-9
    (0.5, True)
    """
    tail = extra("scipy.special", "a test of residuals").chdtrc
    finite = np.isfinite(signal)
    level = float(signal[finite].mean()) if finite.any() else 0.0
    there, count = np.isfinite(errors), int(np.isfinite(errors).sum())
    e, u = np.where(there, errors, 0.0), np.where(finite, signal - level, 0.0)
    power = float(e @ e)
    if count < max(FEWEST, 4 * LAGS) or power == 0.0 or not u.any():
        return 0.0, 1.0
    total = len(e)
    across = np.array([e[lag:] @ u[: total - lag] for lag in range(1, LAGS + 1)])
    along = np.array([u[lag:] @ u[: total - lag] for lag in range(LAGS)])
    gram = along[np.abs(np.subtract.outer(np.arange(LAGS), np.arange(LAGS)))]
    values, vectors = np.linalg.eigh(gram)
    kept = values > SINGULAR * values[-1]
    share = float(np.sum((vectors[:, kept].T @ across) ** 2 / values[kept])) / power
    freedom = int(kept.sum())
    adjusted = 1 - (1 - share) * (count - 1) / max(count - freedom - 1, 1)
    return float(np.clip(adjusted, 0.0, 1.0)), float(tail(freedom, count * share))


def whitened(errors: Array, prediction: Array) -> Array:
    """Errors less what their own past predicts; NaN where an error or one before it is missing."""
    left = errors.copy()
    for lag, coefficient in enumerate(prediction[: len(errors) - 1], start=1):
        left[lag:] -= coefficient * errors[:-lag]
    left[: len(prediction)] = np.nan
    return left


def inputs(errors: Array, signals: Iterable[tuple[str, Array]], of: str) -> Finding | None:
    """Judge white errors of an output by the past of signals, each a name and its values (T,)."""
    found = {name: explained(errors, signal) for name, signal in signals}
    if not found:
        return None
    name = max(found, key=lambda each: found[each][0])
    share, chance = found[name]
    figure = f"{share:.0%} of the variance of the errors of {of} follows from the past of {name}"
    if share < NOTICED or chance * len(found) > CHANCE:
        return Finding("inputs", "good", f"At most {figure}.")
    wrong = share >= WRONG
    advice = f"Add past values of {name} to the model, or raise nb, or check the delay nk."
    words = f"The model is wrong: {figure}." if wrong else f"Dynamics are missing: {figure}."
    return Finding("inputs", "wrong" if wrong else "warning", words, advice)
